#ifndef OUTDOOR_OMR_CORE_EDGE_GROWTH_H
#define OUTDOOR_OMR_CORE_EDGE_GROWTH_H

#include "checkerboards/corners/local_frame.h"
#include "lattice.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/**
 * Grows the beginning of a lattice by the edges that meet in its corners: below a fence few rings around corners
 * alternate, and a lattice of corners ends at less than six. Enough for readByEdges(), which goes on with one plane.
 *
 * @param seed    within a fifth of a square of a corner.
 * @param lattice receives the corners; what it was before is lost.
 * @return whether they are enough. In clutter mostly the seed's own edges say no.
 */
bool growByEdges(const Frame& frame, const LocalFrame& seed, Lattice& lattice);

}  // namespace omr

#endif
