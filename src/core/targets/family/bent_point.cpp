#include "bent_point.h"

#include <algorithm>
#include <cmath>

namespace omr
{
BentPoint::BentPoint(const RingFamily& family, const cv::Point2d& q)
{
  const double curvature = std::hypot(family.bend.x, family.bend.y);
  const cv::Point2d across = family.bend / curvature;
  const double u = q.dot(across);
  const double angle = std::clamp(curvature * u, -LARGEST_ANGLE, LARGEST_ANGLE);
  const double rest = u - angle / curvature;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  s = q + (sine / curvature + cosine * rest - u) * across;
  z = (1 - cosine) / curvature + sine * rest;
  w = 1 + family.hx * s.x + family.hy * s.y + family.hz * z;
  offset = (cv::Point2d(family.a * s.x + family.b * s.y, family.b * s.x + family.d * s.y) + z * family.normal) / w;
  // By s and by z, then by q.
  const cv::Matx22d by_s((family.a - offset.x * family.hx) / w, (family.b - offset.x * family.hy) / w,
                         (family.b - offset.y * family.hx) / w, (family.d - offset.y * family.hy) / w);
  const cv::Vec2d by_z((family.normal.x - offset.x * family.hz) / w, (family.normal.y - offset.y * family.hz) / w);
  const double shorter = cosine - 1;
  const cv::Matx22d bend(1 + shorter * across.x * across.x, shorter * across.x * across.y,
                         shorter * across.x * across.y, 1 + shorter * across.y * across.y);
  jacobian = by_s * bend + sine * by_z * cv::Matx12d(across.x, across.y);
}

}  // namespace omr
