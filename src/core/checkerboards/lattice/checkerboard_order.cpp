#include "checkerboard_order.h"

#include <array>
#include <cmath>

#include "lattice_prediction.h"

namespace omr
{
namespace
{
/** Node of the box, or the outer corner beside it. */
cv::Point2f positionOf(const Lattice& lattice, int row, int col)
{
  constexpr int WINDOW = 3;
  if (lattice.found(row, col))
  {
    return lattice.at(row, col).position;
  }
  LocalFrame predicted;
  // Beside hidden corners nothing may be near: then from farther away.
  for (int window = WINDOW; window < Lattice::SIZE && !predictNode(lattice, row, col, window, predicted); window *= 2)
  {
  }
  return predicted.node;
}

/** Intersection of the diagonals: the image of a square's centre under perspective. */
cv::Point2f centerOf(const cv::Point2f* quad)
{
  const cv::Point2f first = quad[2] - quad[0];
  const cv::Point2f second = quad[3] - quad[1];
  const float area = cross(first, second);
  return std::abs(area) < 1e-6F ? (quad[0] + quad[2]) / 2 : quad[0] + cross(quad[1] - quad[0], second) / area * first;
}

/** A grid of values, read in one of the four orders that do not mirror it. */
struct TurnedGrid
{
  int rows, cols;  // before the turn
  int turns;       // quarter turns: the first corner is top left, top right, bottom right, bottom left

  int turnedRows() const
  {
    return turns % 2 == 0 ? rows : cols;
  }
  int turnedCols() const
  {
    return turns % 2 == 0 ? cols : rows;
  }
  int index(int i, int j) const
  {
    switch (turns)
    {
      case 0:
        return i * cols + j;
      case 1:
        return j * cols + (cols - 1 - i);
      case 2:
        return (rows - 1 - i) * cols + (cols - 1 - j);
      default:
        return (rows - 1 - j) * cols + i;
    }
  }
};

/** The order that Checkerboard promises. */
int chooseTurns(const Lattice& lattice)
{
  const cv::Rect& box = lattice.box;
  int best = -1;
  bool best_black = false;
  double best_distance = 0;
  for (int turns = 0; turns < 4; ++turns)
  {
    const TurnedGrid grid{box.height, box.width, turns};
    if (grid.turnedRows() > grid.turnedCols())
    {
      continue;
    }
    const int first = grid.index(0, 0);
    const int row = box.y + first / box.width;
    const int col = box.x + first % box.width;
    // The corner square lies towards -u-v of the top left corner: dark when the sign is negative; a quarter turn
    // on, the next corner's square lies towards +u-v.
    const bool black = (lattice.sign(row, col) < 0) == (turns % 2 == 0);
    const double distance = cv::norm(lattice.at(row, col).position);
    if (best < 0 || (black && !best_black) || (black == best_black && distance < best_distance))
    {
      best = turns;
      best_black = black;
      best_distance = distance;
    }
  }
  return best;
}
}  // namespace

std::vector<cv::Point2f> squareCorners(const Lattice& lattice)
{
  const cv::Rect& box = lattice.box;
  const int stride = box.width + 2;
  std::vector<cv::Point2f> nodes;
  for (int i = box.y - 1; i <= box.br().y; ++i)
  {
    for (int j = box.x - 1; j <= box.br().x; ++j)
    {
      nodes.push_back(positionOf(lattice, i, j));
    }
  }
  const TurnedGrid squares{box.height + 1, box.width + 1, chooseTurns(lattice)};
  std::vector<cv::Point2f> quads;
  for (int i = 0; i < squares.turnedRows(); ++i)
  {
    for (int j = 0; j < squares.turnedCols(); ++j)
    {
      const int square = squares.index(i, j);
      const int first = square / squares.cols * stride + square % squares.cols;
      const int outline[4] = {first, first + 1, first + stride + 1, first + stride};
      for (int corner = 0; corner < 4; ++corner)
      {
        quads.push_back(nodes[outline[(corner + squares.turns) % 4]]);
      }
    }
  }
  return quads;
}

std::vector<cv::Point2f> boardOutline(const Lattice& lattice)
{
  const cv::Rect box(lattice.box.x - 1, lattice.box.y - 1, lattice.box.width + 1, lattice.box.height + 1);
  std::vector<cv::Point2f> outline;
  outline.reserve(2 * (box.width + box.height));
  for (int j = 0; j < box.width; ++j)
  {
    outline.push_back(positionOf(lattice, box.y, box.x + j));
  }
  for (int i = 0; i < box.height; ++i)
  {
    outline.push_back(positionOf(lattice, box.y + i, box.br().x));
  }
  for (int j = box.width; j > 0; --j)
  {
    outline.push_back(positionOf(lattice, box.br().y, box.x + j));
  }
  for (int i = box.height; i > 0; --i)
  {
    outline.push_back(positionOf(lattice, box.y + i, box.x));
  }
  return outline;
}

Checkerboard orderCheckerboard(const Lattice& lattice, const std::vector<bool>& seen)
{
  const cv::Rect& box = lattice.box;
  const int turns = chooseTurns(lattice);
  const TurnedGrid corners{box.height, box.width, turns};
  Checkerboard board;
  board.rows = corners.turnedRows() + 1;
  board.cols = corners.turnedCols() + 1;
  for (int i = 0; i < corners.turnedRows(); ++i)
  {
    for (int j = 0; j < corners.turnedCols(); ++j)
    {
      const int index = corners.index(i, j);
      board.inner_corners.push_back(lattice.at(box.y + index / box.width, box.x + index % box.width).position);
      board.inner_corners_seen.push_back(seen[index]);
    }
  }
  const std::vector<cv::Point2f> quads = squareCorners(lattice);
  for (std::size_t i = 0; i < quads.size(); i += 4)
  {
    board.squares.push_back(centerOf(&quads[i]));
  }
  const auto outer = [&](int row, int col, int corner) { return quads[4 * (row * board.cols + col) + corner]; };
  board.corners = {outer(0, 0, 0), outer(0, board.cols - 1, 1), outer(board.rows - 1, board.cols - 1, 2),
                   outer(board.rows - 1, 0, 3)};
  return board;
}

}  // namespace omr
