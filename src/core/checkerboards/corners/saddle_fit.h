#ifndef OUTDOOR_OMR_CORE_SADDLE_FIT_H
#define OUTDOOR_OMR_CORE_SADDLE_FIT_H

#include <opencv2/core.hpp>

namespace omr
{
/**
 * Saddle point of the quadratic fitted to a square window, re-centred until it rests.
 *
 * @param point  start and result, pixels of this image.
 * @param radius of the window [px].
 * @param reach  largest distance from the start [px].
 * @return false if there is no saddle point within reach.
 */
bool fitSaddle(const cv::Mat& grey, cv::Point2f& point, int radius, float reach);

/** Radius of the window that suits squares of this height [px]. */
int fitRadius(float square_height);

}  // namespace omr

#endif
