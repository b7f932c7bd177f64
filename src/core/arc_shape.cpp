#include "arc_shape.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double DISTANCE_DEVIATION = .3;  // of an edgel from its circle [px]
constexpr double SINE_DEVIATION = .08;     // of its normal from the radius
constexpr double MAX_ASPECT = 3.5;

void addProduct(const ShapeVector& row, ShapeMatrix& sum)
{
  for (int a = 0; a < 5; ++a)
  {
    for (int b = 0; b < 5; ++b)
    {
      sum(a, b) += row[a] * row[b];
    }
  }
}

/** Coefficients of s seen from an origin, in units of a scale: full = T local. */
ShapeMatrix toLocal(const cv::Point2d& o, double s)
{
  const double q = 1 / (s * s);
  return {q, 0, 0, 0, 0, 0, q, 0, 0, 0, 0, 0, q, 0, 0, o.x * q, o.y * q, 0, 1 / s, 0, 0, o.x * q, o.y * q, 0, 1 / s};
}
}  // namespace

void ArcSums::add(const Edgel& edgel)
{
  const double x = edgel.x;
  const double y = edgel.y;
  const double nx = edgel.nx;
  const double ny = edgel.ny;
  const ShapeVector level_row(x * x, 2 * x * y, y * y, -2 * x, -2 * y);
  addProduct({-ny * x, nx * x - ny * y, nx * y, ny, -nx}, direction);
  addProduct(level_row, level);
  addProduct({x, y, 0, -1, 0}, gradient);
  addProduct({0, x, y, 0, -1}, gradient);
  mean_level += level_row;
  ++count;
}

void ArcSums::close()
{
  mean_level *= 1 / std::max(1., count);
  level -= count * (mean_level * mean_level.t());
}

double ArcSums::squaredSine(const ShapeVector& shape) const
{
  return shape.dot(direction * shape) / std::max(1e-12, shape.dot(gradient * shape));
}

double ArcSums::squaredDistance(const ShapeVector& shape) const
{
  return shape.dot(level * shape) / std::max(1e-12, 4 * shape.dot(gradient * shape));
}

ArcSums sumOf(const ArcSums& left, const ArcSums& right)
{
  ArcSums sum;
  sum.count = left.count + right.count;
  sum.direction = left.direction + right.direction;
  sum.level = left.level + right.level;
  sum.gradient = left.gradient + right.gradient;
  sum.mean_level = (left.mean_level * left.count + right.mean_level * right.count) * (1 / std::max(1., sum.count));
  return sum;
}

ArcSums joined(const ArcSums& left, const ArcSums& right)
{
  ArcSums sum = sumOf(left, right);
  const ShapeVector difference = left.mean_level - right.mean_level;
  const double weight = left.count * right.count / std::max(1., sum.count);
  sum.level += weight * (difference * difference.t());
  return sum;
}

bool fitShape(const ArcSums& sums, const cv::Point2d& origin, double scale, ShapeVector& shape, RingFamily& family)
{
  const ShapeMatrix local = toLocal(origin, scale);
  const ShapeMatrix weighted = sums.level * (1 / (4 * DISTANCE_DEVIATION * DISTANCE_DEVIATION)) +
                               sums.direction * (1 / (SINE_DEVIATION * SINE_DEVIATION));
  const ShapeMatrix matrix = local.t() * weighted * local;
  cv::Mat values;
  cv::Mat vectors;
  cv::eigen(matrix, values, vectors);
  ShapeVector best;
  for (int i = 0; i < 5; ++i)
  {
    best[i] = vectors.at<double>(4, i);
  }
  if (best[0] < 0)
  {
    best *= -1;
  }
  const double det = best[0] * best[2] - best[1] * best[1];
  if (!(det > 1e-9))
  {
    return false;
  }
  shape = local * best;
  const cv::Point2d center((best[2] * best[3] - best[1] * best[4]) / det,
                           (best[0] * best[4] - best[1] * best[3]) / det);
  return familyFromMoments(origin + scale * center, best[2] / det, -best[1] / det, best[0] / det, family) &&
         family.aspect() < MAX_ASPECT;
}

double radiusOf(const ArcSums& sums, const ShapeVector& shape, const RingFamily& family)
{
  const double root = std::sqrt(shape[0] * shape[2] - shape[1] * shape[1]);
  const cv::Point2d& c = family.center;
  const double at_center = c.x * c.x * shape[0] + 2 * c.x * c.y * shape[1] + c.y * c.y * shape[2];
  return std::sqrt(std::max(0., (sums.mean_level.dot(shape) + at_center) / root));
}

}  // namespace omr
