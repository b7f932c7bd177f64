#include "ring_roundness.h"

#include <algorithm>
#include <cmath>

#include "median.h"

namespace omr
{
namespace
{
constexpr double MIN_AGREEMENT = .78;  // where the inner neighbour agrees
constexpr double MARGIN = 1.4;
// Ground that resembles the outermost ring hides its edge in places. Where the edgels lie closely on one circle, that
// is enough: of lost outermost rings they do so in 2.4 to 2.9 times as many directions as on a square's sides, of what
// is none in up to 2.1 times. A fainter step is one of the sheet's own, as gradual light gives them.
constexpr double CLOSE = .25;  // [px]
constexpr double CLOSE_MARGIN = 2.2;
constexpr double CLOSE_CONTRAST = .3;
// Beside a small circle a square sheet ends so near in all directions that the colours agree, but not the edges: of the
// outermost white rings of targets in drawn scenes four have .27 to .41 of the edges of those inside, all of which are
// none, and 9 have .7 and more, all but one of which are rings. Large rings have .23 and more.
constexpr double SMALL_RADIUS = 30;  // [px]
constexpr double LEAST_EDGES = .5;   // relative to the boundaries inside

/** Share of the directions in which a square's sides come so near to a circle that they pass for it. */
double squareShare(double radius, double tolerance)
{
  const double relative = tolerance / radius;
  return 4 / CV_PI * std::acos((1 - relative) / (1 + relative));
}

/** Share of the directions with an edgel close to one circle of about this radius. */
double closeShare(const AngularSupport& support, double radius)
{
  double most = 0;
  for (int shift = -6; shift <= 6; ++shift)
  {
    most = std::max(most, share(support.at(radius + .5 * CLOSE * shift, CLOSE)));
  }
  return most;
}
/**
 * The directions in which half of the boundaries inside the outermost one agree; the next one alone may be a square
 * sheet's edge, as this is the edge of the plate below it: of 270 drawn ones 17 had two rings too many.
 */
AngleBins agreeingInside(const std::vector<Boundary>& boundaries)
{
  AngleBins agreeing = 0;
  for (int angle = 0; angle < ANGLE_BINS; ++angle)
  {
    std::size_t count = 0;
    for (std::size_t k = 0; k + 1 < boundaries.size(); ++k)
    {
      count += boundaries[k].agreeing >> angle & 1;
    }
    agreeing |= 2 * count >= boundaries.size() - 1 ? AngleBins{1} << angle : 0;
  }
  return agreeing;
}

double edgesOf(const Boundary& boundary)
{
  return share(boundary.agreeing & boundary.supported);
}

/** Whether the outermost boundary lacks edges that those inside have: the step to what is around a sheet, no circle. */
bool lacksEdges(const std::vector<Boundary>& boundaries)
{
  std::vector<double> inside(boundaries.size() - 1);
  std::transform(boundaries.begin(), boundaries.end() - 1, inside.begin(), edgesOf);
  return boundaries.back().radius < SMALL_RADIUS && boundaries.back().contrast > CLOSE_CONTRAST &&
         edgesOf(boundaries.back()) < LEAST_EDGES * median(inside);
}
}  // namespace

double roundness(const std::vector<Boundary>& boundaries, const AngularSupport& support)
{
  const Boundary& boundary = boundaries.back();
  const double radius = boundary.radius;
  const AngleBins inner = agreeingInside(boundaries) & boundary.seen;
  const double shared = share(inner & boundary.agreeing) / std::max(1. / ANGLE_BINS, share(inner));
  const double agreement = lacksEdges(boundaries) ? 0 : shared / MIN_AGREEMENT;
  const double result = std::max(agreement, edgesOf(boundary) / (MARGIN * squareShare(radius, edgeTolerance(radius))));
  if (result >= 1 || boundary.contrast < CLOSE_CONTRAST)
  {
    return result;
  }
  return std::max(result, closeShare(support, radius) / (CLOSE_MARGIN * squareShare(radius, CLOSE)));
}

}  // namespace omr
