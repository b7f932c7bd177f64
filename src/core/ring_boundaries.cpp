#include "ring_boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace outdoor_omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr int MIN_ANGLES = ANGLES / 2;  // that must lie inside the image
constexpr double MIN_WIDTH = 1.8;       // of a ring [px]
constexpr double MIN_SLOPE = .01;       // over two pixels, relative to twice the brightness
constexpr float DARK_LEVEL = 48;        // added to twice the brightness [grey levels]
constexpr double VALLEY = .6;           // of the slope between two boundaries, relative to the weaker one
constexpr double MIN_CONTRAST = .12;    // of the logarithms, length over three channels
constexpr double MIN_AGREEMENT = .5;

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
 * Median slope of each radius relative to the brightness there, as a length over the three channels. Of grey levels:
 * logarithms would move a rising and a falling channel of one edge apart.
 */
std::vector<double> medianSlopes(const RingProfile& profile)
{
  const int reach = std::max(1, static_cast<int>(std::lround(1 / profile.step)));
  std::vector<double> slopes(static_cast<std::size_t>(profile.count), 0.);
  for (int i = reach; i + reach < profile.count; ++i)
  {
    std::array<Values, 3> values;
    int count = 0;
    for (int angle = 0; angle < ANGLES; ++angle)
    {
      if (i + reach < profile.inside[angle])
      {
        const cv::Vec3f& inner = profile.greyRay(angle)[i - reach];
        const cv::Vec3f& outer = profile.greyRay(angle)[i + reach];
        const cv::Vec3f slope = (outer - inner) * (1 / (brightest(inner) + brightest(outer) + DARK_LEVEL));
        for (int c = 0; c < 3; ++c)
        {
          values[c][count] = slope[c];
        }
        ++count;
      }
    }
    if (count >= MIN_ANGLES)
    {
      const LogColor change(median(values[0], count), median(values[1], count), median(values[2], count));
      slopes[i] = cv::norm(change);
    }
  }
  return slopes;
}

/** Radii at which the slope has a maximum. */
std::vector<double> candidates(const RingProfile& profile)
{
  const std::vector<double> slopes = medianSlopes(profile);
  const int reach = std::max(1, static_cast<int>(MIN_WIDTH * .6 / profile.step));
  std::vector<double> radii;
  for (int i = 1; i + 1 < profile.count; ++i)
  {
    const auto first = slopes.begin() + std::max(0, i - reach);
    const auto last = slopes.begin() + std::min(profile.count, i + reach + 1);
    if (slopes[i] > MIN_SLOPE && std::max_element(first, last) == slopes.begin() + i)
    {
      if (!radii.empty())
      {
        // One edge may give two maxima; between two edges the slope falls.
        const int before = static_cast<int>(std::lround(radii.back() / profile.step));
        const double valley = *std::min_element(slopes.begin() + before, slopes.begin() + i);
        if (valley > VALLEY * std::min(slopes[i], slopes[before]))
        {
          if (slopes[i] <= slopes[before])
          {
            continue;
          }
          radii.pop_back();
        }
      }
      const double curvature = slopes[i - 1] + slopes[i + 1] - 2 * slopes[i];
      const double offset = curvature < 0 ? std::clamp(.5 * (slopes[i - 1] - slopes[i + 1]) / curvature, -.5, .5) : 0;
      radii.push_back((i + offset) * profile.step);
    }
  }
  return radii;
}

/** How far to either side of a boundary its whole step shows [px]. */
double stepReach(const std::vector<double>& radii, std::size_t k)
{
  const double inside = radii[k] - (k > 0 ? radii[k - 1] : 0);
  const double outside = k + 1 < radii.size() ? radii[k + 1] - radii[k] : inside;
  return std::min({.5 * inside, .5 * outside, std::max(2., .02 * radii[k])});
}

Boundary measure(const RingProfile& profile, const std::vector<double>& radii, std::size_t k)
{
  const double reach = stepReach(radii, k);
  const int inner = static_cast<int>(std::lround((radii[k] - reach) / profile.step));
  const int outer = static_cast<int>(std::lround((radii[k] + reach) / profile.step));
  std::array<LogColor, ANGLES> steps;
  std::array<LogColor, ANGLES> local_steps;
  std::array<Values, 3> values;
  int count = 0;
  LogColor sum;
  double length_sum = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    LogColor before;
    LogColor after;
    if (outer < profile.inside[angle] && ringColor(profile, radii, k, angle, before) &&
        ringColor(profile, radii, k + 1, angle, after))
    {
      local_steps[count] = profile.ray(angle)[outer] - profile.ray(angle)[inner];
      steps[count] = after - before;
      sum += steps[count];
      length_sum += cv::norm(steps[count]);
      for (int c = 0; c < 3; ++c)
      {
        values[c][count] = steps[count][c];
      }
      ++count;
    }
  }
  Boundary boundary;
  boundary.radius = radii[k];
  if (count < MIN_ANGLES)
  {
    return boundary;
  }
  boundary.change = LogColor(median(values[0], count), median(values[1], count), median(values[2], count));
  boundary.contrast = cv::norm(boundary.change);
  boundary.coherence = length_sum > 0 ? cv::norm(sum) / length_sum : 0;
  int agreeing = 0;
  for (int i = 0; i < count; ++i)
  {
    const double along = steps[i].dot(boundary.change);
    const double squared = boundary.contrast * boundary.contrast;
    const double here = local_steps[i].dot(boundary.change);
    agreeing += along > .4 * squared && along < 2.5 * squared && here > .35 * squared ? 1 : 0;
  }
  boundary.agreement = agreeing / static_cast<double>(count);
  return boundary;
}
}  // namespace

std::vector<Boundary> findBoundaries(const RingProfile& profile)
{
  std::vector<double> radii = candidates(profile);
  std::vector<Boundary> boundaries;
  while (!radii.empty())
  {
    boundaries.clear();
    std::size_t worst = 0;
    double worst_quality = 1;
    for (std::size_t k = 0; k < radii.size(); ++k)
    {
      boundaries.push_back(measure(profile, radii, k));
      const Boundary& boundary = boundaries.back();
      const double quality = std::min(boundary.agreement / MIN_AGREEMENT, boundary.contrast / MIN_CONTRAST);
      if (quality < worst_quality)
      {
        worst = k;
        worst_quality = quality;
      }
    }
    if (worst_quality >= 1)
    {
      return boundaries;
    }
    radii.erase(radii.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return {};
}

}  // namespace outdoor_omr
