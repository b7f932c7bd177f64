#include "ring_seeds.h"

#include <algorithm>
#include <cmath>

namespace omr
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
constexpr double PARALLELOGRAM = .955;
constexpr double PARALLELOGRAM_TOLERANCE = .02;
constexpr double ELLIPSE_BOX_TOLERANCE = .03;  // of an ellipse's box, which is 4 deviations wide
constexpr int PARALLELOGRAM_MIN_AREA = 120;    // [px]; in smaller regions pixels make the two alike

double compactness(const Region& region)
{
  const double det = region.cxx * region.cyy - region.cxy * region.cxy;
  return region.area / (4 * CV_PI * std::sqrt(std::max(1e-9, det)));
}

bool isRound(const Region& region, RingSeed& seed)
{
  const double det = region.cxx * region.cyy - region.cxy * region.cxy;
  if (region.area < MIN_AREA || det <= .2)
  {
    return false;
  }
  const double root = std::sqrt(det);
  const double filled = compactness(region);
  if (filled < LEAST_COMPACTNESS || filled > GREATEST_COMPACTNESS || isParallelogram(region))
  {
    return false;
  }
  // root = (inner^2 + outer^2) / 4.
  const double ratio = std::max(0., (1 - filled) / (1 + filled));
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

bool isParallelogram(const Region& region)
{
  const double width = region.box.width / std::sqrt(region.cxx);
  const double height = region.box.height / std::sqrt(region.cyy);
  const bool has_ellipse_box =
      std::abs(width / 4 - 1) < ELLIPSE_BOX_TOLERANCE && std::abs(height / 4 - 1) < ELLIPSE_BOX_TOLERANCE;
  return region.area > PARALLELOGRAM_MIN_AREA && !has_ellipse_box &&
         std::abs(compactness(region) - PARALLELOGRAM) < PARALLELOGRAM_TOLERANCE;
}

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

}  // namespace omr
