#include "ring_boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ring_roundness.h"
#include "ring_slopes.h"

namespace omr
{
namespace
{
constexpr int ANGLES = RingProfile::ANGLES;
constexpr int MIN_EDGED = 16;               // directions with an edge that make a median
constexpr double MIN_WIDTH = 2.5;           // of a ring whose boundaries edgels alone show [px]
constexpr double MIDDLE = .4;               // of a ring: from here to 1 - MIDDLE
constexpr double FLANK = 8;                 // farther from an edge nothing is its flank [px]
constexpr double STEP_REACH = 2;            // [px]
constexpr double MIN_CONTRAST = .12;        // of the logarithms, length over three channels
constexpr double MIN_EDGE_CONTRAST = .025;  // where edgels show that there is a boundary
constexpr double EDGE_SUPPORT = .75;
constexpr double EDGE_COHERENCE = .9;
constexpr double NOISY_RADIUS = 3;  // [px]; near the centre few pixels decide, so that their noise is coherent
constexpr double CLEAR_CONTRAST = .3;
constexpr double MIN_AGREEMENT = .5;     // at a clear contrast: a target may be half hidden
constexpr double FAINT_AGREEMENT = .3;   // more at the least contrast
constexpr double CLEAR_AGREEMENT = .8;   // below it, edgels must tell that a boundary is no gradual change
constexpr double MIN_SUPPORT = .25;      // by edgels, of such a one
constexpr double MAX_WIDTH_RATIO = 4.5;  // of the rings of one target
constexpr double DISK_SHARE = .75;       // of a disk's width that counts: it may be wider

// Cameras and JPEG blur hues over several pixels: beside an edge the hue changes once more, faintly and without edgels.
constexpr double BLEEDING = 6;        // reach of that [px]
constexpr double BLED_CONTRAST = .7;  // most, relative to the edge's
constexpr double LARGEST_BLED_CONTRAST = .45;
// By edgels, of a boundary that may be such a change. At .75 narrow outermost rings on ground like them were lost: 29
// of the field's targets had a wrong number of rings instead of 24, and the evaluation is the same.
constexpr double MIN_FLANK_SUPPORT = .6;
constexpr double MIN_FLANK_AGREEMENT = .92;  // times coherence: or else

/** Adds the known radii that split a ring near its middle: nearer to its edges they are flanks of those. */
void addKnown(const std::vector<double>& known, double limit, std::vector<double>& radii)
{
  const std::vector<double> own = radii;
  for (const double radius : known)
  {
    const auto next = std::lower_bound(own.begin(), own.end(), radius);
    const double outer = next == own.end() ? limit : *next;
    const double inner = next == own.begin() ? 0 : *(next - 1);
    if (std::min(radius - inner, outer - radius) > std::max(MIN_WIDTH, std::min(FLANK, MIDDLE * (outer - inner))))
    {
      radii.push_back(radius);
    }
  }
  std::sort(radii.begin(), radii.end());
}

/** How far to either side of a boundary its whole step shows [px]. */
double stepReach(const std::vector<double>& radii, std::size_t k)
{
  const double inside = radii[k] - (k > 0 ? radii[k - 1] : 0);
  const double outside = k + 1 < radii.size() ? radii[k + 1] - radii[k] : inside;
  return std::min({.5 * inside, .5 * outside, STEP_REACH});
}

/** Steps of logarithmic colour across a boundary, in every direction. */
struct Steps
{
  AngleBins seen = 0;
  std::array<LogColor, ANGLES> whole;  // from ring to ring
  std::array<LogColor, ANGLES> local;  // at the boundary
};

Steps stepsAcross(const RingProfile& profile, const std::vector<double>& radii, std::size_t k)
{
  const double reach = stepReach(radii, k);
  const int inner = static_cast<int>(std::lround((radii[k] - reach) / profile.step));
  const int outer = static_cast<int>(std::lround((radii[k] + reach) / profile.step));
  Steps steps;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    LogColor before;
    LogColor after;
    if (outer < profile.inside[angle] && ringColor(profile, radii, k, angle, before, RingPart::outer_rim) &&
        ringColor(profile, radii, k + 1, angle, after, RingPart::inner_rim))
    {
      steps.local[angle] = profile.ray(angle)[outer] - profile.ray(angle)[inner];
      steps.whole[angle] = after - before;
      steps.seen |= AngleBins{1} << angle;
    }
  }
  return steps;
}

/** Sets what the steps in some directions have in common: median, its length, and how much they run alike. */
void setChange(const std::array<LogColor, ANGLES>& steps, AngleBins directions, Boundary& boundary)
{
  LogColor sum;
  double length_sum = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    if ((directions >> angle & 1) != 0)
    {
      sum += steps[angle];
      length_sum += cv::norm(steps[angle]);
    }
  }
  boundary.change = medianOf(steps, directions);
  boundary.contrast = cv::norm(boundary.change);
  boundary.coherence = length_sum > 0 ? cv::norm(sum) / length_sum : 0;
}

