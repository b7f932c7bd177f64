#ifndef OUTDOOR_OMR_CORE_RING_CANDIDATE_H
#define OUTDOOR_OMR_CORE_RING_CANDIDATE_H

#include <vector>

#include "ring_boundaries.h"
#include "ring_growth.h"
#include "ring_profile.h"
#include "ring_seeds.h"

namespace outdoor_omr
{
/** What may be a target, with the evidence for it. */
struct RingCandidate
{
  Rings rings;
  std::vector<Boundary> boundaries;  ///< one per radius of rings
  std::vector<double> support;       ///< angular support of each boundary by edgels [0, 1]
  RingProfile profile;               ///< of the final family
};

/**
 * Grows a seed to a candidate: edgels give the family, the profile then says which boundaries there are.
 *
 * @return false if there are no two of them.
 */
bool growCandidate(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed, RingCandidate& candidate);

/** Whether the evidence is such as clutter does not give. */
bool isTarget(const RingCandidate& candidate, int min_rings);

}  // namespace outdoor_omr

#endif
