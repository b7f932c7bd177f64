#ifndef OUTDOOR_OMR_CORE_LATTICE_SIDE_H
#define OUTDOOR_OMR_CORE_LATTICE_SIDE_H

#include <array>

#include "lattice.h"

namespace omr
{
enum Side
{
  top,
  right,
  bottom,
  left
};
constexpr std::array<Side, 4> SIDES = {top, right, bottom, left};

struct Node
{
  int row, col;
};

/** Whether the side runs along the rows of the lattice. */
bool isRow(Side side);

/** +1 or -1: the direction from the side's border into the board. */
int inwards(Side side);

/** Index of the line that lies `distance` outside the outermost line of nodes. */
int lineIndex(const Lattice& lattice, Side side, int distance);

/** Index of the first node along the side, and the number of nodes. */
int lineStart(const Lattice& lattice, Side side);
int lineLength(const Lattice& lattice, Side side);

Node nodeOnLine(Side side, int line, int along);

/** Corners found on a line parallel to the side. */
int countOnLine(const Lattice& lattice, Side side, int line);

/** Takes back the outermost line and makes the box smaller. */
void dropLine(Lattice& lattice, Side side);

/** Makes the box larger by lines of hidden corners. */
void addLines(Lattice& lattice, Side side, int count);

}  // namespace omr

#endif
