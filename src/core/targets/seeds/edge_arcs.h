#ifndef OUTDOOR_OMR_CORE_EDGE_ARCS_H
#define OUTDOOR_OMR_CORE_EDGE_ARCS_H

#include <opencv2/core.hpp>
#include <vector>

#include "arc_shape.h"
#include "targets/edges/edge_chains.h"
#include "targets/edges/edgels.h"

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

/** The arcs of an image, and what leads to them. It may serve for the next image: its memory, given back and asked of
 * the system anew, page by page, took 45 of 59 ms of the search for arcs in dense clutter. */
struct ArcTrace
{
  std::vector<Edgel> edgels;
  Chains chains;
  std::vector<EdgeArc> arcs;
};

/**
 * Follows the edgels along edges and cuts them into bent pieces; straight ones are left out.
 *
 * @param size of the edgels' image.
 */
void traceArcs(const cv::Size& size, ArcTrace& trace);

}  // namespace omr

#endif
