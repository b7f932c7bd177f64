#include "ring_candidate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ring_acceptance.h"
#include "ring_amendment.h"
#include "ring_openness.h"
#include "ring_own_boundary.h"
#include "targets/boundaries/ring_ladder.h"
#include "targets/family/ring_refinement.h"

namespace omr
{
namespace
{
constexpr int MAX_ROUNDS = 4;
constexpr std::size_t ENOUGH_KNOWN = 3;  // boundaries that need not be grown
constexpr double GROWN = 1.02;           // ratio of radii: beyond it there may be further boundaries
constexpr double SAME_PLACE = .3;        // [px]: the profile needs no further look
constexpr double KNOWN_REACH = 1.3;      // how far to look around fewer, relative to the outermost
constexpr double KNOWN_GATE = .06;       // of the outermost known boundary: perspective moves their centres apart

// Of rings that may be bent.
constexpr int BENT_RINGS = 3;
constexpr double BENT_RADIUS = 12;  // [px]
constexpr double BENT_EVIDENCE = .65;
constexpr double BENT_RMS = .1;  // of what lies on a plane, most [px]
constexpr double BENT_RELATIVE_RMS = .002;
constexpr double BENT_GAIN = .75;  // of the root mean square, at least
constexpr double SMALL_GAIN = .6;  // of rings of less than SMALL_BENT_RADIUS, whose few edgels a bend fits easily
constexpr double SMALL_BENT_RADIUS = 25;  // [px]

// Of rings that something hides in the other directions.
constexpr int OPEN_RINGS = 3;
constexpr int OPEN_ROUNDS = 3;
constexpr int OPEN_SETTLING = 2;  // rounds, after each of which the directions are looked at anew
constexpr double LEAST_OPEN = .3;
constexpr double MOST_OPEN = .9;

constexpr double CLEAR_CONTRAST = .5;
constexpr double CLEAR_SUPPORT = .45;
constexpr double CLEAR_AGREEMENT = .85;
constexpr double COVERED_RADIUS = 5;  // smaller disks have no edge of their own in the blur [px]
// A pole across a small disk leaves no place of it that the blur does not mix. Of 13000 rings in drawn and path-traced
// scenes four become '?' so, of which two were read in the pole's colour.
constexpr double SMALL_DISK = 7;  // radius [px]
constexpr double SMALL_SUPPORT = .6;
constexpr double SMALL_AGREEMENT = .75;
constexpr double SPLIT_EVIDENCE = .8;
constexpr double SPLIT_WIDTH = 7;  // narrower rings may merge [px]

/** How far beyond the outermost boundary another may lie. */
double profileReach(const Rings& rings)
{
  double widest = 0;
  double inner = 0;
  for (const double radius : rings.radii)
  {
    widest = std::max(widest, radius - inner);
    inner = radius;
  }
  return rings.radii.back() + std::min(2.5 * widest, rings.radii.back()) + 3;
}

/** Mean over the boundaries of coherence times the share of the visible directions that agree and have an edge. */
double evidenceOf(const std::vector<Boundary>& boundaries, AngleBins visible)
{
  double sum = 0;
  for (const Boundary& boundary : boundaries)
  {
    sum += boundary.coherence * (share(boundary.agreeing & visible) + share(boundary.supported & visible)) / 2;
  }
  return sum / (static_cast<double>(boundaries.size()) * std::max(1e-9, share(visible)));
}

/** How far the outermost boundary lies from where another family has it [px]. */
double shift(const RingFamily& family, const Rings& rings)
{
  double farthest = 0;
  for (const cv::Point2d& direction : {cv::Point2d(1, 0), cv::Point2d(0, 1), cv::Point2d(-1, 0), cv::Point2d(0, -1)})
  {
    const cv::Point2d q = rings.radii.back() * direction;
    farthest = std::max(farthest, cv::norm(family.toImage(q) - rings.family.toImage(q)));
  }
  return farthest;
}

/** Looks for boundaries and refines the rings with them, in turns. */
bool settle(EdgelMap& map, const cv::Mat& bgr, RingCandidate& candidate, std::vector<RadialEdgel>& edgels)
{
  Rings& rings = candidate.rings;
  const auto profile = std::make_shared<RingProfile>();
  candidate.profile = profile;
  const int rounds = ~rings.open != 0 ? OPEN_SETTLING : MAX_ROUNDS;
  for (int round = 0; round < rounds; ++round)
  {
    if (map.isSpent())
    {
      return false;
    }
    const double reach = profileReach(rings);
    sampleProfile(bgr, rings.family, reach, *profile, rings.open);
    collectRadialEdgels(map, rings.family, reach, .92, edgels);
    keepDirections(rings.open, edgels);
    candidate.boundaries = findBoundaries(*profile, AngularSupport(edgels, reach), rings.radii);
    if (candidate.boundaries.size() < 2 || (~rings.open != 0 && !showsEnough(candidate)))
    {
      return false;
    }
    const Rings before = rings;
    rings.radii = radiiOf(candidate.boundaries);
    rings.radii.resize(std::min<std::size_t>(rings.radii.size(), MAX_BOUNDARIES));
    if (!refineRings(map, std::max(1., .012 * rings.radii.back()), true, rings))
    {
      return false;
    }
    if (rings.radii.back() < GROWN * before.radii.back() && shift(before.family, rings) < SAME_PLACE)
    {
      break;
    }
  }
  candidate.boundaries.resize(rings.radii.size());
  weighEvidence(candidate);
  return true;
}

/** Whether the rings are so clear that they would fit better, if their sheet were plane. */
bool looksBent(const RingCandidate& candidate)
{
  const double radius = candidate.rings.radii.back();
  return candidate.boundaries.size() >= std::size_t{BENT_RINGS} && radius > BENT_RADIUS &&
         candidate.evidence > BENT_EVIDENCE && candidate.rings.rms > BENT_RMS + BENT_RELATIVE_RMS * radius;
}

/** Takes the sheet as bent where that explains the rings better. */
void tryBend(EdgelMap& map, const cv::Mat& bgr, RingCandidate& candidate, std::vector<RadialEdgel>& edgels)
{
  RingCandidate bent = candidate;
  const double gain = candidate.rings.radii.back() < SMALL_BENT_RADIUS ? SMALL_GAIN : BENT_GAIN;
  std::vector<RadialEdgel> bent_edgels;
  if (bendRings(map, bent.rings) && settle(map, bgr, bent, bent_edgels) && bent.rings.rms < gain * candidate.rings.rms)
  {
    candidate = std::move(bent);
    edgels.swap(bent_edgels);
  }
}

/** Whether what is seen of a disk is a thing that lies on it. */
bool isCovered(const Boundary& disk, AngleBins open)
{
  if (disk.radius < COVERED_RADIUS)
  {
    return false;
  }
  const double support = share(disk.supported) / share(open);
  const bool lacks_edge =  // that so strong a step has
      disk.contrast > CLEAR_CONTRAST && support < CLEAR_SUPPORT && disk.agreement < CLEAR_AGREEMENT;
  return lacks_edge ||
         (disk.radius < SMALL_DISK && support < SMALL_SUPPORT && share(disk.agreeing) < SMALL_AGREEMENT * share(open));
}

/** Finds out which boundaries there are in the open directions, inside those of the candidate's rings and outside. */
bool completeOpen(EdgelMap& map, const cv::Mat& bgr, RingCandidate& candidate)
{
  candidate.image_size = bgr.size();
  Rings& rings = candidate.rings;
  std::vector<RadialEdgel> edgels;
  if (!settle(map, bgr, candidate, edgels))
  {
    return false;
  }
  if (looksBent(candidate))
  {
    tryBend(map, bgr, candidate, edgels);
  }
  if (candidate.evidence > SPLIT_EVIDENCE && narrowestRing(rings.radii) < SPLIT_WIDTH)
  {
    const AngularSupport support(edgels, profileReach(rings));
    splitMergedRings(support, candidate);
    widenSeam(support, candidate);
  }
  addPartialBoundaries(*candidate.profile, AngularSupport(edgels, profileReach(rings)), candidate.boundaries,
                       rings.radii);
  Boundary& disk = candidate.boundaries.front();
  disk.shown = disk.shown && !isCovered(disk, rings.open);
  candidate.ring_count = static_cast<int>(candidate.boundaries.size());
  addHiddenBoundaries(*candidate.profile, AngularSupport(edgels, profileReach(rings)), candidate.boundaries,
                      rings.radii);
  return true;
}

/** The same from the directions alone in which nothing hides the rings; nothing is changed if that gives no target. */
void tryOpenDirections(EdgelMap& map, const cv::Mat& bgr, const Rings& start, RingCandidate& candidate)
{
  EdgelMap own = map;  // these looks do not count: few rings come so far, 90 in 391 pictures of clutter
  RingCandidate open;
  open.rings = start;
  std::vector<RadialEdgel> edgels;
  for (int round = 0; round < OPEN_ROUNDS; ++round)
  {
    const AngleBins before = open.rings.open;
    open.rings.open = openDirections(own, open.rings);
    if (open.rings.open == before)
    {
      break;
    }
    const double seen = share(open.rings.open);
    if (seen < LEAST_OPEN || seen > MOST_OPEN || !settle(own, bgr, open, edgels))
    {
      return;
    }
  }
  // A third of those that come so far end here: 12 % of the time that open directions take.
  if (maySuffice(open) && completeOpen(own, bgr, open) && isTarget(open, OPEN_RINGS))
  {
    candidate = std::move(open);
  }
}

bool complete(EdgelMap& map, const cv::Mat& bgr, RingCandidate& candidate)
{
  const Rings start = candidate.rings;
  if (completeOpen(map, bgr, candidate) && isClearTarget(candidate, OPEN_RINGS))
  {
    return true;
  }
  if (start.radii.size() >= std::size_t{OPEN_RINGS})
  {
    tryOpenDirections(map, bgr, start, candidate);
  }
  return candidate.ring_count > 0;
}
}  // namespace

void weighEvidence(RingCandidate& candidate)
{
  const AngleBins visible = visibleDirections(candidate.boundaries);
  candidate.visible = share(visible);
  candidate.evidence = evidenceOf(candidate.boundaries, visible);
}

AngleBins visibleDirections(const std::vector<Boundary>& boundaries)
{
  AngleBins visible = 0;
  for (int angle = 0; angle < ANGLE_BINS; ++angle)
  {
    std::size_t shown = 0;
    for (const Boundary& boundary : boundaries)
    {
      shown += (boundary.agreeing | boundary.supported) >> angle & 1;
    }
    visible |= 2 * shown >= boundaries.size() ? AngleBins{1} << angle : 0;
  }
  return visible;
}

bool growCandidate(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed, bool is_boundary, RingCandidate& candidate)
{
  Rings& rings = candidate.rings;
  rings.family = seed.family;
  rings.radii.assign(is_boundary ? 1 : 0, seed.radius + 1.2);
  return growRings(map, seed.radius * (is_boundary ? 2.4 : 1.5) + 6, rings) && complete(map, bgr, candidate);
}

bool growCandidate(EdgelMap& map, const cv::Mat& bgr, const RingFamily& family, const std::vector<double>& radii,
                   RingCandidate& candidate)
{
  Rings& rings = candidate.rings;
  rings = {family, radii, 0};
  if (radii.size() < ENOUGH_KNOWN)
  {
    return growRings(map, KNOWN_REACH * radii.back() + 6, rings) && complete(map, bgr, candidate);
  }
  // Where the edgels do not fit, the profile may still tell.
  refineRings(map, std::max(1.5, KNOWN_GATE * radii.back()), true, rings);
  return complete(map, bgr, candidate);
}

}  // namespace omr
