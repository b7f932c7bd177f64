#include "outdoor_omr/targets.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "color_key.h"
#include "edgels.h"
#include "ring_colors.h"
#include "ring_search.h"

namespace omr
{
namespace
{
constexpr double MIN_UNREAD_DIAMETER = 30;  // of a target of three rings with unknown ones [px]

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

struct TargetSearch::State
{
  State(const Frame& source, const RegionMap& source_regions, const Settings& settings)
      : frame(source), regions(source_regions), min_rings(settings.target_min_rings)
  {
  }

  /** Whether there is anything to search; makes what the search needs. */
  bool prepare()
  {
    if (!map && !frame.bgr.empty())
    {
      map = std::make_unique<EdgelMap>(frame.bgr);
      seeds = toRoundSeeds(regions);
    }
    return map != nullptr;
  }

  const Frame& frame;
  const RegionMap& regions;
  int min_rings;
  std::unique_ptr<EdgelMap> map;
  RoundSeeds seeds;
};

TargetSearch::TargetSearch(const Frame& frame, const RegionMap& regions, const Settings& settings)
    : state_(std::make_unique<State>(frame, regions, settings))
{
}

TargetSearch::~TargetSearch() = default;

void TargetSearch::lookAhead()
{
  if (state_->prepare())
  {
    growConcentric(*state_->map, state_->frame.bgr, state_->min_rings, state_->seeds);
  }
}

std::vector<Target> TargetSearch::finish(const std::vector<Checkerboard>& boards)
{
  std::vector<Target> targets;
  if (!state_->prepare())
  {
    return targets;
  }
  std::vector<RingCandidate> candidates = findRingCandidates(*state_->map, state_->frame.bgr, state_->regions,
                                                             std::move(state_->seeds), boards, state_->min_rings);
  std::vector<Target> read(candidates.size());
  std::vector<char> is_target(candidates.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(candidates.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      is_target[i] = toTarget(std::move(candidates[i]), state_->min_rings, read[i]) ? 1 : 0;
    }
  });
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    if (is_target[i] != 0)
    {
      targets.push_back(std::move(read[i]));
    }
  }
  return targets;
}

std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const std::vector<Checkerboard>& boards,
                                const Settings& settings)
{
  return TargetSearch(frame, regions, settings).finish(boards);
}

}  // namespace omr
