#include "ring_colors.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double DARKEST = .003;  // linear light: two grey levels in the dark, below it is noise

double median(std::vector<double>& values)
{
  if (values.empty())
  {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Logarithm of the linear light. */
cv::Vec3d logLight(const LogColor& color)
{
  cv::Vec3d light;
  for (int c = 0; c < 3; ++c)
  {
    light[c] = std::log(linearLight(greyLevel(color[2 - c])) + DARKEST);
  }
  return light;
}
}  // namespace

std::vector<LinearColor> measureRingColors(const RingProfile& profile, const std::vector<double>& radii)
{
  const std::size_t count = radii.size() + 1;
  std::vector<std::vector<cv::Vec3d>> light(count, std::vector<cv::Vec3d>(RingProfile::ANGLES));
  std::vector<std::vector<char>> seen(count, std::vector<char>(RingProfile::ANGLES, 0));
  for (std::size_t ring = 0; ring < count; ++ring)
  {
    for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
    {
      LogColor color;
      seen[ring][angle] = ringColor(profile, radii, ring, angle, color) ? 1 : 0;
      light[ring][angle] = logLight(color);
    }
  }
  std::vector<cv::Vec3d> chained(count);
  cv::Vec3d level;  // what the chain lacks: the light of the whole target
  std::vector<double> values;
  for (int c = 0; c < 3; ++c)
  {
    for (std::size_t ring = 0; ring < count; ++ring)
    {
      values.clear();
      for (int angle = 0; ring > 0 && angle < RingProfile::ANGLES; ++angle)
      {
        if (seen[ring - 1][angle] && seen[ring][angle])
        {
          values.push_back(light[ring][angle][c] - light[ring - 1][angle][c]);
        }
      }
      chained[ring][c] = ring > 0 ? chained[ring - 1][c] + median(values) : 0;
      values.clear();
      for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
      {
        if (seen[ring][angle])
        {
          values.push_back(light[ring][angle][c]);
        }
      }
      level[c] += (median(values) - chained[ring][c]) / static_cast<double>(count);
    }
  }
  std::vector<LinearColor> colors;
  for (const cv::Vec3d& color : chained)
  {
    LinearColor linear;
    for (int c = 0; c < 3; ++c)
    {
      linear[c] = std::max(1e-4, std::exp(color[c] + level[c]) - DARKEST);
    }
    colors.push_back(linear);
  }
  return colors;
}

}  // namespace omr
