#ifndef OUTDOOR_OMR_CORE_RING_SEARCH_H
#define OUTDOOR_OMR_CORE_RING_SEARCH_H

#include <atomic>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/region.h"
#include "ring_lookahead.h"
#include "targets/candidate/ring_candidate.h"
#include "targets/edges/edgels.h"

namespace omr
{
/**
 * Grows the regions that may be part of a target, the most promising first, until allowedLooks() are spent.
 *
 * @param bgr       H x W, CV_8UC3; the map's image.
 * @param seeds     what is found and grown already; the rest is done here.
 * @param boards    what lies on them, where they show, is no target.
 * @param min_rings of a target.
 * @param is_vain   if given and set meanwhile, the search ends soon; what it found is of no use then.
 * @return          what isTarget(), the best of each place.
 */
std::vector<RingCandidate> findRingCandidates(EdgelMap& map, const cv::Mat& bgr, const RegionMap& regions,
                                              RoundSeeds seeds, const std::vector<Checkerboard>& boards, int min_rings,
                                              const std::atomic<bool>* is_vain = nullptr);

}  // namespace omr

#endif
