#ifndef OUTDOOR_OMR_CORE_SIZE_CERTAINTY_H
#define OUTDOOR_OMR_CORE_SIZE_CERTAINTY_H

#include <array>
#include <vector>

#include "lattice.h"
#include "lattice_extent.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/**
 * Whether all four ends of a board are seen, so that nothing hidden may belong to it: borders, or bare ends on all
 * sides, or a narrow margin, where dark squares of the rim end along one line and light ones do not, as far out as on
 * the opposite side.
 *
 * @param lattice its refined corners.
 * @param seen    what refineCorners() gave: without a corner that is seen on the outermost line no end is.
 */
bool isSizeCertain(const Frame& frame, const Lattice& lattice, const std::vector<bool>& seen,
                   const std::array<SideEvidence, 4>& sides);

}  // namespace omr

#endif
