#ifndef OUTDOOR_OMR_TOOLS_SCENE_H
#define OUTDOOR_OMR_TOOLS_SCENE_H

#include <opencv2/core.hpp>

namespace omr
{
/**
 * Draws checkerboards, targets of concentric rings and lines in colour with sensor noise, scaled to the size: a scene
 * for benchmarks and for tests that compare implementations. Equal arguments give equal images.
 *
 * @param noise standard deviation of the sensor noise [grey levels].
 */
cv::Mat drawScene(const cv::Size& size, double noise = 4);

}  // namespace omr

#endif
