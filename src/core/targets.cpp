#include "outdoor_omr/targets.h"

#include <algorithm>

#include "arc_seeds.h"
#include "color_key.h"
#include "edgels.h"
#include "ring_candidate.h"
#include "ring_colors.h"
#include "ring_seeds.h"

namespace outdoor_omr
{
namespace
{
constexpr int MAX_PIECES = 150;

bool contains(const RingCandidate& candidate, const cv::Point2d& point)
{
  return cv::norm(candidate.rings.family.toPlane(point)) < candidate.rings.radii.back();
}

Target toTarget(const RingCandidate& candidate)
{
  Target target;
  target.center = cv::Point2f(candidate.rings.family.center);
  for (const double radius : candidate.rings.radii)
  {
    target.rings.push_back(candidate.rings.family.ellipse(radius));
  }
  std::vector<LinearColor> colors = measureRingColors(candidate.profile, candidate.rings.radii);
  const LinearColor around = colors.back();
  colors.pop_back();
  target.colors = readColorKey(colors, around);
  return target;
}
}  // namespace

std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const Settings& settings)
{
  EdgelMap map(frame.bgr);
  std::vector<RingCandidate> accepted;
  const auto is_taken = [&](const cv::Point2d& point) {
    return std::any_of(accepted.begin(), accepted.end(),
                       [&](const RingCandidate& candidate) { return contains(candidate, point); });
  };
  const auto try_seed = [&](const RingSeed& seed, bool is_boundary) {
    RingCandidate candidate;
    if (growCandidate(map, frame.bgr, seed, is_boundary, candidate) && isTarget(candidate, settings.target_min_rings))
    {
      accepted.push_back(candidate);
    }
  };
  for (const RingSeed& seed : findRoundSeeds(regions.regions))
  {
    if (!is_taken(seed.family.center) && hasOwnBoundary(map, seed))
    {
      try_seed(seed, true);
    }
  }
  int budget = MAX_PIECES;
  for (const Region* piece : findPieces(regions.regions))
  {
    RingSeed seed;
    if (is_taken(piece->center) || --budget < 0)
    {
      continue;
    }
    if (findArcSeed(map, *piece, seed) && !is_taken(seed.family.center))
    {
      try_seed(seed, false);
    }
  }
  std::vector<Target> targets;
  for (const RingCandidate& candidate : accepted)
  {
    targets.push_back(toTarget(candidate));
  }
  return targets;
}

}  // namespace outdoor_omr
