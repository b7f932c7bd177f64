#ifndef OUTDOOR_OMR_CHECKERBOARD_H
#define OUTDOOR_OMR_CHECKERBOARD_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/**
 * One checkerboard. Positions in pixels, pixel (0, 0) has its centre at (0, 0).
 *
 * Order: rows <= cols. Rows follow each other clockwise of the direction along the row (row to the right: next row
 * below), so a board is never mirrored. The first inner corner lies beside a black corner square if the board has one;
 * of the orders that are still possible it is the one whose first inner corner is nearest to the image's top left.
 *
 * With rows + cols odd that settles the order. With rows + cols even a half turn gives the same picture, so the order
 * is ambiguous by 180 degrees, and by 90 degrees where rows = cols is odd: it can change when the board turns.
 */
struct Checkerboard
{
  int rows = 0;  ///< squares along the shorter side
  int cols = 0;  ///< squares along the longer side

  /** Outer corners of the board: beside the first and the last inner corner of the first row, the last and the first of
   * the last row. Extrapolated from the inner corners. */
  std::array<cv::Point2f, 4> corners;

  std::vector<cv::Point2f> inner_corners;  ///< (rows - 1) * (cols - 1), row by row
  std::vector<bool> inner_corners_seen;    ///< false: hidden or in part, its position is predicted from the seen ones

  std::vector<cv::Point2f> squares;  ///< rows * cols forecast centres of the squares, row by row (paper, 3.4.1)
  std::vector<bool> squares_seen;    ///< see regularity.h; one a square, row by row
  double regularity = 0;             ///< share of the forecast squares that are there [0, 1]

  /**
   * True: on all four sides the end of the board, dark rim squares against a light margin, was seen. False: a side is
   * hidden or has no light margin, or the board touches or leaves the picture; it may then have more rows or columns
   * than were found. False as well where a band right across the board hides two lines of inner corners side by side:
   * it may be the gap between two boards. False where too much light has parted the squares: a rim may be gone.
   */
  bool size_certain = true;
};

}  // namespace omr

#endif
