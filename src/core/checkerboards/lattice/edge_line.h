#ifndef OUTDOOR_OMR_CORE_EDGE_LINE_H
#define OUTDOOR_OMR_CORE_EDGE_LINE_H

#include <array>

#include "lattice.h"
#include "lattice_extent.h"
#include "lattice_model.h"
#include "lattice_side.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** What the edges on a line outside the lattice and to both sides of it say, where the board might end. */
struct EdgeLine
{
  /** The dark squares of the rim end at the line. */
  bool ends() const;

  /** Squares lie inside the line, and none outside: so a board ends as well whose rim is narrow, or along whose border
   * a shadow's edge runs. Not where light squares end at dark ones: there the squares beyond are hidden. */
  bool isLast() const;

  /** Squares lie outside the line as well. */
  bool goesOn() const;

  int places = 0;    ///< in the picture, the fewer of both kinds
  float dark = 0;    ///< share of places where a dark square of the rim ends
  float light = 0;   ///< share of places where a light one ends at a dark one
  float inside = 0;  ///< share of places between the squares inside where light meets dark
  float beyond = 0;  ///< the same between the squares that would lie outside
};

/**
 * The surface along which edges are looked for: a plane; once its corners are exact, and the more they are, bent as a
 * lens bends it.
 *
 * @return false if the corners are too few.
 */
bool fitEdges(const Lattice& lattice, bool exact, LatticeModel& model);

/** Median ratio of light to dark at the corners, logarithm; 0 if none shows it. */
float medianRatio(const Frame& frame, const LatticeModel& model, const Lattice& lattice);

/**
 * @param distance of the line from the outermost corners.
 * @param ratio    of the board's light to its dark, logarithm.
 */
EdgeLine lookAtEdgeLine(const Frame& frame, const LatticeModel& model, const Lattice& lattice, Side side, int distance,
                        float ratio);

/**
 * Asks the edges of the squares about the sides that corners alone do not settle. One whose corners are hidden in part
 * is a rim where squares lie inside it and none beyond: of 1354 boards on photographs that were covered, lit and cut 19
 * more are found so, most with narrow rim squares. A rim is none where squares go on (below drawn fences 14 of 15 such
 * sides are refused, of 690 where the board ends none) or, of an uneven lattice without a border, where none lie
 * inside; nor where glare hides the half of its corners and may hide more.
 */
void settleRims(const Frame& frame, const Lattice& lattice, std::array<SideEvidence, 4>& sides);

}  // namespace omr

#endif
