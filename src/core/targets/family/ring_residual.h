#ifndef OUTDOOR_OMR_CORE_RING_RESIDUAL_H
#define OUTDOOR_OMR_CORE_RING_RESIDUAL_H

#include <array>
#include <vector>

#include "ring_refinement.h"

namespace omr
{
/** The unknowns of a family: centre x, y, shape a, b, d, perspective hx, hy. */
constexpr int FAMILY_UNKNOWNS = 7;

/** Derivative of a point's distance by the family's unknowns and by the radius of its circle. */
using CircleDerivative = std::array<double, FAMILY_UNKNOWNS + 1>;

/** Points with the circles that they lie on; their distances are computed several at once. */
class CircleDistances
{
 public:
  explicit CircleDistances(const std::vector<BoundaryPoint>& points);

  std::size_t size() const
  {
    return x_.size();
  }

  int ring(std::size_t point) const
  {
    return ring_[point];
  }

  /** Distance of each point to its circle in the image, positive outside [px], times its certainty. */
  void measure(const RingFamily& family, const std::vector<double>& radii, std::vector<double>& distances) const;

  /** Their derivatives. */
  void differentiate(const RingFamily& family, std::vector<CircleDerivative>& derivatives) const;

 private:
  std::vector<double> x_, y_;  // [px]
  std::vector<double> certainty_;
  std::vector<int> ring_;
};

}  // namespace omr

#endif
