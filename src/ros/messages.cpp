#include "messages.h"

#include <cmath>
#include <utility>

namespace omr
{
namespace
{
outdoor_omr::Pixel toMessage(const cv::Point2f& point)
{
  outdoor_omr::Pixel message;
  message.x = point.x;
  message.y = point.y;
  return message;
}

/** OpenCV gives the angle of the width in degrees, clockwise as seen. */
outdoor_omr::Ellipse toMessage(const cv::RotatedRect& ellipse)
{
  double major = ellipse.size.width;
  double minor = ellipse.size.height;
  double degrees = ellipse.angle;
  if (major < minor)
  {
    std::swap(major, minor);
    degrees += 90;
  }
  degrees = std::fmod(std::fmod(degrees, 180) + 180, 180);
  outdoor_omr::Ellipse message;
  message.center = toMessage(ellipse.center);
  message.major_axis = static_cast<float>(major);
  message.minor_axis = static_cast<float>(minor);
  message.angle = static_cast<float>(degrees * CV_PI / 180);
  return message;
}

outdoor_omr::Checkerboard toMessage(const Checkerboard& board)
{
  outdoor_omr::Checkerboard message;
  message.rows = board.rows;
  message.cols = board.cols;
  for (std::size_t i = 0; i < board.corners.size(); ++i)
  {
    message.corners[i] = toMessage(board.corners[i]);
  }
  for (const cv::Point2f& corner : board.inner_corners)
  {
    message.inner_corners.push_back(toMessage(corner));
  }
  message.inner_corners_seen.assign(board.inner_corners_seen.begin(), board.inner_corners_seen.end());
  message.squares_seen.assign(board.squares_seen.begin(), board.squares_seen.end());
  message.regularity = static_cast<float>(board.regularity);
  message.size_certain = board.size_certain;
  return message;
}

outdoor_omr::Target toMessage(const Target& target)
{
  outdoor_omr::Target message;
  message.colors = target.colors;
  message.center = toMessage(target.center);
  message.outermost_deviation = static_cast<float>(target.outermost_deviation);
  for (const cv::RotatedRect& ring : target.rings)
  {
    message.rings.push_back(toMessage(ring));
  }
  return message;
}

template <typename Array>
Array emptyArray(const std_msgs::Header& header, const cv::Size& size)
{
  Array message;
  message.header = header;
  message.width = size.width;
  message.height = size.height;
  return message;
}
}  // namespace

outdoor_omr::CheckerboardArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                         const std::vector<Checkerboard>& checkerboards,
                                         const std::vector<Checkerboard>& sections)
{
  auto message = emptyArray<outdoor_omr::CheckerboardArray>(header, size);
  for (const Checkerboard& board : checkerboards)
  {
    message.checkerboards.push_back(toMessage(board));
  }
  for (const Checkerboard& section : sections)
  {
    message.sections.push_back(toMessage(section));
  }
  return message;
}

outdoor_omr::TargetArray toMessage(const std_msgs::Header& header, const cv::Size& size,
                                   const std::vector<Target>& targets)
{
  auto message = emptyArray<outdoor_omr::TargetArray>(header, size);
  for (const Target& target : targets)
  {
    message.targets.push_back(toMessage(target));
  }
  return message;
}

}  // namespace omr
