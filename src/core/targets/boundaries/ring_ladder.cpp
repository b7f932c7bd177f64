#include "ring_ladder.h"

#include "targets/family/ring_refinement.h"

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

constexpr double READABLE_COHERENCE = .8;
constexpr double MIN_READABLE = .5;  // agreement that tells the colours of its rings: below it glare is read
// What hides a strong step leaves the rest as it is: in "occlusion" 133 instead of 130 of 141 letters are read, all
// right. Where such a step is not read it shows in .09 of the directions and less.
constexpr double STRONG_CONTRAST = .5;
constexpr double STRONG_READABLE = .3;  // share of the directions
constexpr double MOSTLY_HIDDEN =
    .75;  // a disk's outline agrees in fewer directions: what covers it may hide rings entirely
constexpr double MERGING_WIDTH = 4.5;  // narrower rings of similar brightness merge [px]

// A boundary that shows in few directions: there it must be clear, and leave room for two rings.
constexpr double PARTIAL_RADIUS = 30;  // of the outermost boundary: in smaller ones bars and letters give arcs [px]
constexpr double PARTIAL_WIDTH = 7;    // least of a ring [px]: nearer to an edge is that one's blur
constexpr double PARTIAL_WIDTH_SHARE = .7;  // least of a ring, relative to the narrowest
constexpr double PARTIAL_STEP = .5;         // [px]
constexpr double PARTIAL_SUPPORT = .22;     // share of the directions with an edge
constexpr double PARTIAL_SHOWN = .25;       // and that agree besides
constexpr double PARTIAL_AGREEING = .6;     // of the directions with an edge
constexpr double PARTIAL_CONTRAST = .25;
constexpr double PARTIAL_COHERENCE = .85;

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

/** Whether enough of a boundary shows to tell the colours of its rings: less of a strong step, which no gloss veils. */
bool isReadable(const Boundary& boundary)
{
  return boundary.agreement > MIN_READABLE ||
         (boundary.contrast > STRONG_CONTRAST && share(boundary.agreeing & boundary.supported) > STRONG_READABLE);
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
      hidden.back().shown =
          isThere(hidden.back()) && isReadable(hidden.back()) && hidden.back().coherence > READABLE_COHERENCE;
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

void addPartialBoundaries(const RingProfile& profile, const AngularSupport& support, std::vector<Boundary>& boundaries,
                          std::vector<double>& radii)
{
  const double narrowest = narrowestRing(radii);
  while (boundaries.back().radius > PARTIAL_RADIUS && boundaries.size() < MAX_BOUNDARIES)
  {
    double best = 0;
    Boundary best_boundary;
    const int steps = static_cast<int>((boundaries.back().radius - 2 * PARTIAL_WIDTH) / PARTIAL_STEP);
    for (int step = 0; step <= steps; ++step)
    {
      const double radius = PARTIAL_WIDTH + step * PARTIAL_STEP;
      std::vector<double> measured = radiiOf(boundaries);
      const auto place = std::lower_bound(measured.begin(), measured.end(), radius);
      const double inner = place == measured.begin() ? 0 : *(place - 1);
      const double least = std::max(PARTIAL_WIDTH, PARTIAL_WIDTH_SHARE * narrowest);
      if (radius - inner < least || *place - radius < least ||
          share(support.at(radius, edgeTolerance(radius))) < PARTIAL_SUPPORT)
      {
        continue;
      }
      const auto k = static_cast<std::size_t>(place - measured.begin());
      measured.insert(place, radius);
      const Boundary boundary = measureBoundary(profile, support, measured, k);
      const double shown = share(boundary.agreeing & boundary.supported);
      if (boundary.contrast > PARTIAL_CONTRAST && boundary.coherence > PARTIAL_COHERENCE && shown > PARTIAL_SHOWN &&
          shown > PARTIAL_AGREEING * share(boundary.supported) && shown > best)
      {
        best = shown;
        best_boundary = boundary;
      }
    }
    if (best <= 0)
    {
      return;
    }
    const std::vector<double> known = radiiOf(boundaries);
    const auto k = std::lower_bound(known.begin(), known.end(), best_boundary.radius) - known.begin();
    const double scale = radii[k] / known[k];
    best_boundary.shown = isReadable(best_boundary);
    boundaries.insert(boundaries.begin() + k, best_boundary);
    radii.insert(radii.begin() + k, best_boundary.radius * scale);
  }
}

}  // namespace omr
