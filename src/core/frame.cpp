#include "outdoor_omr/frame.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace omr
{
namespace
{
// Squares up to 24 px are looked at on level 0; four halvings bring a square of 384 px there.
constexpr std::size_t MAX_LEVELS = 5;
constexpr int MIN_LEVEL_WIDTH = 80;

std::size_t levelsOf(int width)
{
  std::size_t levels = 1;
  for (; levels < MAX_LEVELS && width >= 2 * MIN_LEVEL_WIDTH; ++levels)
  {
    width = (width + 1) / 2;
  }
  return levels;
}
}  // namespace

Frame makeFrame(const cv::Mat& bgr)
{
  Frame frame;
  makeFrame(bgr, frame);
  return frame;
}

void makeFrame(const cv::Mat& bgr, Frame& frame)
{
  if (bgr.empty() || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
  frame.bgr = bgr;
  cv::cvtColor(bgr, frame.raw_grey, cv::COLOR_BGR2GRAY);
  frame.grey.resize(levelsOf(bgr.cols));
  cv::GaussianBlur(frame.raw_grey, frame.grey[0], cv::Size(3, 3), 0);
  for (std::size_t level = 1; level < frame.grey.size(); ++level)
  {
    cv::pyrDown(frame.grey[level - 1], frame.grey[level]);
  }
}

}  // namespace omr
