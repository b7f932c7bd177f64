#ifndef OUTDOOR_OMR_CORE_LATTICE_EXTENT_H
#define OUTDOOR_OMR_CORE_LATTICE_EXTENT_H

#include <array>

#include "checkerboards/corners/corner_look.h"
#include "lattice.h"
#include "lattice_side.h"

namespace omr
{
/** Takes back corners that a smooth surface through all of them does not admit, as the edge of a shadow or the next
 * object made them. */
void dropOutliers(Lattice& lattice);

/** How well the end of the board is known on one side of the settled box. */
enum class SideEvidence
{
  border,           ///< the border of the board is seen, with its margin
  doubtful_border,  ///< the same, but the rim goes on: the edge of what hides a part of the board
  bare,  ///< the squares end at plain ground: a board without a margin, or the edge of a thing that lies on it
  rim,   ///< the last line of inner corners is seen, not the border: a narrow margin, or little of it is visible
  cut,   ///< the border lies outside the picture
  none   ///< hidden: the board may go on
};

/**
 * Settles the box: drops outer lines that little speaks for, and adds lines of hidden inner corners when the border is
 * seen beyond them.
 *
 * @return what is seen of each side, by Side.
 */
std::array<SideEvidence, 4> settleExtent(Lattice& lattice, CornerLooker& looker);

}  // namespace omr

#endif
