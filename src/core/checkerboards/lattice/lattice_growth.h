#ifndef OUTDOOR_OMR_CORE_LATTICE_GROWTH_H
#define OUTDOOR_OMR_CORE_LATTICE_GROWTH_H

#include "checkerboards/corners/corner_look.h"
#include "lattice.h"

namespace omr
{
/** Finds corners outwards from those found, best supported first, until none is added or there are max_count. */
void growLattice(Lattice& lattice, CornerLooker& looker, int max_count);

/** Looks once more at every node of the box that was not found, now with all its neighbours. */
void fillHoles(Lattice& lattice, CornerLooker& looker);

}  // namespace omr

#endif
