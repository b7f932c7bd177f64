#include "outdoor_omr/region.h"

#include <algorithm>
#include <cmath>

namespace omr
{
Region toRegion(const RegionSums& sums)
{
  const double n = sums.area;
  Region region;
  region.label = sums.label;
  region.area = static_cast<int>(sums.area);
  region.perimeter = static_cast<int>(sums.perimeter);
  region.color = cv::Vec3f(static_cast<float>(sums.blue / n), static_cast<float>(sums.green / n),
                           static_cast<float>(sums.red / n));
  region.center = cv::Point2d(sums.x / n, sums.y / n);
  region.box = cv::Rect(sums.min_x, sums.min_y, sums.max_x - sums.min_x + 1, sums.max_y - sums.min_y + 1);
  const double xx = sums.xx / n - region.center.x * region.center.x;
  const double yy = sums.yy / n - region.center.y * region.center.y;
  // A unit square has the variance 1/12 along each side.
  region.cxx = xx + 1. / 12;
  region.cyy = yy + 1. / 12;
  region.cxy = sums.xy / n - region.center.x * region.center.y;
  region.mean_distance = sums.distance / (4096 * n);
  region.distance_deviation = std::sqrt(std::max(0., xx + yy - region.mean_distance * region.mean_distance));
  return region;
}

}  // namespace omr
