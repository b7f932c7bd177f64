#include "ring_openness.h"

#include <algorithm>

namespace omr
{
namespace
{
constexpr double COSINE = .9;
constexpr double TOLERANCE = 1.5;           // of a boundary's place [px]
constexpr double RELATIVE_TOLERANCE = .03;  // relative to its radius
constexpr double CLEARANCE = .4;            // at most, of the distance to the next one
constexpr double OPEN_SHARE = .6;           // of the boundaries, that have an edge

}  // namespace

AngleBins openDirections(EdgelMap& map, const Rings& rings)
{
  const double reach = (1 + 2 * RELATIVE_TOLERANCE) * rings.radii.back() + 2 * TOLERANCE;
  std::vector<RadialEdgel> edgels;
  collectRadialEdgels(map, rings.family, reach, COSINE, edgels);
  const AngularSupport support(edgels, reach);
  std::vector<AngleBins> edged;
  for (std::size_t k = 0; k < rings.radii.size(); ++k)
  {
    const double radius = rings.radii[k];
    double clearance = radius - (k > 0 ? rings.radii[k - 1] : 0);
    clearance = k + 1 < rings.radii.size() ? std::min(clearance, rings.radii[k + 1] - radius) : clearance;
    edged.push_back(
        support.at(radius, std::min(CLEARANCE * clearance, std::max(TOLERANCE, RELATIVE_TOLERANCE * radius))));
  }
  AngleBins open = 0;
  for (int angle = 0; angle < ANGLE_BINS; ++angle)
  {
    const auto count =
        std::count_if(edged.begin(), edged.end(), [&](AngleBins bins) { return (bins >> angle & 1) != 0; });
    open |= static_cast<double>(count) >= OPEN_SHARE * static_cast<double>(edged.size()) ? AngleBins{1} << angle : 0;
  }
  return open & (turned(open, 1) | turned(open, ANGLE_BINS - 1));  // single ones are chance
}

}  // namespace omr
