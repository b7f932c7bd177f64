#include "blurred_disk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace omr
{
namespace
{
constexpr int DIRECTIONS = 16;      // of the integral over half a disk
constexpr double BLUR_REACH = 8.5;  // deviations: beyond it the blur changes a grey level by less than rounding does

/** Sine and cosine of the directions. */
const std::array<cv::Point2d, DIRECTIONS>& directions()
{
  static const auto DIRECTION = [] {
    std::array<cv::Point2d, DIRECTIONS> table;
    for (int i = 0; i < DIRECTIONS; ++i)
    {
      const double phi = CV_PI * (i + .5) / DIRECTIONS;
      table[i] = {std::cos(phi), std::sin(phi)};
    }
    return table;
  }();
  return DIRECTION;
}
}  // namespace

double blurredDisk(double r, double radius, double deviation)
{
  const double distance_to_edge = r - radius;
  if (distance_to_edge > BLUR_REACH * deviation)
  {
    return 0;
  }
  if (radius > 4 * deviation)
  {
    return distance_to_edge < -BLUR_REACH * deviation ? 1
                                                      : .5 * std::erfc(distance_to_edge / (deviation * std::sqrt(2.)));
  }
  // In polar coordinates around the point, the Gaussian's radial integral is known.
  const auto beyond = [&](double distance) { return std::exp(-distance * distance / (2 * deviation * deviation)); };
  double sum = 0;
  for (const cv::Point2d& direction : directions())
  {
    const double across = r * direction.y;
    const double inside = radius * radius - across * across;
    if (inside > 0)
    {
      const double to = -r * direction.x + std::sqrt(inside);
      const double from = -r * direction.x - std::sqrt(inside);
      sum += to > 0 ? beyond(std::max(0., from)) - beyond(to) : 0;
    }
  }
  return sum / DIRECTIONS;
}

}  // namespace omr
