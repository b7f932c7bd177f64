#include "bent_outline.h"

#include <algorithm>

namespace omr
{
std::vector<cv::Point2f> bentOutline(const Checkerboard& board)
{
  const int rows = board.rows - 1;
  const int cols = board.cols - 1;
  const auto count = static_cast<std::size_t>(std::max(0, rows)) * static_cast<std::size_t>(std::max(0, cols));
  if (rows < 3 || cols < 3 || board.inner_corners.size() != count || board.inner_corners_seen.size() != count)
  {
    return {board.corners.begin(), board.corners.end()};
  }
  std::vector<cv::Point2f> outline;
  const auto go_on = [&](int end, int step) {  // indices of a line's last corner, and from it to the last but one
    if (board.inner_corners_seen[end] && board.inner_corners_seen[end + step] &&
        board.inner_corners_seen[end + 2 * step])
    {
      outline.push_back(3 * (board.inner_corners[end] - board.inner_corners[end + step]) +
                        board.inner_corners[end + 2 * step]);
    }
  };
  const int last = rows * cols - 1;
  outline.push_back(board.corners[0]);
  for (int i = 0; i < cols; ++i)
  {
    go_on(i, cols);
  }
  outline.push_back(board.corners[1]);
  for (int i = cols - 1; i <= last; i += cols)
  {
    go_on(i, -1);
  }
  outline.push_back(board.corners[2]);
  for (int i = last; i > last - cols; --i)
  {
    go_on(i, -cols);
  }
  outline.push_back(board.corners[3]);
  for (int i = last - cols + 1; i >= 0; i -= cols)
  {
    go_on(i, 1);
  }
  return outline;
}

}  // namespace omr
