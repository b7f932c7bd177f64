#ifndef OUTDOOR_OMR_CORE_SATURATED_ISLANDS_H
#define OUTDOOR_OMR_CORE_SATURATED_ISLANDS_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Pixels that touch, in white ones all around. */
struct Island
{
  cv::Point2f center;  ///< [px]
  int area = 0;        ///< [px]
};

/**
 * Finds islands of pixels that are not white. A picture without white in it costs one pass over it.
 *
 * @param grey  CV_8UC1.
 * @param white the least grey value of white pixels.
 */
std::vector<Island> findIslands(const cv::Mat& grey, int white);

}  // namespace omr

#endif
