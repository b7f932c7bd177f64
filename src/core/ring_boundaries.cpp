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
constexpr double MIN_SLOPE = .02;       // of the logarithm over two pixels
constexpr double MIN_CONTRAST = .12;    // of the logarithms, length over three channels
constexpr double MIN_AGREEMENT = .5;

using Values = std::array<float, ANGLES>;

float median(Values& values, int count)
{
  std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
  return values[count / 2];
}

/** Median slope of each radius, as a length over the three channels. */
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
        const LogColor slope = profile.ray(angle)[i + reach] - profile.ray(angle)[i - reach];
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
      const double curvature = slopes[i - 1] + slopes[i + 1] - 2 * slopes[i];
      const double offset = curvature < 0 ? std::clamp(.5 * (slopes[i - 1] - slopes[i + 1]) / curvature, -.5, .5) : 0;
      radii.push_back((i + offset) * profile.step);
    }
  }
  return radii;
}

/** Mean colours of one ray between two radii. @return false where the ray has left the image. */
bool plateau(const RingProfile& profile, int angle, double from, double to, LogColor& color)
{
  const int first = static_cast<int>(std::lround(from / profile.step));
  const int last = std::max(first, static_cast<int>(std::lround(to / profile.step)));
  if (last >= profile.inside[angle])
  {
    return false;
  }
  color = LogColor();
  for (int i = first; i <= last; ++i)
  {
    color += profile.ray(angle)[i];
  }
  color *= 1.F / (last - first + 1);
  return true;
}

/** The part of ring k that its edges do not blur; k = radii.size() is what lies around. */
std::pair<double, double> plateauOf(const std::vector<double>& radii, std::size_t k, double limit)
{
  constexpr double MARGIN = .3;
  const double inner = k > 0 ? radii[k - 1] : 0;
  const double last_width = radii.back() - (radii.size() > 1 ? radii[radii.size() - 2] : 0);
  const double outer = k < radii.size() ? radii[k] : std::min(limit, radii.back() + std::max(3., .7 * last_width));
  const double margin = std::max(MARGIN * (outer - inner), std::min(1.5, .45 * (outer - inner)));
  return {inner + margin, outer - margin};
}

Boundary measure(const RingProfile& profile, const std::vector<double>& radii, std::size_t k)
{
  const double limit = (profile.count - 1) * profile.step;
  const auto inside = plateauOf(radii, k, limit);
  const auto outside = plateauOf(radii, k + 1, limit);
  std::array<LogColor, ANGLES> steps;
  std::array<Values, 3> values;
  int count = 0;
  LogColor sum;
  double length_sum = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    LogColor before;
    LogColor after;
    if (plateau(profile, angle, inside.first, inside.second, before) &&
        plateau(profile, angle, outside.first, outside.second, after))
    {
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
    agreeing += along > .4 * squared && along < 2.5 * squared ? 1 : 0;
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
