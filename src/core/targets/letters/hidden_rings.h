#ifndef OUTDOOR_OMR_CORE_HIDDEN_RINGS_H
#define OUTDOOR_OMR_CORE_HIDDEN_RINGS_H

#include <string>

#include "targets/candidate/ring_candidate.h"

namespace omr
{
/**
 * Whether there are probably more rings than were found: so much of the profile stays unexplained by uniform rings that
 * the blur must hide some, what has no letter is as wide as two, or a further one shows beyond them.
 *
 * @param letters of the rings, as readLetters() found.
 */
bool hidesRings(const RingCandidate& candidate, const std::string& letters);

}  // namespace omr

#endif
