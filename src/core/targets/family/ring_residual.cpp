#include "ring_residual.h"

#include <algorithm>
#include <cmath>

#include "vectorized.h"

namespace omr
{
namespace
{
/** A point on the family's plane, and how the radius there changes with its place in the image. */
struct PlanePoint
{
  double qx, qy;
  double radius;
  double gx, gy;  // M^-T q / radius; the gradient of the radius over the place is w g
  double w;       // 1 + h.q
  double scale;   // of distances on the plane to those in the image
};

inline PlanePoint planePoint(const RingFamily& family, double dx, double dy)
{
  const double m00 = family.a - dx * family.hx;
  const double m01 = family.b - dx * family.hy;
  const double m10 = family.b - dy * family.hx;
  const double m11 = family.d - dy * family.hy;
  const double det = m00 * m11 - m01 * m10;
  PlanePoint point;
  point.qx = (m11 * dx - m01 * dy) / det;
  point.qy = (m00 * dy - m10 * dx) / det;
  point.radius = std::max(1e-6, std::sqrt(point.qx * point.qx + point.qy * point.qy));
  point.gx = (m11 * point.qx - m10 * point.qy) / (det * point.radius);
  point.gy = (m00 * point.qy - m01 * point.qx) / (det * point.radius);
  point.w = 1 + family.hx * point.qx + family.hy * point.qy;
  point.scale = 1 / std::max(.1, std::abs(point.w) * std::sqrt(point.gx * point.gx + point.gy * point.gy));
  return point;
}

/** @param distances the circles' radii; receive the distances. */
OMR_VECTORIZED void measureAll(const RingFamily& source, const double* x, const double* y, const double* certainty,
                               std::size_t size, double* distances)
{
  const RingFamily family = source;
  for (std::size_t i = 0; i < size; ++i)
  {
    const PlanePoint point = planePoint(family, x[i] - family.center.x, y[i] - family.center.y);
    distances[i] = certainty[i] * point.scale * (point.radius - distances[i]);
  }
}

OMR_VECTORIZED void differentiateAll(const RingFamily& source, const double* x, const double* y,
                                     const double* certainty, std::size_t size, CircleDerivative* derivatives)
{
  const RingFamily family = source;
  for (std::size_t i = 0; i < size; ++i)
  {
    const double dx = x[i] - family.center.x;
    const double dy = y[i] - family.center.y;
    PlanePoint p = planePoint(family, dx, dy);
    p.scale *= certainty[i];
    const double along = p.gx * dx + p.gy * dy;
    derivatives[i][0] = p.scale * (-p.w * p.gx);
    derivatives[i][1] = p.scale * (-p.w * p.gy);
    derivatives[i][2] = p.scale * (-p.gx * p.qx);
    derivatives[i][3] = p.scale * -(p.gx * p.qy + p.gy * p.qx);
    derivatives[i][4] = p.scale * (-p.gy * p.qy);
    derivatives[i][5] = p.scale * (along * p.qx);
    derivatives[i][6] = p.scale * (along * p.qy);
    derivatives[i][7] = -p.scale;
  }
}
}  // namespace

CircleDistances::CircleDistances(const std::vector<BoundaryPoint>& points)
    : x_(points.size()), y_(points.size()), certainty_(points.size()), ring_(points.size())
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    x_[i] = points[i].position.x;
    y_[i] = points[i].position.y;
    certainty_[i] = points[i].certainty;
    ring_[i] = points[i].ring;
  }
}

void CircleDistances::measure(const RingFamily& family, const std::vector<double>& radii,
                              std::vector<double>& distances) const
{
  distances.resize(size());
  std::transform(ring_.begin(), ring_.end(), distances.begin(), [&](int ring) { return radii[ring]; });
  measureAll(family, x_.data(), y_.data(), certainty_.data(), size(), distances.data());
}

void CircleDistances::differentiate(const RingFamily& family, std::vector<CircleDerivative>& derivatives) const
{
  derivatives.resize(size());
  differentiateAll(family, x_.data(), y_.data(), certainty_.data(), size(), derivatives.data());
}

}  // namespace omr
