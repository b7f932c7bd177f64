#include "bent_refinement.h"

#include <cmath>
#include <limits>

#include "bent_distances.h"
#include "bent_fit.h"

namespace omr
{
namespace
{
constexpr int MAX_STEPS = 12;
constexpr int FIRST_STEPS = 4;             // from each start
constexpr std::size_t FIRST_POINTS = 160;  // for each start
constexpr int AXES = 8;                    // directions of the pipe's axis to start from
constexpr double FIRST_ANGLE = .6;         // of the bend at the outermost circle [rad]
constexpr double TILTED = 1.1;             // aspect, from which on the normal's two possible directions differ
}  // namespace

bool findBend(const std::vector<BoundaryPoint>& points, RingFamily& family, std::vector<double>& radii)
{
  if (points.size() < 2 * (BENT_UNKNOWNS + radii.size()))
  {
    return false;
  }
  std::vector<BoundaryPoint> few = points;
  thin(few, FIRST_POINTS);
  // The normal appears along the short axis of small circles, foreshortened as much as that axis is not.
  const double mean = (family.a + family.d) / 2;
  const double difference = std::hypot((family.a - family.d) / 2, family.b);
  const double angle = .5 * std::atan2(2 * family.b, family.a - family.d) + CV_PI / 2;
  const double slope = std::sqrt(4 * mean * difference);
  const bool is_tilted = family.aspect() > TILTED;
  double best = std::numeric_limits<double>::infinity();
  RingFamily best_family;
  std::vector<double> best_radii;
  for (int axis = 0; axis < AXES; ++axis)
  {
    const double phi = CV_PI * axis / AXES;
    for (const double sign : {-1., 1.})
    {
      RingFamily start = family;
      start.bend = FIRST_ANGLE / radii.back() * cv::Point2d(std::cos(phi), std::sin(phi));
      start.normal = is_tilted ? sign * slope * cv::Point2d(std::cos(angle), std::sin(angle)) : cv::Point2d();
      BentFit fit(few, start, radii);
      if (fit.run(FIRST_STEPS) && fit.loss(1) < best)
      {
        best = fit.loss(1);
        best_family = fit.family();
        best_radii = fit.radii();
      }
      if (!is_tilted)
      {
        break;
      }
    }
  }
  if (best_radii.empty())
  {
    return false;
  }
  family = best_family;
  radii = best_radii;
  return true;
}

double refineBentFamily(const std::vector<BoundaryPoint>& points, RingFamily& family, std::vector<double>& radii)
{
  if (points.size() < BENT_UNKNOWNS + radii.size() + 4 || radii.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  BentFit fit(points, family, radii);
  if (!fit.run(MAX_STEPS))
  {
    return std::numeric_limits<double>::infinity();
  }
  family = fit.family();
  radii = fit.radii();
  return fit.rms();
}

}  // namespace omr
