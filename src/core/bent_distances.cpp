#include "bent_distances.h"

#include <algorithm>

#include "bent_point.h"

namespace omr
{
namespace
{
constexpr double STEP = 1e-5;  // of the bend, relative to a radius of curvature as large as the outermost circle's
constexpr double SMALLEST_GRADIENT = 1e-6;

/** How the image of the sheet's point q moves with each unknown. */
std::array<cv::Point2d, BENT_UNKNOWNS> moves(const RingFamily& family, const cv::Point2d& q, double radius)
{
  const BentPoint point(family, q);
  const double inverse = 1 / point.w;
  const cv::Point2d s = inverse * point.s;
  const double z = inverse * point.z;
  const double step = STEP / radius;
  RingFamily right = family;
  right.bend.x += step;
  RingFamily down = family;
  down.bend.y += step;
  return {cv::Point2d(1, 0),
          cv::Point2d(0, 1),
          cv::Point2d(s.x, 0),
          cv::Point2d(s.y, s.x),
          cv::Point2d(0, s.y),
          -s.x * point.offset,
          -s.y * point.offset,
          (BentPoint(right, q).offset - point.offset) / step,
          (BentPoint(down, q).offset - point.offset) / step,
          cv::Point2d(z, 0),
          cv::Point2d(0, z),
          -z * point.offset};
}
}  // namespace

void measureBent(const std::vector<BoundaryPoint>& points, const RingFamily& family, const std::vector<double>& radii,
                 std::vector<cv::Point2d>& places, std::vector<double>& distances)
{
  const bool are_near = places.size() == points.size();
  places.resize(points.size());
  distances.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const cv::Point2d& position = points[i].position;
    const cv::Point2d q = are_near ? family.toPlane(position, places[i]) : family.toPlane(position);
    const double gradient = std::max(SMALLEST_GRADIENT, cv::norm(family.radiusGradient(q)));
    places[i] = q;
    distances[i] = (cv::norm(q) - radii[points[i].ring]) / gradient;
  }
}

BentDerivative differentiateBent(const cv::Point2d& place, const RingFamily& family, double radius)
{
  const cv::Point2d gradient = family.radiusGradient(place);
  const double scale = 1 / std::max(SMALLEST_GRADIENT, cv::norm(gradient));
  const auto by_unknown = moves(family, place, radius);
  BentDerivative derivative{};
  // Where the image of the circle moves outwards, the distance falls.
  std::transform(by_unknown.begin(), by_unknown.end(), derivative.begin(),
                 [&](const cv::Point2d& move) { return -scale * gradient.dot(move); });
  derivative[BENT_UNKNOWNS] = -scale;
  return derivative;
}

}  // namespace omr
