#ifndef OUTDOOR_OMR_CORE_RING_ACCEPTANCE_H
#define OUTDOOR_OMR_CORE_RING_ACCEPTANCE_H

#include "ring_candidate.h"

namespace omr
{
/** Whether the evidence is such as clutter does not give, in nearly all directions or all around in the open ones. */
bool isClearTarget(const RingCandidate& candidate, int min_rings);

/** The same, or so much shows that it does not matter in how many directions. */
bool isTarget(const RingCandidate& candidate, int min_rings);

/** Whether there are two clear boundaries of rings so narrow that the blur may hide more. */
bool mayHideRings(const RingCandidate& candidate);

/** Whether isTarget() may be true of rings that were settled in some directions only. */
bool maySuffice(const RingCandidate& candidate);

/** Whether it may become true of them, as what is seen so far tells. */
bool showsEnough(const RingCandidate& candidate);

}  // namespace omr

#endif
