#ifndef OUTDOOR_OMR_LATTICE_EXTENT_H
#define OUTDOOR_OMR_LATTICE_EXTENT_H

#include <array>

#include "outdoor_omr/corner_look.h"
#include "outdoor_omr/lattice.h"

namespace outdoor_omr
{
enum Side
{
  top,
  right,
  bottom,
  left
};
constexpr std::array<Side, 4> SIDES = {top, right, bottom, left};

/** What is seen of a line of outer corners, where the rim squares of a board meet its margin. */
struct BorderLine
{
  int places = 0;   ///< outer corners forecast inside the picture
  int outside = 0;  ///< outer corners forecast outside the picture
  int seen = 0;     ///< those of them that are there
  int edges = 0;    ///< places where only the edge of a dark square is there
  int goes_on = 0;  ///< places where four squares meet instead

  /** The board ends at this line. */
  bool ends() const;

  /** So much speaks for it that nothing beyond it may be taken for the same board. */
  bool mayEnd() const;
};

/**
 * Looks at the places beside the lattice where the board would end.
 *
 * @param distance 1: the line beside the outermost inner corners; 0: that line itself; more: beyond it.
 */
BorderLine lookAtBorder(const Lattice& lattice, CornerLooker& looker, Side side, int distance);

/** Finds corners beyond what hides a part of the board, up to three squares away; not across a border, where the next
 * board may begin. */
void jumpGaps(Lattice& lattice, CornerLooker& looker);

/** Takes back what lies beyond a border inside the lattice: another board in the same plane, found across its margin. */
void splitAtBorders(Lattice& lattice, CornerLooker& looker);

/** Takes back corners that a smooth surface through all of them does not admit, as the edge of a shadow or the next
 * object made them. */
void dropOutliers(Lattice& lattice);

/** How well the end of the board is known on one side of the settled box. */
enum class SideEvidence
{
  border,  ///< the border of the board is seen
  rim,     ///< the last line of inner corners is seen, not the border: a narrow margin, or little of it is visible
  cut,     ///< the border lies outside the picture
  none     ///< hidden: the board may go on
};

/**
 * Settles the box: drops outer lines that little speaks for, and adds lines of hidden inner corners when the border is
 * seen beyond them.
 *
 * @return what is seen of each side, by Side.
 */
std::array<SideEvidence, 4> settleExtent(Lattice& lattice, CornerLooker& looker);

}  // namespace outdoor_omr

#endif
