#include "ring_beyond.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "targets/family/angle_bins.h"

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr double REACH = 1;           // to either side of an edge [px]
constexpr double MARGIN = 1.5;        // from the outermost boundary to the first edge beyond, least [px]
constexpr double MARGIN_SHARE = .35;  // of the width of the narrowest ring
constexpr float LEAST_STEP = .15F;    // of the logarithms
constexpr double TOLERANCE = .6;      // of an edge's place [px]
constexpr double RELATIVE_TOLERANCE = .008;
constexpr double ALIKE = .7;  // cosine between the steps of one arc
// Of the directions, and of the image, least. Of 1650 targets in drawn scenes 21 have such an arc, of which 19 lack a
// ring; nearer to the outermost boundary lie the halos of sharpening.
constexpr double LONG_ARC = .3;
constexpr double LEAST_WIDTH = 2.2;        // of the further ring [px]
constexpr double LEAST_WIDTH_SHARE = .72;  // relative to the narrowest

/** Where the colours along a ray change first. */
struct Step
{
  double radius = -1;  // none
  LogColor change;
};

Step firstStep(const RingProfile& profile, int angle, double from)
{
  const int reach = std::max(1, static_cast<int>(std::lround(REACH / profile.step)));
  const LogColor* ray = profile.ray(angle);
  const int end = profile.inside[angle] - reach;
  const auto size = [&](int i) { return cv::norm(ray[i + reach] - ray[i - reach]); };
  for (int i = std::max(reach + 1, static_cast<int>(from / profile.step)); i + 1 < end; ++i)
  {
    const double here = size(i);
    if (here > LEAST_STEP && here >= size(i - 1) && here > size(i + 1))
    {
      return {i * profile.step, ray[i + reach] - ray[i - reach]};
    }
  }
  return {};
}

/** Directions whose first steps lie on one circle and are alike. */
struct Arc
{
  double radius = 0;  // [px]
  int run = 0;        // of directions side by side
  int count = 0;      // of all
};

Arc arcAround(const Step& middle, const std::array<Step, ANGLES>& steps)
{
  const double tolerance = std::max(TOLERANCE, RELATIVE_TOLERANCE * middle.radius);
  AngleBins alike = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    const Step& step = steps[angle];
    const bool is_alike = std::abs(step.radius - middle.radius) <= tolerance &&
                          step.change.dot(middle.change) > ALIKE * cv::norm(step.change) * cv::norm(middle.change);
    alike |= is_alike ? AngleBins{1} << angle : 0;
  }
  return {middle.radius, longestRun(alike), countOf(alike)};
}
}  // namespace

bool showsArcBeyond(const RingProfile& profile, const std::vector<double>& radii, int scale)
{
  std::array<Step, ANGLES> steps;
  const double narrowest = narrowestRing(radii);
  const double from = radii.back() + std::max(MARGIN, MARGIN_SHARE * narrowest);
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    steps[angle] = firstStep(profile, angle, from);
  }
  Arc longest;
  for (const Step& middle : steps)
  {
    const Arc arc = middle.radius < 0 ? Arc() : arcAround(middle, steps);
    if (std::make_pair(arc.run, arc.count) > std::make_pair(longest.run, longest.count))
    {
      longest = arc;
    }
  }
  return longest.run > LONG_ARC * ANGLES &&
         longest.radius - radii.back() > std::max(LEAST_WIDTH * scale, LEAST_WIDTH_SHARE * narrowest);
}

}  // namespace omr
