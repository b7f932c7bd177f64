#include "ring_colors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "median.h"
#include "targets/boundaries/ring_deblur.h"

namespace omr
{
namespace
{
constexpr double BLURRED_WIDTH = 7;  // narrower rings have no place that the blur does not reach [px]
constexpr int MIN_DIRECTIONS = 12;   // that make a median

// Of the directions by brightness: the first few may be something else, up to PART they count.
constexpr double OUTLIERS = .05;
constexpr double PART = .25;

/** Values of three channels, and their medians. */
class Values
{
 public:
  void add(const cv::Vec3d& value)
  {
    for (int c = 0; c < 3; ++c)
    {
      values_[c].push_back(value[c]);
    }
  }

  bool empty() const
  {
    return values_[0].empty();
  }

  /** 0 without values. */
  cv::Vec3d middle()
  {
    cv::Vec3d medians;
    for (int c = 0; c < 3 && !empty(); ++c)
    {
      medians[c] = median(values_[c], static_cast<int>(values_[c].size()));
    }
    return medians;
  }

 private:
  std::array<std::vector<double>, 3> values_;
};

/** The directions that tell a boundary's step; all where too few agree. */
AngleBins shownDirections(const Boundary& boundary)
{
  return countOf(boundary.agreeing) >= MIN_DIRECTIONS ? boundary.agreeing : ~AngleBins{0};
}

/** Logarithm of the linear light: red, green, blue. @param grey B, G, R [0, 255] */
cv::Vec3d logLight(const cv::Vec3d& grey)
{
  cv::Vec3d light;
  for (int c = 0; c < 3; ++c)
  {
    light[c] = std::log(linearLight(grey[2 - c]) + DARKEST_LIGHT);
  }
  return light;
}

cv::Vec3d logLight(const LogColor& color)
{
  return logLight(cv::Vec3d(greyLevel(color[0]), greyLevel(color[1]), greyLevel(color[2])));
}
}  // namespace

std::vector<LinearColor> measureRingColors(const RingProfile& profile, const std::vector<Boundary>& boundaries,
                                           const std::vector<double>& radii)
{
  const std::size_t count = radii.size() + 1;
  std::vector<cv::Vec3d> chained(count);
  std::vector<cv::Vec3d> medians(count);
  int seen = 0;
  cv::Vec3d level;  // what the chain lacks: the light of the whole target
  for (std::size_t ring = 0; ring < count; ++ring)
  {
    const AngleBins shown = ring > 0 ? shownDirections(boundaries[ring - 1]) : 0;
    Values steps;
    Values colors;
    for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
    {
      LogColor color;
      LogColor before;
      LogColor after;
      if (ringColor(profile, radii, ring, angle, color))
      {
        colors.add(color);
      }
      // Where a shadow's edge runs, the two sides of the boundary are still under one light.
      if ((shown >> angle & 1) != 0 && ringColor(profile, radii, ring - 1, angle, before, RingPart::outer_rim) &&
          ringColor(profile, radii, ring, angle, after, RingPart::inner_rim))
      {
        steps.add(logLight(after) - logLight(before));
      }
    }
    chained[ring] = ring > 0 ? chained[ring - 1] + steps.middle() : cv::Vec3d();
    medians[ring] = colors.empty() ? cv::Vec3d() : logLight(LogColor(colors.middle()));
    if ((ring == 0 || boundaries[ring - 1].shown) && (ring + 1 == count || boundaries[ring].shown))
    {
      level += medians[ring] - chained[ring];
      ++seen;
    }
  }
  level *= 1. / std::max(1, seen);
  if (narrowestRing(radii) < BLURRED_WIDTH)
  {
    const std::vector<cv::Vec3d> deblurred = deblurredColors(profile, radii);
    for (std::size_t ring = 0; ring < count; ++ring)
    {
      chained[ring] += logLight(deblurred[ring]) - medians[ring];
    }
  }
  std::vector<LinearColor> colors;
  for (const cv::Vec3d& color : chained)
  {
    LinearColor linear;
    for (int c = 0; c < 3; ++c)
    {
      linear[c] = std::max(1e-4, std::exp(color[c] + level[c]) - DARKEST_LIGHT);
    }
    colors.push_back(linear);
  }
  return colors;
}

std::vector<LinearColor> measureColorsIn(Light light, const RingProfile& profile, const std::vector<double>& radii)
{
  std::vector<LinearColor> colors;
  for (std::size_t ring = 0; ring <= radii.size(); ++ring)
  {
    std::vector<std::pair<double, LinearColor>> by_brightness;
    for (int angle = 0; angle < RingProfile::ANGLES; ++angle)
    {
      LogColor color;
      if (ringColor(profile, radii, ring, angle, color))
      {
        const LinearColor linear(linearLight(greyLevel(color[2])), linearLight(greyLevel(color[1])),
                                 linearLight(greyLevel(color[0])));
        by_brightness.emplace_back(linear[0] + linear[1] + linear[2], linear);
      }
    }
    std::sort(by_brightness.begin(), by_brightness.end(), [&](const auto& left, const auto& right) {
      return light == Light::brightest ? left.first > right.first : left.first < right.first;
    });
    const auto from = static_cast<std::size_t>(OUTLIERS * static_cast<double>(by_brightness.size()));
    const auto to = std::max(from + 1, static_cast<std::size_t>(PART * static_cast<double>(by_brightness.size())));
    LinearColor sum(1e-4, 1e-4, 1e-4);
    for (std::size_t i = from; i < std::min(to, by_brightness.size()); ++i)
    {
      sum += by_brightness[i].second * (1. / static_cast<double>(to - from));
    }
    colors.push_back(sum);
  }
  return colors;
}

}  // namespace omr
