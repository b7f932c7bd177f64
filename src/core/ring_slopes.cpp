#include "ring_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr int MIN_ANGLES = ANGLES / 2;  // that must lie inside the image
constexpr double MIN_RADIUS = 1.8;      // [px]; closer to the centre all directions see the same pixels
constexpr double MIN_SLOPE = .01;       // over two pixels, relative to twice the brightness
constexpr float DARK_LEVEL = 48;        // added to twice the brightness [grey levels]
constexpr double VALLEY = .75;          // of the slope between two edges, relative to the weaker one
constexpr double TURN = .5;             // cosine between the slopes of two edges of a narrow ring

using Values = std::array<float, ANGLES>;

float median(Values& values, int count)
{
  std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
  return values[count / 2];
}

float brightest(const cv::Vec3f& grey)
{
  return std::max({grey[0], grey[1], grey[2]});
}

/**
 * Median slope of each channel at each radius, relative to the brightness there. Of grey levels: logarithms would move
 * a rising and a falling channel of one edge apart.
 */
std::vector<cv::Vec3f> medianSlopes(const RingProfile& profile)
{
  const int reach = std::max(1, static_cast<int>(std::lround(1 / profile.step)));
  std::vector<cv::Vec3f> slopes(static_cast<std::size_t>(profile.count));
  for (int i = reach; i + reach < profile.count; ++i)
  {
    std::array<Values, 3> values;
    int count = 0;
    cv::Vec3f sum;  // of the sizes: where it is small, the median is smaller
    for (int angle = 0; angle < ANGLES; ++angle)
    {
      if (i + reach < profile.inside[angle])
      {
        const cv::Vec3f& inner = profile.greyRay(angle)[i - reach];
        const cv::Vec3f& outer = profile.greyRay(angle)[i + reach];
        const float scale = 1 / (brightest(inner) + brightest(outer) + DARK_LEVEL);
        for (int c = 0; c < 3; ++c)
        {
          values[c][count] = (outer[c] - inner[c]) * scale;
          sum[c] += std::abs(values[c][count]);
        }
        ++count;
      }
    }
    for (int c = 0; c < 3 && count >= MIN_ANGLES; ++c)
    {
      slopes[i][c] = sum[c] > .5 * MIN_SLOPE * count ? median(values[c], count) : 0;
    }
  }
  return slopes;
}

}  // namespace

std::vector<double> steepestRadii(const RingProfile& profile)
{
  const std::vector<cv::Vec3f> directions = medianSlopes(profile);
  std::vector<double> slopes(directions.size());
  std::transform(directions.begin(), directions.end(), slopes.begin(),
                 [](const cv::Vec3f& slope) { return cv::norm(slope); });
  const int reach = std::max(1, static_cast<int>(1 / profile.step));
  std::vector<double> radii;
  int last = -1;
  for (int i = static_cast<int>(MIN_RADIUS / profile.step); i + 1 < profile.count; ++i)
  {
    const auto from = slopes.begin() + std::max(0, i - reach);
    const auto to = slopes.begin() + std::min(profile.count, i + reach + 1);
    if (slopes[i] <= MIN_SLOPE || std::max_element(from, to) != slopes.begin() + i)
    {
      continue;
    }
    if (last >= 0)
    {
      // One edge may give two maxima; between two edges the slope falls, or turns back.
      const double valley = *std::min_element(slopes.begin() + last, slopes.begin() + i);
      const bool turns_back = directions[i].dot(directions[last]) < TURN * slopes[i] * slopes[last];
      if (!turns_back && valley > VALLEY * std::min(slopes[i], slopes[last]))
      {
        if (slopes[i] <= slopes[last])
        {
          continue;
        }
        radii.pop_back();
      }
    }
    const double curvature = slopes[i - 1] + slopes[i + 1] - 2 * slopes[i];
    const double offset = curvature < 0 ? std::clamp(.5 * (slopes[i - 1] - slopes[i + 1]) / curvature, -.5, .5) : 0;
    radii.push_back((i + offset) * profile.step);
    last = i;
  }
  return radii;
}

}  // namespace omr
