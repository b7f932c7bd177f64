#ifndef OUTDOOR_OMR_CORE_RING_BOUNDARIES_H
#define OUTDOOR_OMR_CORE_RING_BOUNDARIES_H

#include <cstdint>
#include <vector>

#include "ring_profile.h"

namespace outdoor_omr
{
/** A circle on which the colour steps by the same amount in (nearly) all directions. */
struct Boundary
{
  double radius = 0;       ///< [px]
  LogColor change;         ///< median colour step from the ring inside to what is outside it
  double contrast = 0;     ///< length of that step
  double coherence = 0;    ///< |sum of the steps| / sum of |steps| over all directions [0, 1]
  double agreement = 0;    ///< share of the directions whose step resembles the median and lies at the radius [0, 1]
  std::uint64_t seen = 0;  ///< one bit per direction that lies inside the image
  std::uint64_t agreeing = 0;  ///< one bit per direction that agrees
};

/**
 * The boundaries between rings of any width: the fewest that explain the profile. A shadow's edge, a scratch or a
 * texture steps in some directions only, an overshoot has the same colour on both sides; neither is a boundary.
 */
std::vector<Boundary> findBoundaries(const RingProfile& profile);

}  // namespace outdoor_omr

#endif
