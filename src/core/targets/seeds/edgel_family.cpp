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
  if (!(det > 1e-12 * solution.dot(solution)))
  {
    return false;
  }
  const cv::Point2d center((s22 * solution[3] - s12 * solution[4]) / det,
                           (s11 * solution[4] - s12 * solution[3]) / det);
  return familyFromMoments(origin + scale * center, s22 / det, -s12 / det, s11 / det, family) &&
         family.aspect() < MAX_ASPECT;
}

/** Determinants of two columns of two rows. */
std::array<std::array<double, 5>, 5> minorsOf(const Row& top, const Row& bottom)
{
  std::array<std::array<double, 5>, 5> minors{};
  for (int i = 0; i < 5; ++i)
  {
    for (int j = i + 1; j < 5; ++j)
    {
      minors[i][j] = top[i] * bottom[j] - top[j] * bottom[i];
    }
  }
  return minors;
}

/** The vector that four equations leave free: the determinants of four of the five columns, with signs in turn. */
Row nullVector(const std::array<Row, 4>& rows)
{
  const auto upper = minorsOf(rows[0], rows[1]);
  const auto lower = minorsOf(rows[2], rows[3]);
  const auto determinant = [&](int i, int j, int k, int l) {
    return upper[i][j] * lower[k][l] - upper[i][k] * lower[j][l] + upper[i][l] * lower[j][k] +
           upper[j][k] * lower[i][l] - upper[j][l] * lower[i][k] + upper[k][l] * lower[i][j];
  };
  return {determinant(1, 2, 3, 4), -determinant(0, 2, 3, 4), determinant(0, 1, 3, 4), -determinant(0, 1, 2, 4),
          determinant(0, 1, 2, 3)};
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
  return toFamily(nullVector(rows), origin, scale, family);
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
