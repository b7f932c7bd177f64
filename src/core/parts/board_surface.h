#ifndef OUTDOOR_OMR_CORE_BOARD_SURFACE_H
#define OUTDOOR_OMR_CORE_BOARD_SURFACE_H

#include <opencv2/core/affine.hpp>

#include "outdoor_omr/parts.h"

namespace omr
{
/**
 * The frame that touches a board's surface x and y metres from the middle of the board, measured along the surface; its
 * axes follow the board's. A plane and a cylinder look the same from each of their points, so these frames carry any
 * section of a board to any other.
 *
 * @return X_board = frame * X_touching [m].
 */
cv::Affine3d touchingFrame(const PartCheckerboard& board, double x, double y);

}  // namespace omr

#endif
