#ifndef OUTDOOR_OMR_CORE_RING_EQUATIONS_H
#define OUTDOOR_OMR_CORE_RING_EQUATIONS_H

#include <array>
#include <vector>

#include "ring_residual.h"

namespace omr
{
using FamilyVector = cv::Vec<double, FAMILY_UNKNOWNS>;

/** Normal equations of a family and of the radii, apart: each point knows but one radius. */
struct RingEquations
{
  cv::Matx<double, FAMILY_UNKNOWNS, FAMILY_UNKNOWNS> normal;
  FamilyVector right;
  std::array<FamilyVector, MAX_BOUNDARIES> coupling{};
  std::array<double, MAX_BOUNDARIES> diagonal{}, radius_right{};

  /**
   * Solves with the diagonal raised by the share of damping; the radii are eliminated.
   *
   * @param count of the radii.
   * @return      false if the points do not determine the unknowns.
   */
  bool solve(double damping, std::size_t count, FamilyVector& step,
             std::array<double, MAX_BOUNDARIES>& radius_step) const;

  /** Of the family's unknowns, the radii free, where the points' weighted errors have a variance of 1; 0 if the points
   * do not determine them. */
  cv::Matx<double, FAMILY_UNKNOWNS, FAMILY_UNKNOWNS> covariance(std::size_t count) const;
};

/** The equations of the points, weighted by Tukey. */
RingEquations sumEquations(const CircleDistances& points, const std::vector<CircleDerivative>& derivatives,
                           const std::vector<double>& errors, double limit);

}  // namespace omr

#endif
