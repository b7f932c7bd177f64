#ifndef OUTDOOR_OMR_CORE_EDGE_ARCS_H
#define OUTDOOR_OMR_CORE_EDGE_ARCS_H

#include <opencv2/core.hpp>
#include <vector>

#include "arc_shape.h"
#include "edgels.h"

namespace omr
{
/** A bent piece of an edge. */
struct EdgeArc
{
  ArcSums sums;
  double turning = 0;   ///< of its direction [rad]
  int chain = 0;        ///< arcs of one chain follow each other without a corner
  cv::Point2d middle;   ///< [px]
  cv::Point2d inwards;  ///< unit vector towards the concave side
};

/**
 * Follows edgels along edges and cuts them into bent pieces; straight ones are left out.
 *
 * @param size of the edgels' image.
 */
std::vector<EdgeArc> traceArcs(const std::vector<Edgel>& edgels, const cv::Size& size);

}  // namespace omr

#endif
