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

/** The key's letters; a boundary between equal ones is no ring's: the family loses it. */
std::string readColors(const RingProfile& profile, std::vector<double>& radii)
{
  while (true)
  {
    std::vector<LinearColor> colors = measureRingColors(profile, radii);
    const LinearColor around = colors.back();
    colors.pop_back();
    const std::string key = readColorKey(colors, around);
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
  }
}

Target toTarget(const RingCandidate& candidate)
{
  Target target;
  std::vector<double> radii = candidate.rings.radii;
  target.colors = readColors(candidate.profile, radii);
  target.center = cv::Point2f(candidate.rings.family.center);
  for (const double radius : radii)
  {
    target.rings.push_back(candidate.rings.family.ellipse(radius));
  }
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
    Target target = toTarget(candidate);
    if (static_cast<int>(target.rings.size()) >= settings.target_min_rings)
    {
      targets.push_back(std::move(target));
    }
  }
  return targets;
}

}  // namespace outdoor_omr
