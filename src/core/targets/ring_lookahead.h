#ifndef OUTDOOR_OMR_CORE_RING_LOOKAHEAD_H
#define OUTDOOR_OMR_CORE_RING_LOOKAHEAD_H

#include <utility>
#include <vector>

#include "targets/candidate/ring_acceptance.h"
#include "targets/candidate/ring_candidate.h"
#include "targets/edges/edgels.h"
#include "targets/seeds/arc_families.h"
#include "targets/seeds/round_spots.h"

namespace omr
{
/** What became of a seed. */
struct GrownSeed
{
  explicit GrownSeed(EdgelMap fork) : map(std::move(fork))
  {
  }

  /** Of a candidate that is no target nothing is kept: seeds are copied. */
  void settle(bool is_grown, int min_rings)
  {
    const bool is_clear = is_grown && isTarget(candidate, min_rings);
    candidate.is_merged = is_grown && !is_clear && mayHideRings(candidate);
    is_target = is_clear || candidate.is_merged;
    if (!is_target)
    {
      candidate = RingCandidate();
    }
  }

  bool is_target = false;
  RingCandidate candidate;
  EdgelMap map;  ///< a fork, which knows the looks that it took
};

/** What the search begins with: families of arcs, grown already, and the round spots of an image. */
struct RoundSeeds
{
  std::vector<ArcFamily> arcs;      // their families, the one with most arcs first
  std::vector<GrownSeed> families;  // one for each of them
  std::vector<RoundSpot> spots;     // the roundest first
  bool has_arcs = false;
  bool has_families = false;
  bool has_spots = false;
};

/** Finds and grows the families of arcs, from which most targets come, what of it was not done before. */
void growFamilies(const EdgelMap& map, const cv::Mat& bgr, int min_rings, RoundSeeds& seeds);

/**
 * Finds the round spots, if that was not done before; may run beside growFamilies().
 *
 * @param image CV_8UC1 or CV_8UC3.
 */
void addRoundSpots(const cv::Mat& image, RoundSeeds& seeds);

}  // namespace omr

#endif
