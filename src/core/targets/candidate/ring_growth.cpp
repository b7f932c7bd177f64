#include "ring_growth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "median.h"
#include "targets/family/bent_refinement.h"
#include "targets/family/ring_refinement.h"

namespace omr
{
namespace
{
constexpr double COARSE_COSINE = 0.85;  // between gradient and radius, while the family is rough
constexpr double FINE_COSINE = 0.9;
constexpr double MIN_SUPPORT = 0.42;      // of the directions: 25 to 40 % of a target may be hidden
constexpr double RELATIVE_SUPPORT = 0.6;  // of the best supported boundary
constexpr double ABOVE_BACKGROUND = 0.2;  // above the median over all radii
constexpr double MIN_DISTANCE = 1.6;      // between two boundaries [px]: closer ones merge in the gradient
constexpr int MAX_ROUNDS = 8;
constexpr std::size_t ENOUGH = 3;  // boundaries to find further ones in the profile along rays

// At edgels, of one growth. Targets of 200 px radius take 70000; in clutter growth goes on to the largest radius.
constexpr std::size_t MAX_LOOKS = 80000;
constexpr double MAX_RADIUS = 600;          // to look for further boundaries in [px]
constexpr double LEAST_REACH = 1.05;        // of what is found already: it stays in sight
constexpr std::size_t COARSE_POINTS = 200;  // that a fit uses while growing
constexpr std::size_t FINE_POINTS = 800;
constexpr double LARGEST_RMS = 1;             // of the edgels of the first boundary [px]
constexpr double LARGEST_RELATIVE_RMS = .06;  // more, relative to its radius: perspective, bent sheets
// Of several boundaries: all but one of 483 growths that become targets have less, and a fifth of the time of those
// that do not is spent with more.
constexpr double GROWN_RMS = .5;             // [px]
constexpr double GROWN_RELATIVE_RMS = .002;  // more, relative to the radius
constexpr double ROUGH_SLACK = 1.2;          // times that, of a family from a single circle
// RMS of a family seen aslant that was found with two circles at most, relative to that of the same seen straight on:
// what hides and shades two circles moves their centres apart, too, and the circles between them are not found then. At
// .8 four of the field's targets, one of "blender" and one of "degrade" are found that were not before, none is lost.
constexpr double PERSPECTIVE_GAIN = .8;
constexpr double BENT_GATE = .1;  // of the outermost boundary: a bend moves it so far off a circle
// RMS of a bend worth a further look, relative to the plane's: 107 of 108 bends that pay have less, and 59 of 132
// others.
constexpr double BENT_PROMISE = .85;
constexpr double CELL = AngularSupport::CELL;

struct Peak
{
  double radius = 0;
  double support = 0;
};

/** What a boundary needs: clearly more than texture and noise give at any radius, and not far less than the best. */
double leastSupport(std::vector<double> support)
{
  const double strongest = *std::max_element(support.begin(), support.end());
  return std::max({MIN_SUPPORT, RELATIVE_SUPPORT * strongest, median(std::move(support)) + ABOVE_BACKGROUND});
}

/** Radii at which the angular support has a maximum, ascending. */
std::vector<Peak> findPeaks(const std::vector<RadialEdgel>& edgels, double max_radius, double tolerance)
{
  const AngularSupport map(edgels, max_radius);
  const int cells = static_cast<int>(max_radius / CELL) + 1;
  std::vector<double> support(static_cast<std::size_t>(cells));
  std::vector<int> order;
  for (int i = 0; i < cells; ++i)
  {
    support[i] = share(map.at((i + .5) * CELL, tolerance));
  }
  const double least = leastSupport(support);
  for (int i = 0; i < cells; ++i)
  {
    if (support[i] >= least)
    {
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](int left, int right) { return support[left] > support[right]; });
  std::vector<char> taken(support.size(), 0);
  std::vector<Peak> peaks;
  const int distance = static_cast<int>(std::ceil(std::max(MIN_DISTANCE, 1.5 * tolerance) / CELL));
  for (const int i : order)
  {
    if (taken[i])
    {
      continue;
    }
    int end = i;  // of the plateau of equal support
    while (end + 1 < cells && !taken[end + 1] && support[end + 1] == support[i])
    {
      ++end;
    }
    std::fill(taken.begin() + std::max(0, i - distance), taken.begin() + std::min(cells, end + distance + 1), 1);
    peaks.push_back({(i + end + 1) * .5 * CELL, support[i]});
  }
  std::sort(peaks.begin(), peaks.end(), [](const Peak& left, const Peak& right) { return left.radius < right.radius; });
  return peaks;
}

/** Distance of each boundary to the nearest other, the centre included. */
std::vector<double> clearances(const std::vector<double>& radii)
{
  std::vector<double> result(radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double inside = radii[k] - (k > 0 ? radii[k - 1] : 0);
    const double outside = k + 1 < radii.size() ? radii[k + 1] - radii[k] : inside;
    result[k] = std::min(inside, outside);
  }
  return result;
}

/** The edgels near their boundaries, evenly taken. */
std::vector<BoundaryPoint> pointsOf(const std::vector<RadialEdgel>& edgels, double gate, std::size_t max_points,
                                    const Rings& rings)
{
  const std::vector<double> clearance = clearances(rings.radii);
  std::vector<BoundaryPoint> points;
  for (const RadialEdgel& edgel : edgels)
  {
    const auto next = std::lower_bound(rings.radii.begin(), rings.radii.end(), edgel.radius);
    std::size_t k = static_cast<std::size_t>(next - rings.radii.begin());
    if (k == rings.radii.size() || (k > 0 && edgel.radius - rings.radii[k - 1] < rings.radii[k] - edgel.radius))
    {
      --k;
    }
    if (std::abs(edgel.radius - rings.radii[k]) < std::min(gate, .45 * clearance[k]))
    {
      points.push_back({cv::Point2d(edgel.position), static_cast<int>(k)});
    }
  }
  thin(points, max_points);
  return points;
}

bool refineWith(const std::vector<RadialEdgel>& edgels, double gate, bool perspective, std::size_t max_points,
                Rings& rings)
{
  const std::vector<BoundaryPoint> points = pointsOf(edgels, gate, max_points, rings);
  const double rms = rings.family.isBent() ? refineBentFamily(points, rings.family, rings.radii)
                                           : refineFamily(points, perspective, rings.family, rings.radii);
  if (!std::isfinite(rms))
  {
    return false;
  }
  rings.rms = rms;
  return true;
}

/** Fits few rings: seen aslant only where that pays. */
bool refineFirst(const std::vector<RadialEdgel>& edgels, double gate, Rings& rings)
{
  Rings aslant = rings;
  const bool is_fit = refineWith(edgels, gate, false, COARSE_POINTS, rings);
  if (rings.radii.size() > 1 && refineWith(edgels, gate, true, COARSE_POINTS, aslant) &&
      (!is_fit || aslant.rms < PERSPECTIVE_GAIN * rings.rms))
  {
    rings = aslant;
    return true;
  }
  return is_fit;
}

/** How far to look for the next boundary: rings may be four times as wide as their neighbours. */
double nextReach(const Rings& rings, bool patient)
{
  const double outermost = rings.radii.back();
  const double reach = (rings.radii.size() == 1 ? (patient ? 5 : 2.4) : (patient ? 2.2 : 1.6)) * outermost + 5;
  return std::min(std::max(MAX_RADIUS, LEAST_REACH * outermost), reach);
}
}  // namespace

bool refineRings(EdgelMap& map, double gate, bool perspective, Rings& rings)
{
  std::vector<RadialEdgel> edgels;
  collectRadialEdgels(map, rings.family, rings.radii.back() + gate + 1, FINE_COSINE, edgels);
  keepDirections(rings.open, edgels);
  return refineWith(edgels, gate, perspective, FINE_POINTS, rings);
}

bool bendRings(EdgelMap& map, Rings& rings)
{
  std::vector<RadialEdgel> edgels;
  const double gate = BENT_GATE * rings.radii.back();
  collectRadialEdgels(map, rings.family, rings.radii.back() + gate + 1, COARSE_COSINE, edgels);
  keepDirections(rings.open, edgels);
  Rings bent = rings;
  if (!findBend(pointsOf(edgels, gate, FINE_POINTS, rings), bent.family, bent.radii) ||
      !refineRings(map, std::max(1.5, .4 * gate), true, bent) ||
      !refineRings(map, std::max(1., .012 * bent.radii.back()), true, bent) || bent.rms > BENT_PROMISE * rings.rms)
  {
    return false;
  }
  rings = bent;
  return true;
}

bool growRings(EdgelMap& map, double reach, Rings& rings)
{
  const std::size_t looks_before = map.looks();
  std::vector<RadialEdgel> edgels;
  if (!rings.radii.empty())
  {
    collectRadialEdgels(map, rings.family, rings.radii.back() * 1.2 + 3, COARSE_COSINE, edgels);
    if (!refineFirst(edgels, std::max(1.5, .1 * rings.radii.back()), rings) ||
        rings.rms > LARGEST_RMS + LARGEST_RELATIVE_RMS * rings.radii.back())
    {
      return false;
    }
  }
  bool patient = false;
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    if (map.isSpent() || map.looks() - looks_before > 2 * MAX_LOOKS)
    {
      return rings.radii.size() >= ENOUGH;
    }
    const bool rough = rings.radii.size() < 2;
    collectRadialEdgels(map, rings.family, reach, rough ? COARSE_COSINE : FINE_COSINE, edgels);
    const double tolerance = rough ? std::max(.9, .015 * reach) : std::max(.8, .008 * reach);
    const std::vector<Peak> peaks = findPeaks(edgels, reach, tolerance);
    if (peaks.empty() || (peaks.size() < 2 && patient))
    {
      return false;
    }
    if (peaks.size() < 2)
    {
      patient = true;
      rings.radii = {peaks[0].radius};
      reach = nextReach(rings, patient);
      continue;
    }
    Rings next = rings;
    next.radii.clear();
    for (const Peak& peak : peaks)
    {
      next.radii.push_back(peak.radius);
    }
    if (next.radii.size() > MAX_BOUNDARIES)
    {
      next.radii.resize(MAX_BOUNDARIES);
    }
    const double gate = rough ? std::max(1.5, .04 * next.radii.back()) : std::max(1., .015 * next.radii.back());
    if (!refineWith(edgels, gate, true, COARSE_POINTS, next) ||
        next.rms > (rough ? ROUGH_SLACK : 1) * (GROWN_RMS + GROWN_RELATIVE_RMS * next.radii.back()))
    {
      return false;
    }
    const bool grown =
        rings.radii.empty() || next.radii.size() > rings.radii.size() || next.radii.back() > 1.05 * rings.radii.back();
    rings = next;
    if ((!grown && patient) || (rings.radii.size() >= ENOUGH && map.looks() - looks_before > MAX_LOOKS))
    {
      break;
    }
    patient = !grown;
    reach = nextReach(rings, patient);
  }
  return rings.radii.size() >= 2;
}

}  // namespace omr