/** Directions in which the steps are the boundary's. */
AngleBins agreeingDirections(const Steps& steps, const Boundary& boundary)
{
  const double squared = boundary.contrast * boundary.contrast;
  AngleBins agreeing = 0;
  for (int angle = 0; angle < ANGLES; ++angle)
  {
    const double along = steps.whole[angle].dot(boundary.change);
    const double here = steps.local[angle].dot(boundary.change);
    const bool is_alike = along > .4 * squared && along < 2.5 * squared && here > .35 * squared;
    // Gloss weakens a step, and lets its hue and its edge.
    const bool is_veiled = (boundary.supported >> angle & 1) != 0 && along > .15 * squared && here > .15 * squared &&
                           along > .85 * boundary.contrast * cv::norm(steps.whole[angle]);
    if ((steps.seen >> angle & 1) != 0 && (is_alike || is_veiled))
    {
      agreeing |= AngleBins{1} << angle;
    }
  }
  return agreeing;
}
}  // namespace

double edgeTolerance(double radius)
{
  return std::max(.8, .012 * radius);
}

std::vector<double> radiiOf(const std::vector<Boundary>& boundaries)
{
  std::vector<double> radii(boundaries.size());
  std::transform(boundaries.begin(), boundaries.end(), radii.begin(),
                 [](const Boundary& boundary) { return boundary.radius; });
  return radii;
}

Boundary measureBoundary(const RingProfile& profile, const AngularSupport& support, const std::vector<double>& radii,
                         std::size_t k)
{
  const double tolerance = edgeTolerance(radii[k]);
  const Steps steps = stepsAcross(profile, radii, k);
  Boundary boundary;
  boundary.radius = radii[k];
  boundary.supported = support.at(radii[k], tolerance);
  boundary.seen = steps.seen;
  if (countOf(boundary.seen) < leastDirections(profile))
  {
    return boundary;
  }
  // What hides a boundary has an edge elsewhere.
  const AngleBins edged = boundary.seen & boundary.supported;
  setChange(steps.whole, countOf(edged) >= MIN_EDGED ? edged : boundary.seen, boundary);
  boundary.agreeing = agreeingDirections(steps, boundary);
  // Where one channel rises as another falls, noise and light decide which is the stronger. So the sign of an edgel
  // tells nothing where the colours agree: of the field's targets 157 and 157 are found instead of 155 and 155.
  boundary.supported |= boundary.agreeing & support.either(radii[k], tolerance);
  boundary.agreement = countOf(boundary.agreeing) / static_cast<double>(countOf(boundary.seen));
  return boundary;
}

