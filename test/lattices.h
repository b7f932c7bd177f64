#ifndef OUTDOOR_OMR_TEST_LATTICES_H
#define OUTDOOR_OMR_TEST_LATTICES_H

#include <gtest/gtest.h>

#include "checkerboards/corners/corner_look.h"
#include "checkerboards/lattice/lattice.h"
#include "checkerboards/lattice/lattice_growth.h"

namespace omr::test
{
/** A lattice grown from one corner of the board. */
inline Lattice grow(CornerLooker& looker, const LocalFrame& seed)
{
  Lattice lattice;
  const CornerLook corner = looker.look(seed, CornerQuery());
  EXPECT_TRUE(corner.found);
  lattice.start(seed, corner);
  growLattice(lattice, looker, Lattice::SIZE * Lattice::SIZE);
  return lattice;
}

/**
 * A lattice of clear corners.
 *
 * @param position of a corner by its column and row, from (0, 0) [px].
 * @param sign     of the first corner: -1 where the squares before and behind it are black.
 */
template <typename Position>
Lattice latticeOf(int rows, int cols, const Position& position, int sign = 1)
{
  CornerLook corner;
  corner.found = true;
  corner.sign = sign;
  corner.contrast = 100;
  corner.correlation = 1;
  corner.position = position(0, 0);
  Lattice lattice;
  lattice.start({position(0, 0), position(1, 0) - position(0, 0), position(0, 1) - position(0, 0)}, corner);
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < cols; ++j)
    {
      corner.position = position(j, i);
      lattice.put(Lattice::SEED + i, Lattice::SEED + j, corner);
    }
  }
  return lattice;
}

}  // namespace omr::test

#endif
