#ifndef OUTDOOR_OMR_CORE_SIZE_CERTAINTY_H
#define OUTDOOR_OMR_CORE_SIZE_CERTAINTY_H

#include <array>
#include <vector>

#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_extent.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/**
 * Whether all four ends of a board are seen, so that nothing hidden may belong to it: borders, or a narrow margin,
 * where dark squares of the rim end along one line and light ones do not, as far out as on the opposite side. Bare ends
 * are none: the window of a mat ends squares so too (of 45 drawn ones 26 were certain -> 2). Borders are none where
 * the squares are cut aslant or slivers of further ones show.
 *
 * @param lattice its refined corners.
 * @param seen    what refineCorners() gave. Where none is seen on an outermost line, no end is; where none is on two
 *                lines side by side, they may be the gap between two boards.
 */
bool isSizeCertain(const Frame& frame, const Lattice& lattice, const std::vector<bool>& seen,
                   const std::array<SideEvidence, 4>& sides);

}  // namespace omr

#endif
