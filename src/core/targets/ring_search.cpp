#include "ring_search.h"

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>
#include <utility>

#include "small_rings.h"
#include "targets/candidate/ring_own_boundary.h"
#include "targets/candidate/ring_places.h"
#include "targets/edges/look_budget.h"
#include "targets/seeds/arc_seeds.h"

namespace omr
{
namespace
{
constexpr std::size_t MAX_PIECES = 50;  // that are looked at
constexpr std::size_t MAX_SPOTS = 10;   // that are grown: three of four small targets with a spot are among the first 6
constexpr double MANY_VOTES = .3;       // in clutter they are .22 to .26, in targets .25 to .83

struct ArcSeed
{
  bool is_found = false;
  RingSeed seed;
  double votes = 0;
};

/** Seeds are grown in their order, where nothing undisputed was found yet: two at a time, in two threads. */
class Search
{
 public:
  Search(EdgelMap& map, const cv::Mat& bgr, const std::vector<Checkerboard>& boards, int min_rings,
         const std::atomic<bool>* is_vain)
      : map_(map), bgr_(bgr), boards_(boards), min_rings_(min_rings), is_vain_(is_vain)
  {
  }

  void allow(double share)
  {
    map_.setMaxLooks(sharedLooks(bgr_.size(), share));
  }

  void tryFamilies(std::vector<GrownSeed>& families)
  {
    for (GrownSeed& family : families)
    {
      map_.join(family.map);
      if (family.is_target && !isTaken(family.candidate.rings.family.center))
      {
        candidates_.push_back(std::move(family.candidate));
      }
    }
  }

  void tryRound(const std::vector<RingSeed>& seeds)
  {
    for (const RingSeed& seed : seeds)
    {
      if (!isOpen(seed))
      {
        continue;
      }
      EdgelMap fork = map_.fork();
      if (hasOwnBoundary(fork, bgr_, seed))
      {
        add(Growth(seed, true, GrownSeed(std::move(fork))));
      }
      else
      {
        map_.join(fork);
      }
    }
    growWaiting();
  }

  void tryArcs(const std::vector<ArcSeed>& arcs, bool with_many_votes)
  {
    for (const ArcSeed& arc : arcs)
    {
      if ((arc.votes > MANY_VOTES) == with_many_votes && isOpen(arc.seed))
      {
        add(Growth(arc.seed, false, GrownSeed(map_.fork())));
      }
    }
    growWaiting();
  }

  /** Grows the roundest where nothing was found; that takes none of the looks. */
  void trySpots(const std::vector<RoundSpot>& spots)
  {
    std::vector<RingCandidate> found;
    std::copy_if(candidates_.begin(), candidates_.end(), std::back_inserter(found),
                 [](const RingCandidate& candidate) { return !candidate.is_merged; });
    std::vector<RoundSpot> open;
    for (const RoundSpot& spot : spots)
    {
      if (open.size() < MAX_SPOTS && mayBeRings(spot) && !isOnBoard(spot.center, boards_) &&
          !isInAny(found, spot.center))
      {
        open.push_back(spot);
      }
    }
    std::vector<RingCandidate> grown(open.size());
    std::vector<char> is_target(open.size());
    cv::parallel_for_(cv::Range(0, static_cast<int>(open.size())), [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i)
      {
        is_target[i] = !isVain() && growSpot(map_, bgr_, open[i], min_rings_, grown[i]) ? 1 : 0;
      }
    });
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      const cv::Point2d& center = grown[i].rings.family.center;
      if (is_target[i] != 0 && !isOnBoard(center, boards_) && !isInAny(found, grown[i]))
      {
        candidates_.push_back(std::move(grown[i]));
      }
    }
  }

