#ifndef OUTDOOR_OMR_CORE_BOARD_JUDGEMENT_H
#define OUTDOOR_OMR_CORE_BOARD_JUDGEMENT_H

#include <array>

#include "checkerboards/corners/corner_look.h"
#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_extent.h"

namespace omr
{
constexpr int MAX_SIDE = 20;  ///< paper, section 3.4: at most 21x21 squares; inner corners are one less

/** Whether a lattice is larger than any board, even with the lines of false corners that the shadow of a fence draws in
 * the margin and that are trimmed later: a tiling goes on over the whole picture. */
bool isOvergrown(const Lattice& lattice);

/** Whether a lattice is worth the looks beyond its gaps: it has a border somewhere, or very clear corners. */
bool mayBePart(const Lattice& lattice, CornerLooker& looker);

/**
 * Whether the found corners leave all four corners of the lattice empty: the gaps of a grid of dots make a checkerboard
 * that lies across it. Of 2546 boards the emptiest one lacks 0.2 of the shorter side there; of 44 drawn grids of dots
 * 11 were boards, which lack 0.28 and more.
 */
bool liesAcross(const Lattice& lattice);

/** Whether a lattice whose extent is settled is a board. */
bool isBoard(const Lattice& lattice, const std::array<SideEvidence, 4>& sides);

/** Whether a lattice is a board that was read by its edges, see readByEdges(). */
bool isBoardOfEdges(const Lattice& lattice, const std::array<SideEvidence, 4>& sides);

}  // namespace omr

#endif
