#include "ring_residual.h"

#include <algorithm>
#include <cmath>

namespace omr
{
double circleDistance(const RingFamily& family, const std::vector<double>& radii, const BoundaryPoint& point,
                      FamilyVector* derivative, double* by_radius)
{
  const cv::Point2d dp = point.position - family.center;
  const double m00 = family.a - dp.x * family.hx;
  const double m01 = family.b - dp.x * family.hy;
  const double m10 = family.b - dp.y * family.hx;
  const double m11 = family.d - dp.y * family.hy;
  const double det = m00 * m11 - m01 * m10;
  const double qx = (m11 * dp.x - m01 * dp.y) / det;
  const double qy = (m00 * dp.y - m10 * dp.x) / det;
  const double r = std::max(1e-6, std::sqrt(qx * qx + qy * qy));
  // g = M^-T q / r; the gradient of r over p is (1 + h.q) g.
  const double gx = (m11 * qx - m10 * qy) / (det * r);
  const double gy = (m00 * qy - m01 * qx) / (det * r);
  const double w = 1 + family.hx * qx + family.hy * qy;
  const double scale = 1 / std::max(.1, std::abs(w) * std::sqrt(gx * gx + gy * gy));
  if (derivative != nullptr)
  {
    const double along = gx * dp.x + gy * dp.y;
    *derivative =
        scale * FamilyVector(-w * gx, -w * gy, -gx * qx, -(gx * qy + gy * qx), -gy * qy, along * qx, along * qy);
    *by_radius = -scale;
  }
  return scale * (r - radii[point.ring]);
}

}  // namespace omr
