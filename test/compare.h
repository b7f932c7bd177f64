#ifndef OUTDOOR_OMR_COMPARE_H
#define OUTDOOR_OMR_COMPARE_H

#include <opencv2/core.hpp>

namespace omr
{
namespace test
{
/** Whether size, type and every element agree. */
inline bool equal(const cv::Mat& a, const cv::Mat& b)
{
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/** CV_8UC3, every channel of every pixel at random, always the same. */
inline cv::Mat noiseImage(const cv::Size& size)
{
  cv::Mat image(size, CV_8UC3);
  cv::theRNG().state = 5;
  cv::randu(image, 0, 256);
  return image;
}

}  // namespace test
}  // namespace omr

#endif
