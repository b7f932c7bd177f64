#ifndef OUTDOOR_OMR_CORE_LATTICE_SEAM_H
#define OUTDOOR_OMR_CORE_LATTICE_SEAM_H

#include <vector>

#include "lattice.h"
#include "lattice_side.h"

namespace omr
{
/** A line of nodes on which two boards have their border. */
struct Seam
{
  Side beyond = top;  ///< the side of the lattice that lies beyond it, seen from the seed
  int line = 0;
};

/**
 * Whether the squares do not go on evenly across a line of the lattice: two boards lie side by side there, a fraction
 * of a square apart or displaced along their common border. Each has its four lines of inner corners at least, so
 * shorter lattices have no seam.
 *
 * @param lattice corners as they were found: a surface drawn through all of them would hide the seam.
 */
bool hasSeam(const Lattice& lattice);

/** Takes back what lies on a seam and beyond. */
void dropBeyond(Lattice& lattice, const Seam& seam);

/** The same for all of them. @return the seams. */
std::vector<Seam> splitAtSeams(Lattice& lattice);

}  // namespace omr

#endif
