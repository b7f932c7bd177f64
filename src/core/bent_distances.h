#ifndef OUTDOOR_OMR_CORE_BENT_DISTANCES_H
#define OUTDOOR_OMR_CORE_BENT_DISTANCES_H

#include <array>
#include <vector>

#include "ring_refinement.h"

namespace omr
{
/** The unknowns of a bent family: centre x, y, shape a, b, d, perspective hx, hy, bend x, y, normal x, y, hz. */
constexpr int BENT_UNKNOWNS = 12;

/** Derivative of a point's distance by them and by the radius of its circle. */
using BentDerivative = std::array<double, BENT_UNKNOWNS + 1>;

/**
 * Distance of each point to its circle in the image, positive outside [px].
 *
 * @param places receive the points' places on the sheet; if there are as many, those of a family much like this one.
 */
void measureBent(const std::vector<BoundaryPoint>& points, const RingFamily& family, const std::vector<double>& radii,
                 std::vector<cv::Point2d>& places, std::vector<double>& distances);

/** @param place of a point on the sheet. @param radius of the outermost circle [px] */
BentDerivative differentiateBent(const cv::Point2d& place, const RingFamily& family, double radius);

}  // namespace omr

#endif
