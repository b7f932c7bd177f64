#ifndef OUTDOOR_OMR_CORE_RING_LETTERS_H
#define OUTDOOR_OMR_CORE_RING_LETTERS_H

#include <string>

#include "targets/candidate/ring_candidate.h"

namespace omr
{
/** The letters of the rings; a boundary between equal ones is no ring's: the candidate loses it. */
std::string readLetters(RingCandidate& candidate);

/** Whether the edgels lie so close to the circles that letters may be clear, though they explain the rings worse. */
bool fitsClosely(const Rings& rings);

}  // namespace omr

#endif
