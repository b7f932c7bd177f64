#ifndef OUTDOOR_OMR_CORE_GROWN_SQUARES_H
#define OUTDOOR_OMR_CORE_GROWN_SQUARES_H

#include "eroded_squares.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/frame.h"
#include "resized_part.h"

namespace omr
{
/** The part, resized, with dark squares grown until they touch again. @param resized receives where it lies. */
Frame growDarkSquares(const Frame& frame, const ErodedPart& part, ResizedPart& resized);

/**
 * Whether something of further squares is left beyond a rim of the board: of squares cut in half, as on many boards,
 * light leaves next to nothing.
 */
bool leavesRemnants(const Frame& frame, const Checkerboard& board);

}  // namespace omr

#endif
