#ifndef OUTDOOR_OMR_CORE_LEVENBERG_MARQUARDT_H
#define OUTDOOR_OMR_CORE_LEVENBERG_MARQUARDT_H

#include <algorithm>

namespace omr
{
/**
 * Levenberg-Marquardt's steps, until the cost falls by less than a thousandth or four dampings in a row do not lower
 * it. cv::LMSolver wants the whole Jacobian; these problems have normal equations only, of points weighted anew each
 * step.
 *
 * @param max_steps 1 or more.
 * @param damping   of the first step.
 * @param begin     double(): makes the equations of the present solution, returns its cost.
 * @param attempt   double(damping): solves them, returns the cost of the new solution; infinity if there is none.
 * @param accept    void(): makes the last attempt's solution the present one.
 */
template <typename Begin, typename Attempt, typename Accept>
void levenbergMarquardt(int max_steps, double damping, const Begin& begin, const Attempt& attempt, const Accept& accept)
{
  constexpr int MAX_TRIALS = 4;
  constexpr double CONVERGED = 1e-3;  // relative change of the cost
  for (int step = 0; step < max_steps; ++step)
  {
    const double before = begin();
    double after = before;
    bool accepted = false;
    for (int trial = 0; trial < MAX_TRIALS && !accepted; ++trial)
    {
      after = attempt(damping);
      accepted = after <= before;
      damping = accepted ? std::max(1e-7, damping * .1) : damping * 10;
    }
    if (accepted)
    {
      accept();
    }
    if (!accepted || before - after < CONVERGED * before)
    {
      return;
    }
  }
}

}  // namespace omr

#endif
