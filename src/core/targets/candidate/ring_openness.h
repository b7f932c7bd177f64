#ifndef OUTDOOR_OMR_CORE_RING_OPENNESS_H
#define OUTDOOR_OMR_CORE_RING_OPENNESS_H

#include "ring_growth.h"

namespace omr
{
/**
 * Directions in which most of the boundaries have an edge where they should be: what covers a target hides several of
 * them at once.
 *
 * @param rings with at least one radius.
 */
AngleBins openDirections(EdgelMap& map, const Rings& rings);

/** How far the directions lie to one side: 0 where they are evenly spread, .64 in half of the turn [0, 1]. */
double onesidedness(AngleBins open);

/** Widest run of other directions [share of a turn]. */
double widestGap(AngleBins open);

/** Longest run of directions, of which single ones may be missing [directions]. */
int longestRun(AngleBins bins);

}  // namespace omr

#endif
