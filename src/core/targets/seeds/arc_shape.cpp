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

/** Places of the gradients' products that are not 0 in a triangle. */
enum GradientPlace
{
  XX = 0,
  XY = 1,
  X = 3,
  XX_AND_YY = 5,
  XY_AGAIN = 6,
  Y = 7,
  X_AGAIN = 8,
  YY = 9,
  Y_AGAIN = 11,
  COUNT = 12,
  COUNT_AGAIN = 14
};

/** Adds a row's products with itself. */
void addProduct(const ShapeVector& row, double weight, ShapeTriangle& sum)
{
  int i = 0;
  for (int a = 0; a < 5; ++a)
  {
    for (int b = a; b < 5; ++b)
    {
      sum[i++] += row[a] * row[b] * weight;
    }
  }
}

ShapeMatrix full(const ShapeTriangle& triangle)
{
  ShapeMatrix matrix;
  int i = 0;
  for (int a = 0; a < 5; ++a)
  {
    for (int b = a; b < 5; ++b)
    {
      matrix(a, b) = matrix(b, a) = triangle[i++];
    }
  }
  return matrix;
}

double squareOf(const ShapeTriangle& triangle, const ShapeVector& shape)
{
  return shape.dot(full(triangle) * shape);
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
  addProduct({-ny * x, nx * x - ny * y, nx * y, ny, -nx}, 1, direction);
  addProduct(level_row, 1, level);
  // Of the products of (x, y, 0, -1, 0) and (0, x, y, 0, -1) few differ from 0 and from each other.
  gradient[XX] += x * x;
  gradient[XY] += x * y;
  gradient[X] -= x;
  gradient[Y] -= y;
  gradient[YY] += y * y;
  mean_level += level_row;
  ++count;
}

void ArcSums::close()
{
  gradient[XX_AND_YY] = gradient[XX] + gradient[YY];
  gradient[XY_AGAIN] = gradient[XY];
  gradient[X_AGAIN] = gradient[X];
  gradient[Y_AGAIN] = gradient[Y];
  gradient[COUNT] = gradient[COUNT_AGAIN] = count;
  mean_level *= 1 / std::max(1., count);
  addProduct(mean_level, -count, level);
}

double ArcSums::squaredSine(const ShapeVector& shape) const
{
  return squareOf(direction, shape) / std::max(1e-12, squareOf(gradient, shape));
}

double ArcSums::squaredDistance(const ShapeVector& shape) const
{
  return squareOf(level, shape) / std::max(1e-12, 4 * squareOf(gradient, shape));
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
  addProduct(difference, weight, sum.level);
  return sum;
}

bool fitShape(const ArcSums& sums, const cv::Point2d& origin, double scale, ShapeVector& shape, RingFamily& family)
{
  const ShapeMatrix local = toLocal(origin, scale);
  const ShapeTriangle weighted = sums.level * (1 / (4 * DISTANCE_DEVIATION * DISTANCE_DEVIATION)) +
                                 sums.direction * (1 / (SINE_DEVIATION * SINE_DEVIATION));
  ShapeVector best = leastEigenvector(local.t() * full(weighted) * local);
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
