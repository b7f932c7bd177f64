#ifndef OUTDOOR_OMR_CORE_RING_OWN_BOUNDARY_H
#define OUTDOOR_OMR_CORE_RING_OWN_BOUNDARY_H

#include <opencv2/core.hpp>

#include "targets/edges/edgels.h"
#include "targets/seeds/ring_seeds.h"

namespace omr
{
/** Whether there is an edge where the seed's region ends, most of the way around: a cheap first look. */
bool hasOwnBoundary(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed);

}  // namespace omr

#endif
