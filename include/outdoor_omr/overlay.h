#ifndef OUTDOOR_OMR_OVERLAY_H
#define OUTDOOR_OMR_OVERLAY_H

#include <opencv2/core.hpp>

#include "outdoor_omr/detector.h"

namespace omr
{
/**
 * Draws what was found (paper, section 3), readable from 640x480 to 4K: line widths and text grow with the image.
 *
 * Checkerboards, each in a colour of its own: the outer quadrilateral with a dot at its first corner, a circle at the
 * centre of every square that was seen, the size in squares (with ">=" where a rim may be hidden), and the inner
 * corners as upright green crosses where seen, as tilted red ones where only predicted. Targets, yellow: a circle at
 * the centre, its number in markers.targets, the colour sequence and the ellipse of each ring. Candidates: a dashed
 * box, green where a marker was read, red where not. Regions: each in a pseudo-random colour that follows from its
 * label, the first blue, edge pixels yellow. Positions that are not finite or lie far outside the image are left out.
 *
 * @param bgr      H x W, CV_8UC3; not changed.
 * @param markers  what Detector::detect() found in it.
 * @param regions  Detector::regions(); painted when it holds labels.
 * @return         H x W, CV_8UC3.
 * @throws std::invalid_argument if bgr is empty or has another type, or if labels or edges have another size or type.
 */
cv::Mat drawOverlay(const cv::Mat& bgr, const Markers& markers, const RegionMap& regions);

}  // namespace omr

#endif
