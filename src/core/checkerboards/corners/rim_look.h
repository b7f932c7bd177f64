#ifndef OUTDOOR_OMR_CORE_RIM_LOOK_H
#define OUTDOOR_OMR_CORE_RIM_LOOK_H

#include "local_frame.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** What the image shows where a board would end. */
enum class RimLook
{
  outer_corner,  ///< one quadrant dark, the other three alike light: a dark square in the margin
  outer_edge,    ///< only the edge of the dark square, and none of the light one beside it; under a shadow's edge
  bare_edge,     ///< a dark and a light square end at one plain ground: a board without a margin
  inner_corner,  ///< four squares: the board goes on
  unclear
};

/** Where a dark square of the rim would meet the margin. */
struct RimPlace
{
  LocalFrame predicted;
  int dark_u = 1, dark_v = 1;  ///< +1 or -1: the quadrant of the dark square
  bool along_row = true;       ///< the border runs along u, else along v
};

/**
 * Looks whether the board ends at a place, without refinement.
 *
 * @param contrast of the known corners near by [grey levels].
 */
RimLook lookAtRim(const Frame& frame, const RimPlace& place, float contrast);

/**
 * Whether the light square of the rim beside the place, on the other side than the dark one, is followed outwards by as
 * light a margin, and inwards by a dark square.
 */
bool marginFollows(const Frame& frame, const RimPlace& place);

}  // namespace omr

#endif
