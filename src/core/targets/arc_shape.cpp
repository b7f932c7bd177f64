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

/** Adds to the upper triangle. */
void addProduct(const ShapeVector& row, ShapeMatrix& sum)
{
  for (int a = 0; a < 5; ++a)
  {
    for (int b = a; b < 5; ++b)
    {
      sum(a, b) += row[a] * row[b];
    }
  }
}

void mirror(ShapeMatrix& sum)
{
  for (int a = 0; a < 5; ++a)
  {
    for (int b = 0; b < a; ++b)
    {
      sum(a, b) = sum(b, a);
    }
  }
}

/** Cholesky's decomposition, the factor in the lower triangle, its diagonal inverted. */
bool decompose(ShapeMatrix& matrix)
{
  for (int i = 0; i < 5; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      double sum = matrix(i, j);
      for (int k = 0; k < j; ++k)
      {
        sum -= matrix(i, k) * matrix(j, k);
      }
      if (i == j && !(sum > 0))
      {
        return false;
      }
      matrix(i, j) = i == j ? 1 / std::sqrt(sum) : sum * matrix(j, j);
    }
  }
  return true;
}

ShapeVector solve(const ShapeMatrix& factor, ShapeVector vector)
{
  for (int i = 0; i < 5; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      vector[i] -= factor(i, k) * vector[k];
    }
    vector[i] *= factor(i, i);
  }
  for (int i = 4; i >= 0; --i)
  {
    for (int k = i + 1; k < 5; ++k)
    {
      vector[i] -= factor(k, i) * vector[k];
    }
    vector[i] *= factor(i, i);
  }
  return vector;
}

/**
 * Eigenvector of the least eigenvalue. Where arcs fit a family that value is far below the others, so that a few steps
 * of inverse iteration settle, in a thirtieth of the time of cv::eigen(), which does what does not settle.
 */
ShapeVector leastEigenvector(const ShapeMatrix& matrix)
{
  constexpr int MAX_STEPS = 20;
  constexpr double SETTLED = 1e-20;  // squared change of the unit vector
  ShapeMatrix factor = matrix;
  if (decompose(factor))
  {
    ShapeVector vector = ShapeVector::all(1 / std::sqrt(5.));
    for (int step = 0; step < MAX_STEPS; ++step)
    {
      ShapeVector next = solve(factor, vector);
      next *= 1 / cv::norm(next);
      const ShapeVector change = next - vector;
      vector = next;
      if (change.dot(change) < SETTLED)
      {
        return vector;
      }
    }
  }
  cv::Vec<double, 5> values;
  ShapeMatrix vectors;
  cv::eigen(matrix, values, vectors);
  return ShapeVector(vectors.row(4).val);
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
  // Of the products of (x, y, 0, -1, 0) and (0, x, y, 0, -1) few differ from 0 and from each other.
  gradient(0, 0) += x * x;
  gradient(0, 1) += x * y;
  gradient(0, 3) -= x;
  gradient(1, 3) -= y;
  gradient(2, 2) += y * y;
  mean_level += level_row;
  ++count;
}

void ArcSums::close()
{
  gradient(1, 1) = gradient(0, 0) + gradient(2, 2);
  gradient(1, 2) = gradient(0, 1);
  gradient(1, 4) = gradient(0, 3);
  gradient(2, 4) = gradient(1, 3);
  gradient(3, 3) = gradient(4, 4) = count;
  mirror(direction);
  mirror(level);
  mirror(gradient);
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
  ShapeVector best = leastEigenvector(local.t() * weighted * local);
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
