#ifndef OUTDOOR_OMR_CORE_EDGE_READING_H
#define OUTDOOR_OMR_CORE_EDGE_READING_H

#include <array>

#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_extent.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/**
 * Reads a lattice anew by the edges of its squares. Under hard shadows corners are found up to a quarter of a square
 * beside their places, and many not at all; one plane through most of them still says where all edges run, and there
 * ink and paper keep one ratio. Unevenness of a board below a fence: 0.23 -> 0.03 squares.
 *
 * A clutter's lattice ends at the first few of its corners, whose edges are not alike.
 *
 * @param lattice receives the corners, found and hidden ones, of the board as its edges end.
 * @param sides   receive what is seen of its sides; never SideEvidence::border, for no margin was looked at.
 * @return false, with the lattice as it was, if its edges are not those of squares.
 */
bool readByEdges(const Frame& frame, Lattice& lattice, std::array<SideEvidence, 4>& sides);

/** Moves the corners of a lattice that was read to where their pictures have them, as far as its surface admits it. */
void fitReadCorners(const Frame& frame, Lattice& lattice);

}  // namespace omr

#endif
