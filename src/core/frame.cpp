#include "outdoor_omr/frame.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace omr
{
namespace
{
// Squares up to 24 px are looked at on level 0; four halvings bring a square of 384 px there.
constexpr int MAX_LEVELS = 5;
constexpr int MIN_LEVEL_WIDTH = 80;
}  // namespace

Frame makeFrame(const cv::Mat& bgr)
{
  if (bgr.empty() || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
  Frame frame;
  frame.bgr = bgr;
  cv::cvtColor(bgr, frame.raw_grey, cv::COLOR_BGR2GRAY);
  frame.grey.emplace_back();
  cv::GaussianBlur(frame.raw_grey, frame.grey[0], cv::Size(3, 3), 0);
  while (static_cast<int>(frame.grey.size()) < MAX_LEVELS && frame.grey.back().cols >= 2 * MIN_LEVEL_WIDTH)
  {
    cv::Mat half;
    cv::pyrDown(frame.grey.back(), half);
    frame.grey.push_back(half);
  }
  return frame;
}

}  // namespace omr
