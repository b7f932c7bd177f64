#include "edgel_family.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double MAX_ASPECT = 3.2;

using Row = cv::Vec<double, 5>;

/**
 * A family's circles are the level sets of (p - c)^T S (p - c), so the gradient n at p is parallel to S p - d with
 * d = S c: one linear equation in (s11, s12, s22, d1, d2).
 */
Row equation(const Edgel& edgel, const cv::Point2d& origin, double scale)
{
  const double x = (edgel.x - origin.x) / scale;
  const double y = (edgel.y - origin.y) / scale;
  return {-edgel.ny * x, edgel.nx * x - edgel.ny * y, edgel.nx * y, edgel.ny, -edgel.nx};
}

bool toFamily(Row solution, const cv::Point2d& origin, double scale, RingFamily& family)
{
  if (solution[0] < 0)
  {
    solution *= -1;
  }
  const double s11 = solution[0];
  const double s12 = solution[1];
  const double s22 = solution[2];
  const double det = s11 * s22 - s12 * s12;
  if (!(det > 1e-12))
  {
    return false;
  }
  const cv::Point2d center((s22 * solution[3] - s12 * solution[4]) / det,
                           (s11 * solution[4] - s12 * solution[3]) / det);
  return familyFromMoments(origin + scale * center, s22 / det, -s12 / det, s11 / det, family) &&
         family.aspect() < MAX_ASPECT;
}

/** The vector that four equations leave free. */
bool nullVector(std::array<Row, 4>& rows, Row& solution)
{
  std::array<int, 4> pivots{};
  std::array<bool, 5> used{};
  for (int i = 0; i < 4; ++i)
  {
    int best_row = -1;
    int best_col = -1;
    double largest = 1e-9;
    for (int row = i; row < 4; ++row)
    {
      for (int col = 0; col < 5; ++col)
      {
        if (!used[col] && std::abs(rows[row][col]) > largest)
        {
          largest = std::abs(rows[row][col]);
          best_row = row;
          best_col = col;
        }
      }
    }
    if (best_row < 0)
    {
      return false;
    }
    std::swap(rows[i], rows[best_row]);
    used[best_col] = true;
    pivots[i] = best_col;
    rows[i] *= 1 / rows[i][best_col];
    for (int row = 0; row < 4; ++row)
    {
      if (row != i)
      {
        rows[row] -= rows[row][best_col] * rows[i];
      }
    }
  }
  const int free = static_cast<int>(std::find(used.begin(), used.end(), false) - used.begin());
  solution[free] = 1;
  for (int i = 0; i < 4; ++i)
  {
    solution[pivots[i]] = -rows[i][free];
  }
  return true;
}
/** Sine of the angle between an edgel's gradient and the family's radius. */
double sineToRadius(const RingFamily& family, const Edgel& edgel)
{
  const double x = edgel.x - family.center.x;
  const double y = edgel.y - family.center.y;
  const double qx = family.d * x - family.b * y;
  const double qy = family.a * y - family.b * x;
  const double gx = family.d * qx - family.b * qy;
  const double gy = family.a * qy - family.b * qx;
  return std::abs(edgel.nx * gy - edgel.ny * gx) / std::max(1e-9, std::sqrt(gx * gx + gy * gy));
}
}  // namespace

bool familyOf(const std::array<Edgel, 4>& edgels, const cv::Point2d& origin, double scale, RingFamily& family)
{
  std::array<Row, 4> rows;
  std::transform(edgels.begin(), edgels.end(), rows.begin(),
                 [&](const Edgel& edgel) { return equation(edgel, origin, scale); });
  Row solution;
  return nullVector(rows, solution) && toFamily(solution, origin, scale, family);
}

bool refineFamilyShape(const std::vector<Edgel>& edgels, const cv::Point2d& origin, double scale, RingFamily& family)
{
  cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
  for (const Edgel& edgel : edgels)
  {
    const double t = sineToRadius(family, edgel) / MAX_SINE;
    if (t < 1)
    {
      const Row row = equation(edgel, origin, scale);
      normal += (1 - t * t) * (1 - t * t) * (row * row.t());
    }
  }
  cv::Mat values;
  cv::Mat vectors;
  cv::eigen(normal, values, vectors);
  Row solution;
  for (int i = 0; i < 5; ++i)
  {
    solution[i] = vectors.at<double>(4, i);
  }
  return toFamily(solution, origin, scale, family);
}

}  // namespace omr
