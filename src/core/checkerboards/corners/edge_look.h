#ifndef OUTDOOR_OMR_CORE_EDGE_LOOK_H
#define OUTDOOR_OMR_CORE_EDGE_LOOK_H

#include "corner_ring.h"
#include "local_frame.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** Whether edges can be looked at there: the squares large enough, and in the picture. False as well where a model
 * bursts. */
bool showsEdges(const Frame& frame, const LocalFrame& predicted);

/** Light beside dark across a lattice line, at one place of it. */
struct Edge
{
  /** Whether it lies on a line, with light beside dark as elsewhere on the board. */
  bool isLike(float line, float board_ratio) const;

  float offset = 0;    ///< from the place, towards positive u or v [squares]
  float ratio = 0;     ///< logarithm of light to dark
  float contrast = 0;  ///< light minus dark [grey levels]
};

/**
 * The strongest edge of a sign within a fifth of a square of a place on a lattice line.
 *
 * @param place   on the line, from the frame's node [squares].
 * @param along_u the line runs along u and is looked across along v; else the other way round.
 * @param sign    +1: light towards positive u or v; -1: dark.
 */
Edge strongestEdge(const PyramidView& view, const LocalFrame& frame, const cv::Point2f& place, bool along_u, int sign);

/** What the four edges say that meet in a corner. */
struct CornerEdges
{
  bool alike = false;    ///< most places show one ratio of light to dark, on straight lines through the corner
  float ratio = 0;       ///< median, logarithm; all that there is where the edges are not alike
  cv::Point2f position;  ///< [px]
  float contrast = 0;    ///< median [grey levels]
  float agreeing = 0;    ///< share of the places [0, 1]
};

/**
 * Looks at the four edges that meet in a corner, each at places of its own. Ink and paper have one ratio in the sun and
 * in the shade, and light and dark are compared close to each other, so the edges of shadows through the corner, which
 * spoil a ring of samples around it, disturb few of the places.
 *
 * @param predicted within a fifth of a square of the corner.
 * @param sign      see CornerLook::sign; not 0.
 */
CornerEdges lookAtEdges(const PyramidView& view, const LocalFrame& predicted, int sign);

/**
 * The same where the corner is known to a tenth of a square: an edge that a shadow's own runs along may be missing.
 *
 * @param ratio of the board, logarithm.
 */
CornerEdges lookAtKnownEdges(const PyramidView& view, const LocalFrame& known, int sign, float ratio);

}  // namespace omr

#endif
