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

/** What the lens model says, corrected by what it misses the corners around by. Boards in pictures of fisheyes, drawn
 * or derived from photographs, against local cubics: 215 -> 218 of 223, and 1266 -> 1296 of 1338, wrong 9 -> 6. */
void predictRadially(const Lattice& lattice, int row, int col, int window, LocalFrame& predicted)
{
  constexpr double RIDGE = 0.3;
  constexpr int TERMS = 3;
  LocalFrame model;
  if (!lattice.radial->frameAt(row, col, model))
  {
    return;
  }
  const cv::Rect rows_cols = lattice.box & cv::Rect(col - window, row - window, 2 * window + 1, 2 * window + 1);
  PointFit<TERMS> fit;
  for (int i = rows_cols.y; i < rows_cols.br().y; ++i)
  {
    for (int j = rows_cols.x; j < rows_cols.br().x; ++j)
    {
      LocalFrame here;
      if (lattice.found(i, j) && (i != row || j != col) && lattice.radial->frameAt(i, j, here))
      {
        const double x = j - col;
        const double y = i - row;
        fit.add({1, x, y}, lattice.at(i, j).position - here.node, 1 / (0.3 + x * x + y * y));
      }
    }
  }
  for (int term = 0; term < TERMS; ++term)
  {
    fit.addRidge(term, RIDGE);
  }
  cv::Point2d missed[TERMS];
  if (fit.solve(TERMS, missed))
  {
    predicted = {model.node + cv::Point2f(missed[0]), model.u + cv::Point2f(missed[1]),
                 model.v + cv::Point2f(missed[2])};
  }
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
    if (lattice.radial)
    {
      predictRadially(lattice, row, col, window, predicted);
    }
  }
  const float area = cross(predicted.u, predicted.v);
  return area * cross(lattice.seedFrame().u, lattice.seedFrame().v) > 0 && std::abs(area) > MIN_AREA;
}

}  // namespace omr
