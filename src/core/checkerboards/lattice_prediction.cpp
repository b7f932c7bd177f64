#include "lattice_prediction.h"

#include <algorithm>
#include <cmath>

#include "least_squares.h"

namespace omr
{
namespace
{
constexpr float MIN_AREA = 4;  // px^2 of a square

/** The corners around a node, gathered for a prediction. */
struct Support
{
  int count = 0;
  int first_row = Lattice::SIZE, last_row = -1, first_col = Lattice::SIZE, last_col = -1;
  int nearest_row = 0, nearest_col = 0;
  double nearest = 1e9;
};

/** With fewer than three corners, or all on one line: the step along the line, the seed's step across. */
LocalFrame predictFromLine(const Lattice& lattice, const Support& support, int row, int col)
{
  LocalFrame frame = lattice.seedFrame();
  if (support.count > 1 && support.last_col > support.first_col && support.first_row == support.last_row)
  {
    frame.u = (lattice.at(support.first_row, support.last_col).position -
               lattice.at(support.first_row, support.first_col).position) *
              (1.F / static_cast<float>(support.last_col - support.first_col));
  }
  if (support.count > 1 && support.last_row > support.first_row && support.first_col == support.last_col)
  {
    frame.v = (lattice.at(support.last_row, support.first_col).position -
               lattice.at(support.first_row, support.first_col).position) *
              (1.F / static_cast<float>(support.last_row - support.first_row));
  }
  frame.node = lattice.at(support.nearest_row, support.nearest_col).position;
  frame.node = frame.at(static_cast<float>(col - support.nearest_col), static_cast<float>(row - support.nearest_row));
  return frame;
}

/** With cubic terms as well: towards the edge of a fisheye's picture squares shrink faster than a quadratic can follow.
 * Leaves the prediction as it is where there are too few corners. */
void predictStronglyBent(const Lattice& lattice, int row, int col, int window, LocalFrame& predicted)
{
  constexpr int CUBIC = 10;
  constexpr double RIDGE = 0.04;  // half way to the quadratic: both miss by as much, to either side
  constexpr int MIN_CORNERS = 14;
  constexpr int MIN_LINES = 4;
  const cv::Rect rows_cols = lattice.box & cv::Rect(col - window, row - window, 2 * window + 1, 2 * window + 1);
  PointFit<CUBIC> fit;
  int count = 0;
  cv::Rect spread;
  for (int i = rows_cols.y; i < rows_cols.br().y; ++i)
  {
    for (int j = rows_cols.x; j < rows_cols.br().x; ++j)
    {
      if (lattice.found(i, j) && (i != row || j != col))
      {
        const double x = j - col;
        const double y = i - row;
        fit.add({1, x, y, x * y, x * x, y * y, x * x * x, x * x * y, x * y * y, y * y * y}, lattice.at(i, j).position,
                1 / (0.3 + x * x + y * y));
        spread = count == 0 ? cv::Rect(j, i, 1, 1) : spread | cv::Rect(j, i, 1, 1);
        ++count;
      }
    }
  }
  for (int term = 3; term < CUBIC; ++term)
  {
    fit.addRidge(term, RIDGE);
  }
  cv::Point2d coefficients[CUBIC];
  if (count < MIN_CORNERS || std::min(spread.width, spread.height) < MIN_LINES || !fit.solve(CUBIC, coefficients))
  {
    return;
  }
  predicted = {coefficients[0], coefficients[1], coefficients[2]};
}

}  // namespace

bool predictNode(const Lattice& lattice, int row, int col, int window, LocalFrame& predicted)
{
  constexpr int AFFINE = 3;
  constexpr int BILINEAR = 4;
  constexpr int QUADRATIC = 6;
  const cv::Rect rows_cols = lattice.box & cv::Rect(col - window, row - window, 2 * window + 1, 2 * window + 1);
  PointFit<QUADRATIC> fit;
  Support support;
  for (int i = rows_cols.y; i < rows_cols.br().y; ++i)
  {
    for (int j = rows_cols.x; j < rows_cols.br().x; ++j)
    {
      if (!lattice.found(i, j) || (i == row && j == col))
      {
        continue;
      }
      const double x = j - col;
      const double y = i - row;
      const double distance = x * x + y * y;
      fit.add({1, x, y, x * y, x * x, y * y}, lattice.at(i, j).position, 1 / (0.3 + distance));
      ++support.count;
      support.first_row = std::min(support.first_row, i);
      support.last_row = std::max(support.last_row, i);
      support.first_col = std::min(support.first_col, j);
      support.last_col = std::max(support.last_col, j);
      if (distance < support.nearest)
      {
        support.nearest = distance;
        support.nearest_row = i;
        support.nearest_col = j;
      }
    }
  }
  if (support.count == 0)
  {
    return false;
  }
  const int spread = std::min(support.last_row - support.first_row, support.last_col - support.first_col);
  if (support.count < AFFINE || spread < 1)
  {
    predicted = predictFromLine(lattice, support, row, col);
  }
  else
  {
    const int features = support.count >= 9 && spread >= 2 ? QUADRATIC : support.count >= 5 ? BILINEAR : AFFINE;
    // A little pull of the curvature towards none: extrapolation over two squares is what it is for.
    fit.addRidge(3, 0.02);
    fit.addRidge(4, 0.08);
    fit.addRidge(5, 0.08);
    cv::Point2d coefficients[QUADRATIC];
    if (!fit.solve(features, coefficients))
    {
      return false;
    }
    predicted = {coefficients[0], coefficients[1], coefficients[2]};
    if (lattice.bends_strongly)
    {
      predictStronglyBent(lattice, row, col, window + 1, predicted);
    }
  }
  const float area = cross(predicted.u, predicted.v);
  return area * cross(lattice.seedFrame().u, lattice.seedFrame().v) > 0 && std::abs(area) > MIN_AREA;
}

}  // namespace omr
