#ifndef OUTDOOR_OMR_CORE_TARGET_READING_H
#define OUTDOOR_OMR_CORE_TARGET_READING_H

#include <vector>

#include "outdoor_omr/target.h"
#include "ring_candidate.h"

namespace omr
{
/** Reads the letters of the candidates; those that have too few for what else is known of them are no targets. */
std::vector<Target> readTargets(std::vector<RingCandidate> candidates, int min_rings);

}  // namespace omr

#endif
