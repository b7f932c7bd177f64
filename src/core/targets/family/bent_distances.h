#ifndef OUTDOOR_OMR_CORE_BENT_DISTANCES_H
#define OUTDOOR_OMR_CORE_BENT_DISTANCES_H

#include <array>
#include <vector>

#include "bent_sheet.h"
#include "ring_refinement.h"

namespace omr
{
/** A row as long as vectors like: derivatives of a point's distance by BENT_UNKNOWNS and by its circle's radius. */
using BentRow = std::array<double, 16>;

/**
 * Distance of each point to its circle in the image, positive outside [px].
 *
 * @param places receive the points' places on the sheet; if there are as many, those of a family much like this one.
 */
void measureBent(const std::vector<BoundaryPoint>& points, const RingFamily& family, const std::vector<double>& radii,
                 std::vector<cv::Point2d>& places, std::vector<double>& distances);

/** @param places of points on the sheet. @param rows receive the derivatives of each. */
void differentiateBent(const std::vector<cv::Point2d>& places, const RingFamily& family, std::vector<BentRow>& rows);

}  // namespace omr

#endif
