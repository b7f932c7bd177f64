#include "ring_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace outdoor_omr
{
namespace
{
constexpr double FINEST_STEP = .5;  // [px]
constexpr int MAX_SAMPLES = 400;    // a ray
// Added before the logarithm [grey levels]: below it sensor noise and black level, not light, decide.
constexpr float DARK_LEVEL = 24;
constexpr int LEVELS_PER_GREY = 4;

const std::array<float, 255 * LEVELS_PER_GREY + 2>& logarithms()
{
  static const auto TABLE = [] {
    std::array<float, 255 * LEVELS_PER_GREY + 2> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = std::log(static_cast<float>(i) / LEVELS_PER_GREY + DARK_LEVEL);
    }
    return table;
  }();
  return TABLE;
}

/** Bilinear sample; the caller keeps x and y inside [0, size - 1). */
LogColor sample(const cv::Mat& bgr, float x, float y)
{
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float fx = x - left;
  const float fy = y - top;
  const auto* upper = bgr.ptr<uchar>(top) + 3 * left;
  const auto* lower = bgr.ptr<uchar>(top + 1) + 3 * left;
  const auto& table = logarithms();
  LogColor color;
  for (int c = 0; c < 3; ++c)
  {
    const float above = upper[c] + fx * (upper[c + 3] - upper[c]);
    const float below = lower[c] + fx * (lower[c + 3] - lower[c]);
    color[c] = table[static_cast<std::size_t>((above + fy * (below - above)) * LEVELS_PER_GREY + .5F)];
  }
  return color;
}
}  // namespace

void sampleProfile(const cv::Mat& bgr, const RingFamily& family, double max_radius, RingProfile& profile)
{
  profile.step = std::max(FINEST_STEP, max_radius / MAX_SAMPLES);
  profile.count = static_cast<int>(max_radius / profile.step) + 1;
  profile.color.assign(static_cast<std::size_t>(RingProfile::ANGLES) * profile.count, LogColor());
  profile.inside.assign(RingProfile::ANGLES, profile.count);
  for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
  {
    const double phi = 2 * CV_PI * (angle + .5) / RingProfile::ANGLES;
    const cv::Point2d direction(std::cos(phi), std::sin(phi));
    LogColor* ray = &profile.color[static_cast<std::size_t>(angle) * profile.count];
    for (int i = 0; i < profile.count; ++i)
    {
      const cv::Point2d p = family.toImage(direction * (i * profile.step));
      if (!(p.x >= 0 && p.y >= 0 && p.x < bgr.cols - 1 && p.y < bgr.rows - 1))
      {
        profile.inside[angle] = i;
        break;
      }
      ray[i] = sample(bgr, static_cast<float>(p.x), static_cast<float>(p.y));
    }
  }
}

}  // namespace outdoor_omr
