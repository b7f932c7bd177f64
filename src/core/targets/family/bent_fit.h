#ifndef OUTDOOR_OMR_CORE_BENT_FIT_H
#define OUTDOOR_OMR_CORE_BENT_FIT_H

#include <opencv2/core.hpp>
#include <vector>

#include "bent_distances.h"
#include "ring_refinement.h"

namespace omr
{
/** Least squares fit of a bent family and its radii to points, robust (Tukey) and damped (Levenberg-Marquardt). */
class BentFit
{
 public:
  /** @param points must outlive this. */
  BentFit(const std::vector<BoundaryPoint>& points, const RingFamily& family, std::vector<double> radii);

  /** @return false if the solution is no plausible one. */
  bool run(int max_steps);

  const RingFamily& family() const
  {
    return family_;
  }

  const std::vector<double>& radii() const
  {
    return radii_;
  }

  /** Mean of Tukey's loss of the points at a limit [px]. */
  double loss(double limit) const;

  /** RMS distance of the points that count [px]. */
  double rms() const;

 private:
  double cost(const RingFamily& family, const std::vector<double>& radii, const std::vector<double>& errors) const;
  void build();
  void addGauge();
  void addPrior();
  bool solve(double damping, RingFamily& family, std::vector<double>& radii) const;

  const std::vector<BoundaryPoint>& points_;
  RingFamily family_;
  std::vector<double> radii_;
  std::vector<cv::Point2d> places_;  // of the points, on the sheet [px]
  std::vector<double> errors_;       // [px]
  double limit_ = 1;                 // Tukey's: errors beyond it do not count [px]
  std::vector<BentRow> rows_;
  cv::Mat normal_, right_;
};

}  // namespace omr

#endif
