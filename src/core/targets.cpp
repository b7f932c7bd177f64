#include "outdoor_omr/targets.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "arc_seeds.h"
#include "color_key.h"
#include "edgels.h"
#include "ring_candidate.h"
#include "ring_colors.h"
#include "ring_seeds.h"

namespace omr
{
namespace
{
constexpr int MAX_PIECES = 50;              // that are looked at
constexpr double UNDISPUTED = .85;          // evidence x visible share of a candidate that no other seed will better
constexpr double MIN_UNREAD_DIAMETER = 30;  // of a target of three rings with unknown ones [px]

bool contains(const RingCandidate& candidate, const cv::Point2d& point)
{
  return cv::norm(candidate.rings.family.toPlane(point)) < candidate.rings.radii.back();
}

bool isOnBoard(const cv::Point2d& point, const std::vector<Checkerboard>& boards)
{
  return std::any_of(boards.begin(), boards.end(), [&](const Checkerboard& board) {
    return cv::pointPolygonTest(std::vector<cv::Point2f>(board.corners.begin(), board.corners.end()), point, false) > 0;
  });
}

double score(const RingCandidate& candidate)
{
  return candidate.evidence * candidate.visible * static_cast<double>(candidate.boundaries.size());
}

/** Of candidates one of which contains the other's centre, the best. */
std::vector<RingCandidate> bestOfEachPlace(std::vector<RingCandidate> candidates)
{
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const RingCandidate& left, const RingCandidate& right) { return score(left) > score(right); });
  std::vector<RingCandidate> best;
  for (RingCandidate& candidate : candidates)
  {
    const bool is_double = std::any_of(best.begin(), best.end(), [&](const RingCandidate& other) {
      return contains(other, candidate.rings.family.center) || contains(candidate, other.rings.family.center);
    });
    if (!is_double)
    {
      best.push_back(std::move(candidate));
    }
  }
  return best;
}

/** A target has letters; three narrow rings, which lenses and letters have too, are one only if all can be read. */
bool isReadable(const Target& target, int ring_count, int min_rings)
{
  const auto count = static_cast<int>(target.colors.size());
  const auto unknown = std::count(target.colors.begin(), target.colors.end(), '?');
  if (std::min(count, ring_count) < min_rings || unknown == count)
  {
    return false;
  }
  const cv::Size2f size = target.rings.back().size;
  return std::min(count, ring_count) > 3 || unknown == 0 || std::min(size.width, size.height) > MIN_UNREAD_DIAMETER;
}

/** Whether both boundaries of the ring show. */
bool isSeen(const std::vector<Boundary>& boundaries, std::size_t ring)
{
  return boundaries[ring].shown && (ring == 0 || boundaries[ring - 1].shown);
}

/** The key's letters; a boundary between equal ones is no ring's: the family loses it. */
std::string readColors(const RingProfile& profile, std::vector<Boundary>& boundaries, std::vector<double>& radii)
{
  while (true)
  {
    std::vector<LinearColor> colors = measureRingColors(profile, boundaries, radii);
    const LinearColor around = colors.back();
    colors.pop_back();
    std::string key = readColorKey(colors, around);
    for (std::size_t k = 0; k < key.size(); ++k)
    {
      key[k] = isSeen(boundaries, k) ? key[k] : '?';
    }
    std::size_t k = 0;
    while (k + 1 < key.size() && (key[k] == '?' || key[k] != key[k + 1]))
    {
      ++k;
    }
    if (k + 1 >= key.size())
    {
      return key;
    }
    radii.erase(radii.begin() + static_cast<std::ptrdiff_t>(k));
    boundaries.erase(boundaries.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

/** @return false if the colours are no target's. */
bool toTarget(RingCandidate candidate, int min_rings, Target& target)
{
  std::vector<double>& radii = candidate.rings.radii;
  target.colors = readColors(candidate.profile, candidate.boundaries, radii);
  target.center = cv::Point2f(candidate.rings.family.center);
  for (const double radius : radii)
  {
    target.rings.push_back(candidate.rings.family.ellipse(radius));
  }
  return isReadable(target, candidate.ring_count, min_rings);
}
}  // namespace

std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const std::vector<Checkerboard>& boards,
                                const Settings& settings)
{
  if (frame.bgr.empty())
  {
    return {};
  }
  EdgelMap map(frame.bgr);
  std::vector<RingCandidate> candidates;
  const auto is_taken = [&](const cv::Point2d& point) {
    return isOnBoard(point, boards) ||
           std::any_of(candidates.begin(), candidates.end(), [&](const RingCandidate& candidate) {
             return candidate.evidence * candidate.visible > UNDISPUTED && contains(candidate, point);
           });
  };
  const auto try_seed = [&](const RingSeed& seed, bool is_boundary) {
    RingCandidate candidate;
    if (growCandidate(map, frame.bgr, seed, is_boundary, candidate) && isTarget(candidate, settings.target_min_rings))
    {
      candidates.push_back(std::move(candidate));
    }
  };
  for (const RingSeed& seed : findRoundSeeds(regions.regions))
  {
    if (!is_taken(seed.family.center) && hasOwnBoundary(map, frame.bgr, seed))
    {
      try_seed(seed, true);
    }
  }
  int budget = MAX_PIECES;
  for (const Region* piece : findPieces(regions.regions))
  {
    RingSeed seed;
    if (!is_taken(piece->center) && --budget >= 0 && findArcSeed(map, *piece, seed) && !is_taken(seed.family.center))
    {
      try_seed(seed, false);
    }
  }
  std::vector<Target> targets;
  for (const RingCandidate& candidate : bestOfEachPlace(std::move(candidates)))
  {
    Target target;
    if (toTarget(candidate, settings.target_min_rings, target))
    {
      targets.push_back(std::move(target));
    }
  }
  return targets;
}

}  // namespace omr
