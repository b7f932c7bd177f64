#ifndef OUTDOOR_OMR_CORE_BORDER_H
#define OUTDOOR_OMR_CORE_BORDER_H

#include "lattice.h"
#include "lattice_side.h"
#include "outdoor_omr/frame.h"

namespace omr
{
constexpr int BORDER_WINDOW = 3;  ///< nodes, of a prediction beside the lattice

/** Places of a border where four squares may seem to meet: a corner of a target or of the next board. More are squares
 * beside what covers the others: of 1272 boards drawn below things, shadows and light 16 wrong -> 14, one of them
 * certain; none is lost there, of the evaluation sets or of 2126 joined boards. */
constexpr int MAX_GOING_ON = 1;

/** What is seen of a line of outer corners, where the rim squares of a board meet its margin. */
struct BorderLine
{
  int places = 0;   ///< outer corners forecast inside the picture
  int outside = 0;  ///< outer corners forecast outside the picture
  int seen = 0;     ///< of the places, where an outer corner is
  int edges = 0;    ///< places where only the edge of a dark square is there
  int bare = 0;     ///< places where a dark and a light square end at one plain ground, without a margin
  int goes_on = 0;  ///< places where four squares meet instead
  int margins = 0;  ///< light squares of the rim that the margin follows, where a dark one would if the board went on

  /** The board ends at this line, with a margin beyond. */
  bool ends() const;

  /** The board ends at this line, without a margin; or a thing that lies on it has its edge here. */
  bool endsBare() const;

  /** So much speaks for it that nothing beyond it may be taken for the same board. */
  bool mayEnd() const;
};

/**
 * Looks at the places beside the lattice where the board would end.
 *
 * @param distance 1: the line beside the outermost inner corners; 0: that line itself; more: beyond it.
 */
BorderLine lookAtBorder(const Lattice& lattice, const Frame& frame, Side side, int distance);

/** The same for any line. @param window of the predictions [nodes]. */
BorderLine lookAtLine(const Lattice& lattice, const Frame& frame, Side side, int line, int window);

/**
 * How many of the first three corners of a neighbouring side's rim are seen beyond this side's border, the more of both
 * neighbours. Some are where a thing covers the middle of a board that goes on, and its edge was taken for the border.
 */
int rimBeyond(const Lattice& lattice, const Frame& frame, Side side);

}  // namespace omr

#endif
