#include "ring_search.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "arc_seeds.h"

namespace omr
{
namespace
{
constexpr int MAX_PIECES = 50;              // that are looked at
constexpr double UNDISPUTED = .85;          // evidence x visible share of a candidate that no other seed will better
constexpr double UNDISPUTED_EVIDENCE = .9;  // of a half-hidden one

// A picture with targets takes .05 to .4 looks a pixel, clutter up to 3.
constexpr double LOOKS_PER_PIXEL = .6;
constexpr double MIN_LOOKS = 1200000;  // seven targets take 500000, however small the picture

// Of the looks may be spent after the round seeds that share their centre with others, the pieces with many votes, the
// other round seeds. In clutter the votes are .22 to .26, in targets .25 to .83.
constexpr double CONCENTRIC_SHARE = .5;
constexpr double PIECES_SHARE = .8;
constexpr double SINGLE_SHARE = .95;
constexpr double MANY_VOTES = .3;

struct ArcSeed
{
  RingSeed seed;
  double votes = 0;
};

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

bool isUndisputed(const RingCandidate& candidate)
{
  return candidate.evidence * candidate.visible > UNDISPUTED || candidate.evidence > UNDISPUTED_EVIDENCE;
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
/** Whether a candidate that no other seed will better contains the point. */
bool isInUndisputed(const std::vector<RingCandidate>& candidates, const cv::Point2d& point)
{
  return std::any_of(candidates.begin(), candidates.end(), [&](const RingCandidate& candidate) {
    return isUndisputed(candidate) && contains(candidate, point);
  });
}

/** Grows a seed with looks of its own, so that the result is the same in any order and thread. */
GrownSeed growSeed(EdgelMap map, const cv::Mat& bgr, const RingSeed& seed, bool is_boundary, int min_rings)
{
  GrownSeed grown;
  const std::size_t before = map.looks();
  grown.is_grown = true;
  grown.is_target = (!is_boundary || hasOwnBoundary(map, bgr, seed)) &&
                    growCandidate(map, bgr, seed, is_boundary, grown.candidate) && isTarget(grown.candidate, min_rings);
  grown.looks = map.looks() - before;
  return grown;
}

void allow(EdgelMap& map, const cv::Mat& bgr, double share)
{
  map.setMaxLooks(static_cast<std::size_t>(share * static_cast<double>(allowedLooks(bgr.size()))));
}
}  // namespace

std::size_t allowedLooks(const cv::Size& image_size)
{
  return static_cast<std::size_t>(std::max(MIN_LOOKS, LOOKS_PER_PIXEL * image_size.area()));
}

RoundSeeds toRoundSeeds(const RegionMap& regions)
{
  RoundSeeds seeds;
  seeds.seeds = findRoundSeeds(regions.regions);
  seeds.grown.resize(seeds.seeds.size());
  return seeds;
}

void growConcentric(const EdgelMap& source, const cv::Mat& bgr, int min_rings, RoundSeeds& seeds)
{
  EdgelMap map = source;
  allow(map, bgr, CONCENTRIC_SHARE);
  std::vector<RingCandidate> candidates;
  for (std::size_t i = 0; i < seeds.seeds.size() && !map.isSpent(); ++i)
  {
    const RingSeed& seed = seeds.seeds[i];
    if (seed.companions > 0 && !isInUndisputed(candidates, seed.family.center))
    {
      seeds.grown[i] = growSeed(map, bgr, seed, true, min_rings);
      map.addLooks(seeds.grown[i].looks);
      if (seeds.grown[i].is_target)
      {
        candidates.push_back(seeds.grown[i].candidate);
      }
    }
  }
}

std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              const std::vector<Checkerboard>& boards, int min_rings)
{
  return findRingCandidates(map, bgr, regions, toRoundSeeds(regions), boards, min_rings);
}

std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              RoundSeeds seeds, const std::vector<Checkerboard>& boards, int min_rings)
{
  std::vector<RingCandidate> candidates;
  const auto is_taken = [&](const cv::Point2d& point) {
    return isOnBoard(point, boards) || isInUndisputed(candidates, point);
  };
  const auto add = [&](GrownSeed grown) {
    map.addLooks(grown.looks);
    if (grown.is_target)
    {
      candidates.push_back(std::move(grown.candidate));
    }
  };
  const auto try_round = [&](bool with_companions) {
    for (std::size_t i = 0; i < seeds.seeds.size(); ++i)
    {
      const RingSeed& seed = seeds.seeds[i];
      if ((seed.companions > 0) == with_companions && !map.isSpent() && !is_taken(seed.family.center))
      {
        GrownSeed& grown = seeds.grown[i];
        add(grown.is_grown ? std::move(grown) : growSeed(map, bgr, seed, true, min_rings));
      }
    }
  };
  allow(map, bgr, CONCENTRIC_SHARE);
  try_round(true);
  allow(map, bgr, PIECES_SHARE);
  std::vector<ArcSeed> arcs;
  int pieces = 0;
  for (const Region* piece : findPieces(regions.regions))
  {
    if (pieces < MAX_PIECES && !is_taken(piece->center))
    {
      ++pieces;
      ArcSeed arc;
      if (findArcSeed(map, *piece, arc.seed, arc.votes))
      {
        arcs.push_back(arc);
      }
    }
  }
  std::stable_sort(arcs.begin(), arcs.end(),
                   [](const ArcSeed& left, const ArcSeed& right) { return left.votes > right.votes; });
  const auto try_arcs = [&](bool with_many_votes) {
    for (const ArcSeed& arc : arcs)
    {
      if ((arc.votes > MANY_VOTES) == with_many_votes && !map.isSpent() && !is_taken(arc.seed.family.center))
      {
        add(growSeed(map, bgr, arc.seed, false, min_rings));
      }
    }
  };
  try_arcs(true);
  allow(map, bgr, SINGLE_SHARE);
  try_round(false);
  allow(map, bgr, 1);
  try_arcs(false);
  return bestOfEachPlace(std::move(candidates));
}

}  // namespace omr
