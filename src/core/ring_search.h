#ifndef OUTDOOR_OMR_CORE_RING_SEARCH_H
#define OUTDOOR_OMR_CORE_RING_SEARCH_H

#include <optional>
#include <utility>
#include <vector>

#include "edgels.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/region.h"
#include "ring_candidate.h"
#include "ring_seeds.h"

namespace omr
{
/** Looks at edgels (EdgelMap::looks()) that a search in an image may take. */
std::size_t allowedLooks(const cv::Size& image_size);

/** What became of a seed. */
struct GrownSeed
{
  explicit GrownSeed(EdgelMap fork) : map(std::move(fork))
  {
  }

  bool is_target = false;
  RingCandidate candidate;
  EdgelMap map;  ///< a fork, which knows the looks that it took
};

/** The round seeds of an image, some grown already. */
struct RoundSeeds
{
  std::vector<RingSeed> seeds;
  std::vector<std::optional<GrownSeed>> grown;  // one a seed
};

RoundSeeds toRoundSeeds(const RegionMap& regions);

/**
 * Grows seeds that share their centre with others, as long as there is one outside of what was found: those that
 * findRingCandidates() begins with, if they lie on no board.
 */
void growConcentric(const EdgelMap& map, const cv::Mat& bgr, int min_rings, RoundSeeds& seeds);

/**
 * Grows the regions that may be part of a target, the most promising first, until allowedLooks() are spent: on no
 * clutter the search takes more.
 *
 * @param bgr       H x W, CV_8UC3; the map's image.
 * @param seeds     of the regions.
 * @param boards    what lies on them is no target.
 * @param min_rings of a target.
 * @return          what isTarget(), the best of each place.
 */
std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              RoundSeeds seeds, const std::vector<Checkerboard>& boards, int min_rings);

/** The same with the seeds of the regions. */
std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              const std::vector<Checkerboard>& boards, int min_rings);

}  // namespace omr

#endif