namespace
{
/** Whether a boundary is faint and so near to a stronger one that it may be no more than that one's blurred hue. */
bool isBesideStronger(const std::vector<Boundary>& boundaries, std::size_t k)
{
  const Boundary& boundary = boundaries[k];
  const auto is_stronger = [&](const Boundary& other) {
    return std::abs(other.radius - boundary.radius) < BLEEDING && boundary.contrast < BLED_CONTRAST * other.contrast;
  };
  return boundary.contrast < LARGEST_BLED_CONTRAST &&
         ((k > 0 && is_stronger(boundaries[k - 1])) || (k + 1 < boundaries.size() && is_stronger(boundaries[k + 1])));
}

/** Below 1: no boundary. A faint step must show in nearly all directions. */
double quality(const std::vector<Boundary>& boundaries, std::size_t k, const AngularSupport& support, AngleBins open)
{
  const Boundary& boundary = boundaries[k];
  const double faintness = std::clamp((CLEAR_CONTRAST - boundary.contrast) / (CLEAR_CONTRAST - MIN_CONTRAST), 0., 1.);
  const double supported = share(boundary.supported) / share(open);
  const bool is_edge = supported > EDGE_SUPPORT && boundary.coherence > EDGE_COHERENCE;
  const double least_contrast = (is_edge ? MIN_EDGE_CONTRAST : MIN_CONTRAST) * (1 + NOISY_RADIUS / boundary.radius);
  double result =
      std::min(boundary.contrast / least_contrast, boundary.agreement / (MIN_AGREEMENT + FAINT_AGREEMENT * faintness));
  if (isBesideStronger(boundaries, k))
  {
    const double seen_edges = countOf(boundary.supported & boundary.seen) / std::max(1., 1. * countOf(boundary.seen));
    result = std::min(result, std::max(seen_edges / MIN_FLANK_SUPPORT,
                                       boundary.agreement * boundary.coherence / MIN_FLANK_AGREEMENT));
  }
  if (boundary.agreement < CLEAR_AGREEMENT)
  {
    result = std::min(result, supported / MIN_SUPPORT);
  }
  if (k > 0 && k + 1 == boundaries.size())
  {
    result = std::min(result, roundness(boundaries, support));
  }
  return result;
}

/** Index of a ring that is far narrower than the widest, or -1. */
int tooNarrow(const std::vector<double>& radii)
{
  double widest = 0;
  double narrowest = std::numeric_limits<double>::infinity();
  int index = -1;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double width = radii[k] - (k > 0 ? radii[k - 1] : 0);
    widest = std::max(widest, (k == 0 ? DISK_SHARE : 1) * width);
    if (width < narrowest)
    {
      narrowest = width;
      index = static_cast<int>(k);
    }
  }
  return narrowest * MAX_WIDTH_RATIO < widest ? index : -1;
}
}  // namespace

std::vector<Boundary> findBoundaries(const RingProfile& profile, const AngularSupport& support,
                                     const std::vector<double>& known)
{
  std::vector<double> radii = steepestRadii(profile);
  addKnown(known, (profile.count - 1) * profile.step, radii);
  std::vector<Boundary> boundaries(radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    boundaries[k] = measureBoundary(profile, support, radii, k);
  }
  const auto remove = [&](std::size_t k) {
    const auto offset = static_cast<std::ptrdiff_t>(k);
    radii.erase(radii.begin() + offset);
    boundaries.erase(boundaries.begin() + offset);
    for (std::size_t neighbor = k > 0 ? k - 1 : 0; neighbor < std::min(k + 1, radii.size()); ++neighbor)
    {
      boundaries[neighbor] = measureBoundary(profile, support, radii, neighbor);
    }
  };
  while (!radii.empty())
  {
    std::size_t worst = 0;
    double worst_quality = 1;
    for (std::size_t k = 0; k < radii.size(); ++k)
    {
      const double value = quality(boundaries, k, support, profile.open);
      if (value < worst_quality)
      {
        worst = k;
        worst_quality = value;
      }
    }
    if (worst_quality < 1)
    {
      remove(worst);
      continue;
    }
    const int narrow = tooNarrow(radii);
    if (narrow < 0)
    {
      break;
    }
    // Of the two boundaries of the narrow ring the fainter one goes.
    const bool inner_fainter = narrow > 0 && boundaries[narrow - 1].contrast < boundaries[narrow].contrast;
    remove(static_cast<std::size_t>(inner_fainter ? narrow - 1 : narrow));
  }
  return boundaries;
}

}  // namespace omr
