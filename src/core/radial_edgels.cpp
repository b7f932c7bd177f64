#include "radial_edgels.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
constexpr double MIN_RADIUS = .8;  // of an edgel [px]

AngleBins binsAt(const cv::Point2d& q, double radius)
{
  const double angle = cv::fastAtan2(static_cast<float>(q.y), static_cast<float>(q.x)) * (ANGLE_BINS / 360.);
  const double half = .6 / std::max(.6, radius) * (ANGLE_BINS / (2 * CV_PI));
  AngleBins bins = 0;
  for (int bin = static_cast<int>(std::floor(angle - half)); bin <= std::floor(angle + half); ++bin)
  {
    bins |= AngleBins{1} << ((bin + 2 * ANGLE_BINS) % ANGLE_BINS);
  }
  return bins;
}

int count(AngleBins bins)
{
  return __builtin_popcountll(bins);
}
}  // namespace

double share(AngleBins bins)
{
  return count(bins) / static_cast<double>(ANGLE_BINS);
}

void collectRadialEdgels(EdgelMap& map, const RingFamily& family, double max_radius, double min_cosine,
                         std::vector<RadialEdgel>& edgels)
{
  edgels.clear();
  const cv::Point2d half = family.halfBox(max_radius) * 1.1 + cv::Point2d(1, 1);
  const cv::Point2d& c = family.center;
  const double max_squared = max_radius * max_radius;
  const double min_squared = MIN_RADIUS * MIN_RADIUS;
  const double squared_cosine = min_cosine * min_cosine;
  map.visit(c.x - half.x, c.y - half.y, c.x + half.x, c.y + half.y, [&](const Edgel& edgel) {
    // RingFamily::toPlane() and the gradient of the radius, up to a positive factor, without divisions.
    const double dx = edgel.x - c.x;
    const double dy = edgel.y - c.y;
    const double m00 = family.a - dx * family.hx;
    const double m01 = family.b - dx * family.hy;
    const double m10 = family.b - dy * family.hx;
    const double m11 = family.d - dy * family.hy;
    const double det = m00 * m11 - m01 * m10;
    const double qx = m11 * dx - m01 * dy;
    const double qy = m00 * dy - m10 * dx;
    const double squared = qx * qx + qy * qy;
    const double det_squared = det * det;
    if (squared > max_squared * det_squared || squared < min_squared * det_squared)
    {
      return;
    }
    const double gx = m11 * qx - m10 * qy;
    const double gy = m00 * qy - m01 * qx;
    const double projection = gx * edgel.nx + gy * edgel.ny;
    if (projection * projection >= squared_cosine * (gx * gx + gy * gy))
    {
      const double radius = std::sqrt(squared) / det;
      edgels.push_back({cv::Point2f(edgel.x, edgel.y), static_cast<float>(radius), projection > 0,
                        binsAt(cv::Point2d(qx, qy), radius)});
    }
  });
}

AngularSupport::AngularSupport(const std::vector<RadialEdgel>& edgels, double max_radius)
    : brighter_(static_cast<std::size_t>(max_radius / CELL) + 1), darker_(brighter_.size())
{
  for (const RadialEdgel& edgel : edgels)
  {
    const auto cell = std::min(brighter_.size() - 1, static_cast<std::size_t>(edgel.radius / CELL));
    (edgel.brighter_outside ? brighter_ : darker_)[cell] |= edgel.bins;
  }
}

AngleBins AngularSupport::at(double radius, double tolerance) const
{
  const int cells = static_cast<int>(brighter_.size());
  AngleBins brighter = 0;
  AngleBins darker = 0;
  const int last = std::min(cells - 1, static_cast<int>((radius + tolerance) / CELL));
  for (int cell = std::max(0, static_cast<int>((radius - tolerance) / CELL)); cell <= last; ++cell)
  {
    brighter |= brighter_[cell];
    darker |= darker_[cell];
  }
  return count(brighter) > count(darker) ? brighter : darker;
}

}  // namespace omr