  /** Those of the largest pieces, the most votes first. */
  std::vector<ArcSeed> findArcs(const std::vector<Region>& regions)
  {
    std::vector<const Region*> pieces;
    for (const Region* piece : findPieces(regions))
    {
      if (pieces.size() < MAX_PIECES && !isTaken(piece->center))
      {
        pieces.push_back(piece);
      }
    }
    std::vector<ArcSeed> found(pieces.size());
    std::vector<EdgelMap> forks(pieces.size(), map_.fork());
    cv::parallel_for_(cv::Range(0, static_cast<int>(pieces.size())), [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i)
      {
        found[i].is_found = !isVain() && findArcSeed(forks[i], *pieces[i], found[i].seed, found[i].votes);
      }
    });
    for (const EdgelMap& fork : forks)
    {
      map_.join(fork);
    }
    found.erase(std::remove_if(found.begin(), found.end(), [](const ArcSeed& arc) { return !arc.is_found; }),
                found.end());
    std::stable_sort(found.begin(), found.end(),
                     [](const ArcSeed& left, const ArcSeed& right) { return left.votes > right.votes; });
    return found;
  }

  std::vector<RingCandidate> takeBest()
  {
    return bestOfEachPlace(std::move(candidates_));
  }

 private:
  struct Growth
  {
    Growth(const RingSeed& source, bool has_boundary, GrownSeed start)
        : seed(&source), is_boundary(has_boundary), grown(std::move(start))
    {
    }

    const RingSeed* seed;
    bool is_boundary;
    GrownSeed grown;
  };

  bool isVain() const
  {
    return is_vain_ != nullptr && *is_vain_;
  }

  bool isTaken(const cv::Point2d& point) const
  {
    return isOnBoard(point, boards_) || isInUndisputed(candidates_, point);
  }

  /** Grows what waits where the seed lies: it may be a part of the same target. */
  bool isOpen(const RingSeed& seed)
  {
    constexpr double APART = 6;  // radii
    if (!waiting_.empty() && cv::norm(waiting_.front().seed->family.center - seed.family.center) <
                                 APART * std::max(waiting_.front().seed->radius, seed.radius))
    {
      growWaiting();
    }
    return !map_.isSpent() && !isVain() && !isTaken(seed.family.center);
  }

  void add(Growth growth)
  {
    waiting_.push_back(std::move(growth));
    if (waiting_.size() == 2)
    {
      growWaiting();
    }
  }

  void growWaiting()
  {
    cv::parallel_for_(cv::Range(0, static_cast<int>(waiting_.size())), [&](const cv::Range& range) {
      for (int i = range.start; i < range.end; ++i)
      {
        Growth& growth = waiting_[i];
        GrownSeed& grown = growth.grown;
        grown.settle(growCandidate(grown.map, bgr_, *growth.seed, growth.is_boundary, grown.candidate), min_rings_);
      }
    });
    for (Growth& growth : waiting_)
    {
      if (!isTaken(growth.seed->family.center))
      {
        map_.join(growth.grown.map);
        if (growth.grown.is_target)
        {
          candidates_.push_back(std::move(growth.grown.candidate));
        }
      }
    }
    waiting_.clear();
  }

  EdgelMap& map_;
  const cv::Mat& bgr_;
  const std::vector<Checkerboard>& boards_;
  int min_rings_;
  const std::atomic<bool>* is_vain_;
  std::vector<RingCandidate> candidates_;
  std::vector<Growth> waiting_;
};
}  // namespace

std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              RoundSeeds seeds, const std::vector<Checkerboard>& boards, int min_rings,
                                              const std::atomic<bool>* is_vain)
{
  growFamilies(map, bgr, min_rings, seeds);
  addRoundSpots(bgr, seeds);
  Search search(map, bgr, boards, min_rings, is_vain);
  search.tryFamilies(seeds.families);
  search.allow(PIECES_SHARE);
  const std::vector<ArcSeed> arcs = search.findArcs(regions.regions);
  search.tryArcs(arcs, true);
  const std::vector<RingSeed> round = findRoundSeeds(regions.regions);  // what waits refers to them
  search.allow(ROUND_SHARE);
  search.tryRound(round);
  search.allow(1);
  search.tryArcs(arcs, false);
  search.trySpots(seeds.spots);
  return search.takeBest();
}

}  // namespace omr
