#include "ring_seeds.h"

#include <algorithm>
#include <cmath>

namespace outdoor_omr
{
namespace
{
constexpr int MIN_AREA = 8;            // [px]
constexpr double MAX_ASPECT = 4.2;     // of the ellipse
constexpr double BOX_TOLERANCE = .09;  // of the box that the moments predict
constexpr double BOX_SLACK = 1.6;      // [px]
constexpr double CENTER_TOLERANCE = .05;
constexpr double CENTER_SLACK = .8;  // [px]

// Compactness A / (4 pi sqrt(det C)) does not change under affine maps: 1 for ellipses, (1 - t) / (1 + t) for annuli
// with the inner radius squared t times the outer, .955 for parallelograms.
constexpr double LEAST_COMPACTNESS = .06;
constexpr double GREATEST_COMPACTNESS = 1.06;
constexpr double SQUARE_LOW = .925;
constexpr double SQUARE_HIGH = .972;
constexpr int SQUARE_MIN_AREA = 120;  // [px]; in smaller regions pixels make the two alike

bool isRound(const Region& region, RingSeed& seed)
{
  const double det = region.cxx * region.cyy - region.cxy * region.cxy;
  if (region.area < MIN_AREA || det <= .2)
  {
    return false;
  }
  const double root = std::sqrt(det);
  const double compactness = region.area / (4 * CV_PI * root);
  if (compactness < LEAST_COMPACTNESS || compactness > GREATEST_COMPACTNESS ||
      (region.area > SQUARE_MIN_AREA && compactness > SQUARE_LOW && compactness < SQUARE_HIGH))
  {
    return false;
  }
  // root = (inner^2 + outer^2) / 4.
  const double ratio = std::max(0., (1 - compactness) / (1 + compactness));
  seed.radius = std::sqrt(4 * root / (1 + ratio));
  const double scale = seed.radius / std::sqrt(root);
  const double half_width = scale * std::sqrt(region.cxx);
  const double half_height = scale * std::sqrt(region.cyy);
  const double middle_x = region.box.x + (region.box.width - 1) / 2.;
  const double middle_y = region.box.y + (region.box.height - 1) / 2.;
  const bool fills_box = std::abs(region.box.width - 2 * half_width) < 2 * BOX_TOLERANCE * half_width + BOX_SLACK &&
                         std::abs(region.box.height - 2 * half_height) < 2 * BOX_TOLERANCE * half_height + BOX_SLACK &&
                         std::abs(middle_x - region.center.x) < 2 * CENTER_TOLERANCE * half_width + CENTER_SLACK &&
                         std::abs(middle_y - region.center.y) < 2 * CENTER_TOLERANCE * half_height + CENTER_SLACK;
  return fills_box && familyFromMoments(region.center, region.cxx, region.cxy, region.cyy, seed.family) &&
         seed.family.aspect() < MAX_ASPECT;
}
}  // namespace

std::vector<RingSeed> findRoundSeeds(const std::vector<Region>& regions)
{
  std::vector<RingSeed> seeds;
  for (const Region& region : regions)
  {
    RingSeed seed;
    if (isRound(region, seed))
    {
      seeds.push_back(seed);
    }
  }
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const RingSeed& left, const RingSeed& right) { return left.radius < right.radius; });
  return seeds;
}

}  // namespace outdoor_omr
