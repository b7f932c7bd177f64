#ifndef OUTDOOR_OMR_CORE_RING_RESIDUAL_H
#define OUTDOOR_OMR_CORE_RING_RESIDUAL_H

#include <vector>

#include "ring_refinement.h"

namespace omr
{
/** A value for each unknown of a family: centre x, y, shape a, b, d, perspective hx, hy. */
using FamilyVector = cv::Vec<double, 7>;

/**
 * Distance of a point to its circle in the image, positive outside [px].
 *
 * @param derivative receives the derivative by the family's unknowns, if not null.
 * @param by_radius  receives that by the circle's radius, if derivative is not null.
 */
double circleDistance(const RingFamily& family, const std::vector<double>& radii, const BoundaryPoint& point,
                      FamilyVector* derivative, double* by_radius);

}  // namespace omr

#endif
