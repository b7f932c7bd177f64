#include "ring_candidate.h"

#include <algorithm>
#include <cmath>

#include "ring_deblur.h"
#include "ring_ladder.h"
#include "ring_refinement.h"

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

constexpr double CLEAR_CONTRAST = .5;
constexpr double CLEAR_SUPPORT = .45;
constexpr double CLEAR_AGREEMENT = .85;
constexpr double COVERED_RADIUS = 5;  // smaller disks have no edge of their own in the blur [px]
constexpr double SPLIT_EVIDENCE = .8;
constexpr double SPLIT_WIDTH = 7;  // narrower rings may merge [px]
constexpr int MOST_SPLITS = 2;

// The classes of isTarget(). Its limits separate the candidates of 250 pictures with 515 targets from those of 97 with
// clutter: circular things of three rings and less than 15 px (lenses, letters) are the nearest to targets.
constexpr int MANY_RINGS = 4;
constexpr double SMALL_RADIUS = 15;       // [px]
constexpr double LARGE_RADIUS = 25;       // [px]
constexpr double SMALLEST_DISK = 2;       // radius [px]
constexpr double MOSTLY_VISIBLE = .8;     // of the directions
constexpr double LEAST_VISIBLE = .66;     // round arches show .5 to .65
constexpr double PERSPECTIVE_SLACK = .1;  // of h R: bent sheets, and the uncertainty of small targets

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

/** Directions in which at least half of the boundaries show: an occluder hides several rings at once. */
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

/**
 * Strongest perspective |h| of a plane whose small circles have this aspect: sin(tilt) over the focal length in pixels,
 * the latter at least half the image's longer side (a field of view of 90 degrees).
 */
double largestPerspective(const RingFamily& family, const cv::Size& image_size)
{
  const double aspect = family.aspect();
  return std::sqrt(std::max(0., 1 - 1 / (aspect * aspect)) * aspect) /
         (.5 * std::max(image_size.width, image_size.height));
}

/** Whether the colour changes alike across the circle in many directions: a look that needs no edges. */
bool changesAlike(const cv::Mat& bgr, const RingFamily& family, double radius)
{
  constexpr int LOOKS = 24;             // directions
  constexpr double REACH = .08;         // of the radius, to either side
  constexpr double MIN_REACH = 1.5;     // [px]
  constexpr float DARK_LEVEL = 48;      // added to the brightness of both sides [grey levels]
  constexpr float FAINT = .05F;         // relative change that counts half
  constexpr double MIN_COHERENCE = .4;  // the same targets as without this look, in all development sets
  const double reach = std::max(MIN_REACH, REACH * radius);
  const cv::Rect image(cv::Point(), bgr.size());
  cv::Vec3f sum(0, 0, 0);
  int count = 0;
  for (int i = 0; i < LOOKS; ++i)
  {
    const double phi = 2 * CV_PI * i / LOOKS;
    const cv::Point2d direction(std::cos(phi), std::sin(phi));
    const cv::Point inner = family.toImage((radius - reach) * direction);
    const cv::Point outer = family.toImage((radius + reach) * direction);
    if (image.contains(inner) && image.contains(outer))
    {
      const cv::Vec3f inside = bgr.at<cv::Vec3b>(inner);
      const cv::Vec3f outside = bgr.at<cv::Vec3b>(outer);
      const float brightness =
          std::max({inside[0], inside[1], inside[2]}) + std::max({outside[0], outside[1], outside[2]}) + DARK_LEVEL;
      const cv::Vec3f change = (outside - inside) * (2 / brightness);
      sum += change * (1 / (static_cast<float>(cv::norm(change)) + FAINT));
      ++count;
    }
  }
  return 2 * count < LOOKS || cv::norm(sum) >= MIN_COHERENCE * count;
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

/** Removes what the blur of other boundaries explains. */
void removeBlur(RingCandidate& candidate)
{
  for (std::size_t k = 0; k < candidate.boundaries.size() && candidate.boundaries.size() > 2;)
  {
    if (isBesideStronger(candidate.boundaries, k) && isBlur(*candidate.profile, radiiOf(candidate.boundaries), k))
    {
      candidate.boundaries.erase(candidate.boundaries.begin() + static_cast<std::ptrdiff_t>(k));
      candidate.rings.radii.erase(candidate.rings.radii.begin() + static_cast<std::ptrdiff_t>(k));
      continue;
    }
    ++k;
  }
}

/** Adds the boundaries that the blur hides between narrow rings. */
void splitMergedRings(const AngularSupport& support, RingCandidate& candidate)
{
  for (int split = 0; split < MOST_SPLITS; ++split)
  {
    std::vector<double> radii = radiiOf(candidate.boundaries);
    const double radius = mergedBoundary(*candidate.profile, radii);
    if (radius <= 0)
    {
      return;
    }
    const auto place = std::lower_bound(radii.begin(), radii.end(), radius);
    const auto ring = place - radii.begin();
    // The refinement has moved the boundaries since they were measured.
    const double scale = candidate.rings.radii[ring] / *place;
    radii.insert(place, radius);
    candidate.boundaries.insert(candidate.boundaries.begin() + ring,
                                measureBoundary(*candidate.profile, support, radii, static_cast<std::size_t>(ring)));
    candidate.rings.radii.insert(candidate.rings.radii.begin() + ring, radius * scale);
  }
}

/** Finds out which boundaries there are, inside those of the candidate's rings and outside. */
bool complete(EdgelMap& map, const cv::Mat& bgr, RingCandidate& candidate)
{
  candidate.image_size = bgr.size();
  Rings& rings = candidate.rings;
  const auto profile = std::make_shared<RingProfile>();
  candidate.profile = profile;
  std::vector<RadialEdgel> edgels;
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    const double reach = profileReach(rings);
    sampleProfile(bgr, rings.family, reach, *profile);
    collectRadialEdgels(map, rings.family, reach, .92, edgels);
    candidate.boundaries = findBoundaries(*profile, AngularSupport(edgels, reach), rings.radii);
    if (candidate.boundaries.size() < 2)
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
  const AngleBins visible = visibleDirections(candidate.boundaries);
  candidate.visible = share(visible);
  candidate.evidence = evidenceOf(candidate.boundaries, visible);
  if (candidate.evidence > SPLIT_EVIDENCE && narrowestRing(rings.radii) < SPLIT_WIDTH)
  {
    splitMergedRings(AngularSupport(edgels, profileReach(rings)), candidate);
  }
  removeBlur(candidate);
  addPartialBoundaries(*candidate.profile, AngularSupport(edgels, profileReach(rings)), candidate.boundaries,
                       rings.radii);
  Boundary& disk = candidate.boundaries.front();
  if (disk.contrast > CLEAR_CONTRAST && disk.radius > COVERED_RADIUS && share(disk.supported) < CLEAR_SUPPORT &&
      disk.agreement < CLEAR_AGREEMENT)
  {
    disk.shown = false;  // so strong a step has an edge: what is seen is a thing on the disk
  }
  candidate.ring_count = static_cast<int>(candidate.boundaries.size());
  addHiddenBoundaries(*candidate.profile, AngularSupport(edgels, profileReach(rings)), candidate.boundaries,
                      rings.radii);
  return true;
}
}  // namespace

