#include "resized_part.h"

namespace omr
{
namespace
{
const cv::Point2d HALF(.5, .5);  // a pixel
}  // namespace

cv::Point2d ResizedPart::toImage(const cv::Point2d& point) const
{
  return (point + HALF) / factor - HALF + origin;
}

cv::Point2d ResizedPart::fromImage(const cv::Point2d& point) const
{
  return (point - origin + HALF) * factor - HALF;
}

void moveToImage(const ResizedPart& part, Checkerboard& board)
{
  const auto move = [&part](auto& points) {
    for (cv::Point2f& point : points)
    {
      point = cv::Point2f(part.toImage(point));
    }
  };
  move(board.corners);
  move(board.inner_corners);
  move(board.squares);
}

void moveToImage(const ResizedPart& part, Target& target)
{
  target.center = cv::Point2f(part.toImage(target.center));
  for (cv::RotatedRect& ring : target.rings)
  {
    ring.center = cv::Point2f(part.toImage(ring.center));
    ring.size = ring.size / static_cast<float>(part.factor);
  }
  // outermost_deviation keeps its number: an enlargement has more pixels, which say no more than those of the image.
}

}  // namespace omr
