#include "board_surface.h"

#include <cmath>

namespace omr
{
cv::Affine3d touchingFrame(const PartCheckerboard& board, double x, double y)
{
  if (board.curvature == 0)
  {
    return {cv::Matx33d::eye(), cv::Vec3d(x, y, 0)};
  }
  const double angle = (board.axis_along_x ? y : x) * board.curvature;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double across = s / board.curvature;
  const double depth = 2 * std::pow(std::sin(angle / 2), 2) / board.curvature;
  if (board.axis_along_x)
  {
    return {cv::Matx33d(1, 0, 0, 0, c, -s, 0, s, c), cv::Vec3d(x, across, depth)};
  }
  return {cv::Matx33d(c, 0, -s, 0, 1, 0, s, 0, c), cv::Vec3d(across, y, depth)};
}

std::vector<cv::Point3d> innerCorners(const PartCheckerboard& board)
{
  std::vector<cv::Point3d> corners;
  for (int row = 1; row < board.rows; ++row)
  {
    for (int col = 1; col < board.cols; ++col)
    {
      const cv::Affine3d frame =
          touchingFrame(board, (col - board.cols / 2.0) * board.square, (row - board.rows / 2.0) * board.square);
      corners.emplace_back(board.pose * cv::Point3d(frame.translation()));
    }
  }
  return corners;
}

}  // namespace omr
