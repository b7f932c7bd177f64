#include "ring_family.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "bent_point.h"
#include "bent_sheet.h"

namespace omr
{
namespace
{
constexpr int OUTLINE = 48;  // points of a bent circle

/** The i-th of OUTLINE points. */
cv::Point2d onCircle(int i, double radius)
{
  const double phi = 2 * CV_PI * i / OUTLINE;
  return {radius * std::cos(phi), radius * std::sin(phi)};
}
}  // namespace

cv::Point2d RingFamily::toImage(const cv::Point2d& q) const
{
  if (isBent())
  {
    return center + BentPoint(*this, q).offset;
  }
  const double k = 1 / (1 + hx * q.x + hy * q.y);
  return {center.x + (a * q.x + b * q.y) * k, center.y + (b * q.x + d * q.y) * k};
}

cv::Point2d RingFamily::toPlane(const cv::Point2d& p) const
{
  const cv::Point2d dp = p - center;
  const double m00 = a - dp.x * hx;
  const double m01 = b - dp.x * hy;
  const double m10 = b - dp.y * hx;
  const double m11 = d - dp.y * hy;
  const double det = m00 * m11 - m01 * m10;
  const cv::Point2d q((m11 * dp.x - m01 * dp.y) / det, (m00 * dp.y - m10 * dp.x) / det);
  if (!isBent())
  {
    return q;
  }
  const BentSheet::Points image{{p.x}, {p.y}};
  BentSheet::Points places{{q.x}, {q.y}};
  BentSheet(*this).toPlane(image, 1, places);
  return {places.x[0], places.y[0]};
}

cv::Point2d RingFamily::radiusGradient(const cv::Point2d& q) const
{
  const double radius = std::max(1e-6, cv::norm(q));
  if (isBent())
  {
    return BentPoint(*this, q).jacobian.inv().t() * (q / radius);
  }
  const cv::Point2d dp = toImage(q) - center;
  const double m00 = a - dp.x * hx;
  const double m01 = b - dp.x * hy;
  const double m10 = b - dp.y * hx;
  const double m11 = d - dp.y * hy;
  const double scale = (1 + hx * q.x + hy * q.y) / (radius * (m00 * m11 - m01 * m10));
  return {scale * (m11 * q.x - m10 * q.y), scale * (m00 * q.y - m01 * q.x)};
}

double RingFamily::aspect() const
{
  const double mean = (a + d) / 2;
  const double difference = std::hypot((a - d) / 2, b);
  return (mean + difference) / std::max(1e-9, mean - difference);
}

cv::Point2d RingFamily::halfBox(double radius) const
{
  cv::Point2d half(radius * std::hypot(a, b), radius * std::hypot(b, d));
  for (int i = 0; isBent() && i < OUTLINE; ++i)
  {
    const cv::Point2d p = toImage(onCircle(i, radius)) - center;
    half = {std::max(half.x, std::abs(p.x)), std::max(half.y, std::abs(p.y))};
  }
  return half;
}

cv::RotatedRect RingFamily::ellipse(double radius) const
{
  if (isBent())
  {
    std::vector<cv::Point2f> outline(OUTLINE);
    for (int i = 0; i < OUTLINE; ++i)
    {
      outline[i] = cv::Point2f(toImage(onCircle(i, radius)));
    }
    const cv::RotatedRect fitted = cv::fitEllipse(outline);  // its height is the longer axis
    return {fitted.center, {fitted.size.height, fitted.size.width}, fitted.angle + 90};
  }
  // The circle's conic, carried over by the homography [A + c h^T, c; h^T, 1].
  const cv::Matx33d homography(a + center.x * hx, b + center.x * hy, center.x, b + center.y * hx, d + center.y * hy,
                               center.y, hx, hy, 1);
  const cv::Matx33d inverse = homography.inv();
  const cv::Matx33d conic = inverse.t() * cv::Matx33d::diag(cv::Vec3d(1, 1, -radius * radius)) * inverse;
  const double det = conic(0, 0) * conic(1, 1) - conic(0, 1) * conic(0, 1);
  const cv::Point2d middle((conic(0, 1) * conic(1, 2) - conic(1, 1) * conic(0, 2)) / det,
                           (conic(0, 1) * conic(0, 2) - conic(0, 0) * conic(1, 2)) / det);
  const double level = -(conic(0, 2) * middle.x + conic(1, 2) * middle.y + conic(2, 2));
  const double mean = (conic(0, 0) + conic(1, 1)) / 2;
  const double difference = std::hypot((conic(0, 0) - conic(1, 1)) / 2, conic(0, 1));
  const double angle = .5 * std::atan2(-2 * conic(0, 1), conic(1, 1) - conic(0, 0));
  return {cv::Point2f(middle),
          cv::Size2f(static_cast<float>(2 * std::sqrt(level / (mean - difference))),
                     static_cast<float>(2 * std::sqrt(level / (mean + difference)))),
          static_cast<float>(angle * 180 / CV_PI)};
}

bool familyFromMoments(const cv::Point2d& center, double cxx, double cxy, double cyy, RingFamily& family)
{
  const double det = cxx * cyy - cxy * cxy;
  if (!(det > 1e-9) || !(cxx > 0))
  {
    return false;
  }
  // The symmetric root of the covariance, scaled to determinant 1.
  const double root = std::sqrt(det);
  const double scale = 1 / std::sqrt((cxx + cyy + 2 * root) * root);
  family.center = center;
  family.a = (cxx + root) * scale;
  family.b = cxy * scale;
  family.d = (cyy + root) * scale;
  family.hx = family.hy = 0;
  return true;
}

}  // namespace omr
