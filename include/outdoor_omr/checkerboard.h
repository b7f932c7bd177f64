#ifndef OUTDOOR_OMR_CHECKERBOARD_H
#define OUTDOOR_OMR_CHECKERBOARD_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace outdoor_omr
{
/**
 * One checkerboard. Positions in pixels, pixel (0, 0) has its centre at (0, 0).
 *
 * Order: rows run along the shorter side (rows <= cols), clockwise in the image, never mirrored: the first row runs
 * from the first corner, and the rows follow to the right of it as seen along the row (y down). The first inner corner
 * lies beside a black corner square; among those still equal it is the one nearest to the image's top left. A board
 * whose black corner squares are equal under a half turn (rows + cols even, or both odd...) is ambiguous by 180
 * degrees.
 */
struct Checkerboard
{
  int rows = 0;  ///< squares along the shorter side
  int cols = 0;  ///< squares along the longer side

  /** Outer corners of the board: beside the first, the last inner corner of the first row, the last, the first of the
   * last row. Extrapolated from the inner corners. */
  std::array<cv::Point2f, 4> corners;

  std::vector<cv::Point2f> inner_corners;  ///< (rows - 1) * (cols - 1), row by row
  std::vector<bool> inner_corners_seen;    ///< false: hidden, its position is predicted from the seen ones

  std::vector<cv::Point2f> squares;  ///< rows * cols forecast centres of the squares, row by row (paper, 3.4.1)
  std::vector<bool> squares_seen;    ///< a region of the fill pipeline lies where the square was forecast
  double regularity = 0;             ///< share of the forecast squares that are there [0, 1]

  /** False where a rim of the board may be hidden or cut by the picture's edge: rows and cols are then the least. */
  bool size_certain = true;
};

}  // namespace outdoor_omr

#endif