bool hasOwnBoundary(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed)
{
  if (!changesAlike(bgr, seed.family, seed.radius + 1.2))
  {
    return false;
  }
  std::vector<RadialEdgel> edgels;
  const double radius = seed.radius + 1.2;  // the region ends where its edge begins
  collectRadialEdgels(map, seed.family, radius * 1.2 + 2, .85, edgels);
  const AngularSupport support(edgels, radius * 1.2 + 2);
  const double tolerance = std::max(.9, .03 * radius);
  double best = 0;
  const double from = radius * .85 - .6;
  const int steps = static_cast<int>((radius * 1.2 + 1 - from) / tolerance) + 1;
  for (int i = 0; i <= steps; ++i)
  {
    best = std::max(best, share(support.at(from + i * tolerance, tolerance)));
  }
  return best >= .55;
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

bool isTarget(const RingCandidate& candidate, int min_rings)
{
  const int count = candidate.ring_count;
  const Rings& rings = candidate.rings;
  const double radius = rings.radii.back();
  const double perspective = std::hypot(rings.family.hx, rings.family.hy);
  if (count < min_rings ||
      perspective * radius > PERSPECTIVE_SLACK + largestPerspective(rings.family, candidate.image_size) * radius)
  {
    return false;
  }
  const bool many = count >= MANY_RINGS;
  const bool fits_well = rings.rms < .1 + .002 * radius;
  if (radius < SMALL_RADIUS || (radius < LARGE_RADIUS && !many && !fits_well))
  {
    return many ? candidate.evidence > .8 && candidate.visible > .85
                : candidate.evidence > .84 && candidate.visible > .9 && rings.radii.front() > SMALLEST_DISK;
  }
  const bool is_clear = many && candidate.evidence > .85 && candidate.visible > .9;
  const bool fits = rings.rms < .25 + (is_clear ? .004 : .0025) * radius;
  if (candidate.visible < MOSTLY_VISIBLE)
  {
    // Half-hidden targets that fit worse are off by a tenth of a ring and more.
    return candidate.visible > LEAST_VISIBLE && fits_well && candidate.evidence > (many ? .74 : .86);
  }
  const bool fits_closely = rings.rms < .12 + .0006 * radius;
  return ((many ? fits_well : fits_closely) && candidate.evidence > .7) ||
         (fits && candidate.evidence > (many ? .74 : .8));
}

}  // namespace omr
