#ifndef OUTDOOR_OMR_PARTS_H
#define OUTDOOR_OMR_PARTS_H

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <string>
#include <vector>

namespace omr
{
/**
 * A checkerboard on a part. Its frame has its origin in the middle of the board, on the surface: x along the rows, y to
 * the next row, z into the material. The first row and column are those of Checkerboard: rows <= cols, and the square
 * at the low end of x and y is black.
 */
struct PartCheckerboard
{
  int rows = 0;               ///< squares along y, 5 to 21
  int cols = 0;               ///< squares along x, 7 to 21, not less than rows
  double square = 0;          ///< side of a square, along the surface [m]
  double curvature = 0;       ///< 1 / radius of the cylinder it lies on [1/m]; > 0 outside, < 0 inside, 0 a plane
  bool axis_along_x = false;  ///< the cylinder's axis is parallel to x, else to y
  cv::Affine3d pose;          ///< X_part = pose * X_board [m]
};

/** A target on a part. */
struct PartTarget
{
  std::string colors;  ///< from the inner disk outwards, letters W P R G B
  double ring = 0;     ///< width of a ring [m]
  cv::Point3d center;  ///< in the frame of the part [m]
};

/** A rigid thing that carries markers; their combination tells it from others (paper, sections 3.4 and 4.1). */
struct Part
{
  std::string name;
  std::vector<PartCheckerboard> checkerboards;  ///< one at least
  std::vector<PartTarget> targets;
  int copies = 1;  ///< of it that may be in view at once
};

/** The inner corners of a board, row by row, in the frame of its part [m]: (rows - 1) * (cols - 1) points. */
std::vector<cv::Point3d> innerCorners(const PartCheckerboard& board);

/**
 * Reads a parts file; config/parts.yaml explains the format by example.
 *
 * @throws std::runtime_error if the file cannot be read; std::invalid_argument with file, line, key and what is
 *         expected for anything unknown, missing, double or impossible (markers that overlap, a board larger than half
 *         the girth of its cylinder).
 */
std::vector<Part> readParts(const std::string& file);

}  // namespace omr

#endif
