#include "arc_circles.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double MIN_CIRCLE = 1;  // turning of the arcs of one circle
// Perspective moves circles apart from the common centre, and spreads the radii of their arcs.
constexpr double CIRCLE_HALF_WIDTH = .04;  // of the radii of one circle's arcs
constexpr double CIRCLE_CLEARANCE = .07;   // between two circles, relative to the radius
constexpr double CIRCLE_SLACK = .5;        // more [px]
constexpr double FARTHEST_NEXT = 2.5;      // ratio of a circle's radius to the next smaller one's
}  // namespace

std::vector<double> circlesOf(std::vector<ArcRadius> arcs)
{
  std::sort(arcs.begin(), arcs.end());
  std::vector<double> radii;
  double clearest = 0;
  while (!arcs.empty())
  {
    double most = 0;
    double radius = 0;
    for (const ArcRadius& arc : arcs)
    {
      const double half = CIRCLE_HALF_WIDTH * arc.first + CIRCLE_SLACK;
      double turning = 0;
      double sum = 0;
      for (auto other = std::lower_bound(arcs.begin(), arcs.end(), ArcRadius(arc.first - half, 0));
           other != arcs.end() && other->first <= arc.first + half; ++other)
      {
        turning += other->second;
        sum += other->first * other->second;
      }
      if (turning > most)
      {
        most = turning;
        radius = sum / turning;
      }
    }
    if (most < MIN_CIRCLE)
    {
      break;
    }
    clearest = clearest == 0 ? radius : clearest;
    radii.push_back(radius);
    const double clearance = CIRCLE_CLEARANCE * radius + 2 * CIRCLE_SLACK;
    arcs.erase(std::remove_if(arcs.begin(), arcs.end(),
                              [&](const ArcRadius& arc) { return std::abs(arc.first - radius) < clearance; }),
               arcs.end());
  }
  std::sort(radii.begin(), radii.end());
  for (std::size_t k = 0; k + 1 < radii.size(); ++k)
  {
    if (radii[k] >= clearest && radii[k + 1] > FARTHEST_NEXT * radii[k])
    {
      radii.resize(k + 1);
    }
  }
  return radii;
}

}  // namespace omr
