#ifndef OUTDOOR_OMR_CORE_RING_AMENDMENT_H
#define OUTDOOR_OMR_CORE_RING_AMENDMENT_H

#include <cstddef>

#include "ring_candidate.h"

namespace omr
{
/** Makes one ring of ring k and the next. */
void removeBoundary(std::size_t k, RingCandidate& candidate);

/** Adds the boundaries that the blur hides between narrow rings. */
void splitMergedRings(const AngularSupport& support, RingCandidate& candidate);

/** Makes a ring of a boundary that is a seam: the black between two hues. */
void widenSeam(const AngularSupport& support, RingCandidate& candidate);

}  // namespace omr

#endif
