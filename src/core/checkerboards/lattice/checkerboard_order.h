#ifndef OUTDOOR_OMR_CORE_CHECKERBOARD_ORDER_H
#define OUTDOOR_OMR_CORE_CHECKERBOARD_ORDER_H

#include <opencv2/core.hpp>
#include <vector>

#include "lattice.h"
#include "outdoor_omr/checkerboard.h"

namespace omr
{
/**
 * A board from its refined lattice, in the order that Checkerboard promises; regularity and size_certain are left.
 *
 * @param lattice every node of the box has a position, and u, v of its seed turn clockwise.
 * @param seen    one flag a node of the box, row by row.
 */
Checkerboard orderCheckerboard(const Lattice& lattice, const std::vector<bool>& seen);

/** Corners of the board's squares in the order of their outline, four a square, the squares row by row as in
 * Checkerboard [px]. The outermost ones are extrapolated. */
std::vector<cv::Point2f> squareCorners(const Lattice& lattice);

/** Outline of the board [px], a point for every square along its sides, clockwise; extrapolated. */
std::vector<cv::Point2f> boardOutline(const Lattice& lattice);

}  // namespace omr

#endif
