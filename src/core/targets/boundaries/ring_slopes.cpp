#include "ring_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

#include "lane_median.h"
#include "median.h"

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr double MIN_RADIUS = 1.8;  // [px]; closer to the centre all directions see the same pixels
constexpr double MIN_SLOPE = .01;   // over two pixels, relative to twice the brightness
constexpr double VALLEY = .75;      // of the slope between two edges, relative to the weaker one
constexpr double TURN = .5;         // cosine between the slopes of two edges of a narrow ring

using Values = std::array<float, ANGLES>;

float brightest(const cv::Vec3f& grey)
{
  return std::max({grey[0], grey[1], grey[2]});
}

bool isSteep(float sum_of_sizes, int count)
{
  return sum_of_sizes > .5 * MIN_SLOPE * count;  // where it is small, the median is smaller
}

/** At a radius that not all rays reach. */
cv::Vec3f medianSlope(const RingProfile& profile, int i, int reach)
{
  std::array<Values, 3> values;
  int count = 0;
  cv::Vec3f sum;  // of the sizes
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    if (i + reach < profile.inside[angle])
    {
      const cv::Vec3f& inner = profile.greyRay(angle)[i - reach];
      const cv::Vec3f& outer = profile.greyRay(angle)[i + reach];
      const float scale = 1 / (brightest(inner) + brightest(outer) + 2 * DARK_LEVEL);
      for (int c = 0; c < 3; ++c)
      {
        values[c][count] = (outer[c] - inner[c]) * scale;
        sum[c] += std::abs(values[c][count]);
      }
      ++count;
    }
  }
  cv::Vec3f slope;
  for (int c = 0; c < 3 && count >= leastDirections(profile); ++c)
  {
    slope[c] = isSteep(sum[c], count) ? median(values[c], count) : 0;
  }
  return slope;
}

/** The same for LANES radii from i on that all rays reach. */
class SlopeLanes
{
 public:
  static constexpr int LANES = static_cast<int>(MEDIAN_LANES);

  void find(const RingProfile& profile, int i, int reach, cv::Vec3f* slopes)
  {
    sums_ = {};
    for (int angle = 0; angle < ANGLES; ++angle)
    {
      const float* inner = profile.greyRay(angle)[i - reach].val;
      const float* outer = profile.greyRay(angle)[i + reach].val;
      add(inner, outer, angle, 0);
      add(inner + 3 * LANES / 2, outer + 3 * LANES / 2, angle, LANES / 2);
    }
    for (int c = 0; c < 3; ++c)
    {
      const LaneRow& sums = sums_[c];
      LaneRow medians{};
      if (std::any_of(sums.begin(), sums.end(), [](float sum) { return isSteep(sum, ANGLES); }))
      {
        upperMedians(values_[c], medians);
      }
      for (int lane = 0; lane < LANES; ++lane)
      {
        slopes[lane][c] = isSteep(sums[lane], ANGLES) ? medians[lane] : 0;
      }
    }
  }

 private:
  /** The slopes of one ray, four radii from a lane on. */
  void add(const float* inner, const float* outer, int angle, int lane)
  {
    std::array<cv::v_float32x4, 3> in;
    std::array<cv::v_float32x4, 3> out;
    cv::v_load_deinterleave(inner, in[0], in[1], in[2]);
    cv::v_load_deinterleave(outer, out[0], out[1], out[2]);
    const cv::v_float32x4 brightness = cv::v_max(cv::v_max(in[0], in[1]), in[2]) +
                                       cv::v_max(cv::v_max(out[0], out[1]), out[2]) + cv::v_setall_f32(2 * DARK_LEVEL);
    const cv::v_float32x4 scale = cv::v_setall_f32(1) / brightness;
    for (int c = 0; c < 3; ++c)
    {
      const cv::v_float32x4 slope = (out[c] - in[c]) * scale;
      float* sum = &sums_[c][lane];
      cv::v_store(&values_[c][angle][lane], slope);
      cv::v_store(sum, cv::v_load(sum) + cv::v_abs(slope));
    }
  }

  std::array<std::array<LaneRow, MEDIAN_COUNT>, 3> values_;
  std::array<LaneRow, 3> sums_;  // of the sizes
};

/**
 * Median slope of each channel at each radius, relative to the brightness there. Of grey levels: logarithms would move
 * a rising and a falling channel of one edge apart.
 */
std::vector<cv::Vec3f> medianSlopes(const RingProfile& profile)
{
  static_assert(ANGLES == static_cast<int>(MEDIAN_COUNT), "a lane holds a value of each ray");
  constexpr int LANES = SlopeLanes::LANES;
  const int reach = std::max(1, static_cast<int>(std::lround(1 / profile.step)));
  std::vector<cv::Vec3f> slopes(static_cast<std::size_t>(profile.count));
  // Up to here all rays reach; where there are fewer radii than lanes, none is taken in lanes.
  const int all = *std::min_element(profile.inside.begin(), profile.inside.end()) - reach;
  int i = reach;
  for (SlopeLanes lanes; i < all && all - reach >= LANES; i += LANES)
  {
    i = std::min(i, all - LANES);  // the last ones overlap those before
    lanes.find(profile, i, reach, &slopes[i]);
  }
  for (; i + reach < profile.count; ++i)
  {
    slopes[i] = medianSlope(profile, i, reach);
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
