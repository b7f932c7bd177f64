#include "ring_ladder.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double EQUAL = 1.15;     // ratio of the widest to the narrowest of equal rings
constexpr double TOLERANCE = .12;  // of the number of rings that a wide one takes the place of
constexpr int MOST_RINGS = 3;      // that a wide one takes the place of

// A boundary of known radius shows in this share of the directions, by its colours and by edgels at once, and its steps
// are alike. In scenes with unequal rings, which contain no such boundaries, the share is 0.
constexpr double MIN_SHOWN = .25;
constexpr double MIN_COHERENCE = .7;
constexpr double MIN_CONTRAST = .12;  // of the logarithms

constexpr double MIN_READABLE = .45;  // agreement that tells the colours of its rings: below it glare is read
constexpr double MOSTLY_HIDDEN =
    .6;  // a disk's outline agrees in fewer directions: what covers it may hide rings entirely
constexpr double MERGING_WIDTH = 4.5;  // narrower rings of similar brightness merge [px]

/** How many rings of the others' width the ring takes the place of; 1 if the others differ. */
int ringsWithin(const std::vector<double>& radii, std::size_t ring)
{
  double narrowest = radii.back();
  double widest = 0;
  double sum = 0;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double width = radii[k] - (k > 0 ? radii[k - 1] : 0);
    if (k != ring)
    {
      narrowest = std::min(narrowest, width);
      widest = std::max(widest, width);
      sum += width;
    }
  }
  if (radii.size() < 3 || widest > EQUAL * narrowest)
  {
    return 1;
  }
  const double width = radii[ring] - (ring > 0 ? radii[ring - 1] : 0);
  const double ratio = width * static_cast<double>(radii.size() - 1) / sum;
  const int count = static_cast<int>(std::lround(ratio));
  return std::abs(ratio - count) < TOLERANCE * count && count <= MOST_RINGS ? count : 1;
}
bool isThere(const Boundary& boundary)
{
  return boundary.contrast > MIN_CONTRAST && boundary.coherence > MIN_COHERENCE &&
         share(boundary.agreeing & boundary.supported) > MIN_SHOWN;
}

/** Radii with those of the rings that one ring takes the place of. */
std::vector<double> divided(const std::vector<double>& radii, std::size_t ring, int count)
{
  std::vector<double> result = radii;
  const double inner = ring > 0 ? radii[ring - 1] : 0;
  for (int i = count - 1; i > 0; --i)
  {
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(ring), inner + (radii[ring] - inner) * i / count);
  }
  return result;
}
}  // namespace

void addHiddenBoundaries(const RingProfile& profile, const AngularSupport& support, std::vector<Boundary>& boundaries,
                         std::vector<double>& radii)
{
  for (std::size_t ring = 0; ring < radii.size(); ++ring)
  {
    const int count = ringsWithin(radii, ring);
    if (count < 2)
    {
      continue;
    }
    const std::vector<double> measured = divided(radiiOf(boundaries), ring, count);
    std::vector<Boundary> hidden;
    bool all_shown = true;
    for (int i = 0; i + 1 < count; ++i)
    {
      hidden.push_back(measureBoundary(profile, support, measured, ring + i));
      all_shown = all_shown && isThere(hidden.back());
      hidden.back().shown = isThere(hidden.back()) && hidden.back().agreement > MIN_READABLE;
    }
    const double width = (radii[ring] - (ring > 0 ? radii[ring - 1] : 0)) / count;
    if (all_shown || (ring == 0 && boundaries[0].agreement < MOSTLY_HIDDEN) || width < MERGING_WIDTH)
    {
      boundaries.insert(boundaries.begin() + static_cast<std::ptrdiff_t>(ring), hidden.begin(), hidden.end());
      radii = divided(radii, ring, count);
    }
    return;
  }
}

}  // namespace omr
