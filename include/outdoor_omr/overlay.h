#ifndef OUTDOOR_OMR_OVERLAY_H
#define OUTDOOR_OMR_OVERLAY_H

#include <opencv2/core.hpp>

#include "outdoor_omr/detector.h"

namespace outdoor_omr
{
/**
 * Draws what was found (paper, section 3), readable from 640x480 to 4K.
 *
 * @param bgr      H x W, CV_8UC3; not changed.
 * @param markers  what Detector::detect() found in it.
 * @param regions  Detector::regions(); painted when it holds labels.
 * @return         H x W, CV_8UC3.
 */
cv::Mat drawOverlay(const cv::Mat& bgr, const Markers& markers, const RegionMap& regions);

}  // namespace outdoor_omr

#endif
