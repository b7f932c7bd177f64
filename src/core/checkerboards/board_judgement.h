#ifndef OUTDOOR_OMR_CORE_BOARD_JUDGEMENT_H
#define OUTDOOR_OMR_CORE_BOARD_JUDGEMENT_H

#include <array>

#include "corner_look.h"
#include "lattice.h"
#include "lattice_extent.h"

namespace omr
{
constexpr int MAX_SIDE = 20;  ///< paper, section 3.4: at most 21x21 squares; inner corners are one less

/** Whether a lattice is larger than any board, even with the lines of false corners that the shadow of a fence draws in
 * the margin and that are trimmed later: a tiling goes on over the whole picture. */
bool isOvergrown(const Lattice& lattice);

/** Whether a lattice is worth the looks beyond its gaps: it has a border somewhere, or very clear corners. */
bool mayBePart(const Lattice& lattice, CornerLooker& looker);

/** Whether a lattice whose extent is settled is a board. */
bool isBoard(const Lattice& lattice, const std::array<SideEvidence, 4>& sides);

/** Whether a lattice is a board that was read by its edges, see readByEdges(). */
bool isBoardOfEdges(const Lattice& lattice, const std::array<SideEvidence, 4>& sides);

}  // namespace omr

#endif
