#include "targets.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "ring_search.h"
#include "soft_targets.h"
#include "target_reading.h"
#include "targets/edges/edgels.h"

namespace omr
{
namespace
{
/** Whether the boards lie in the same places, in the same order. */
bool haveSameCorners(const std::vector<Checkerboard>& boards, const std::vector<Checkerboard>& others)
{
  return std::equal(boards.begin(), boards.end(), others.begin(), others.end(),
                    [](const Checkerboard& a, const Checkerboard& b) { return a.corners == b.corners; });
}
}  // namespace

struct TargetSearch::State
{
  State(cv::Mat image, const Settings& settings) : bgr(std::move(image)), min_rings(settings.target_min_rings)
  {
  }

  /** Whether there is anything to search; makes what the search needs. */
  bool prepare()
  {
    if (!map && !bgr.empty() && bgr.type() == CV_8UC3)
    {
      map = std::make_unique<EdgelMap>(bgr);
    }
    return map != nullptr;
  }

  /** All targets. @param is_vain likewise as of findRingCandidates(). */
  std::vector<Target> search(EdgelMap& of_image, const RegionMap& regions, RoundSeeds with,
                             const std::vector<Checkerboard>& boards, const std::atomic<bool>* is_vain) const
  {
    growFamilies(of_image, bgr, min_rings, with);
    const std::vector<ArcFamily> arcs = with.arcs;
    const std::vector<RingCandidate> candidates =
        findRingCandidates(of_image, bgr, regions, std::move(with), boards, min_rings, is_vain);
    std::vector<Target> found = readTargets(bgr, candidates, min_rings);
    if (found.empty())  // beside others it would take a tenth of the time
    {
      found = findSoftTargets(bgr, arcs, boards, candidates, min_rings, is_vain);
    }
    return found;
  }

  cv::Mat bgr;
  int min_rings;
  std::unique_ptr<EdgelMap> map;
  RoundSeeds seeds;
  std::vector<Checkerboard> expected;
  std::atomic<bool> is_vain{false};  // what is searched with them
  std::optional<std::vector<Target>> targets;
};

TargetSearch::TargetSearch(const cv::Mat& bgr, const Settings& settings)
    : state_(std::make_unique<State>(bgr, settings))
{
}

TargetSearch::~TargetSearch() = default;

void TargetSearch::lookAtImage()
{
  if (state_->prepare())
  {
    growFamilies(*state_->map, state_->bgr, state_->min_rings, state_->seeds);
  }
}

void TargetSearch::lookAtGrey(const cv::Mat& grey)
{
  if (grey.type() == CV_8UC1 && grey.size() == state_->bgr.size())
  {
    addRoundSpots(grey, state_->seeds);
  }
}

void TargetSearch::expect(const std::vector<Checkerboard>& boards)
{
  state_->expected = boards;
}

void TargetSearch::lookAtRest(const RegionMap& regions)
{
  if (state_->prepare())
  {
    EdgelMap map = *state_->map;
    state_->targets = state_->search(map, regions, state_->seeds, state_->expected, &state_->is_vain);
  }
}

void TargetSearch::confirm(const std::vector<Checkerboard>& boards)
{
  state_->is_vain = !haveSameCorners(boards, state_->expected);
}

std::vector<Target> TargetSearch::finish(const RegionMap& regions, const std::vector<Checkerboard>& boards)
{
  if (!state_->prepare())
  {
    return {};
  }
  if (state_->targets && !state_->is_vain && haveSameCorners(boards, state_->expected))
  {
    return std::move(*state_->targets);
  }
  return state_->search(*state_->map, regions, std::move(state_->seeds), boards, nullptr);
}

std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const std::vector<Checkerboard>& boards,
                                const Settings& settings)
{
  TargetSearch search(frame.bgr, settings);
  search.lookAtGrey(frame.raw_grey);
  return search.finish(regions, boards);
}

}  // namespace omr
