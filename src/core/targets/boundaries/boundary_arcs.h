#ifndef OUTDOOR_OMR_CORE_BOUNDARY_ARCS_H
#define OUTDOOR_OMR_CORE_BOUNDARY_ARCS_H

#include <opencv2/core.hpp>
#include <vector>

#include "targets/family/ring_family.h"

namespace omr
{
/** A short piece of a ring's outer boundary, as the pixels along it show it. */
struct BoundaryArc
{
  int ring = 0;          ///< index into the radii
  double turn = 0;       ///< direction of its middle on the plane, of a full turn [0, 1)
  cv::Point2d position;  ///< where the edge is in the middle of the piece [px]
  double step = 0;       ///< from inside to outside [grey levels], in the colours that show it best
  double lacking = 0;    ///< RMS of what a soft edge between two levels does not explain [grey levels]
  double steepness = 0;  ///< what a move of the edge by 1 px changes, root of the sum over all pixels [grey levels]
  int pixels = 0;        ///< that it was fitted to
};

/**
 * Fits a soft edge, as lens and pixels make it, to each piece of all boundaries. All pixels beside a boundary count,
 * linearly, while an edgel knows three of them.
 *
 * @param bgr    CV_8UC3, not filtered.
 * @param family of a plane sheet, right to a pixel.
 * @param radii  ascending [px].
 */
std::vector<BoundaryArc> measureArcs(const cv::Mat& bgr, const RingFamily& family, const std::vector<double>& radii);

}  // namespace omr

#endif
