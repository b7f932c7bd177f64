#ifndef OUTDOOR_OMR_CORE_LATTICE_GAPS_H
#define OUTDOOR_OMR_CORE_LATTICE_GAPS_H

#include "checkerboards/corners/corner_look.h"
#include "lattice.h"

namespace omr
{
/** Finds corners beyond what hides a part of the board, up to three squares away; not across a border, where the next
 * board may begin. */
void jumpGaps(Lattice& lattice, CornerLooker& looker);

/** Takes back what lies beyond a border inside the lattice: another board in the same plane, found across its margin.
 */
void splitAtBorders(Lattice& lattice, const Frame& frame);

}  // namespace omr

#endif
