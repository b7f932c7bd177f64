#include "ring_own_boundary.h"

#include <algorithm>
#include <cmath>

#include "targets/boundaries/ring_boundaries.h"

namespace omr
{
namespace
{
/** Whether the colour changes alike across the circle in many directions: a look that needs no edges. */
bool changesAlike(const cv::Mat& bgr, const RingFamily& family, double radius)
{
  constexpr int LOOKS = 24;             // directions
  constexpr double REACH = .08;         // of the radius, to either side
  constexpr double MIN_REACH = 1.5;     // [px]
  constexpr float FAINT = .05F;         // relative change that counts half
  constexpr double MIN_COHERENCE = .4;  // the same targets as without this look, in all development sets
  const double reach = std::max(MIN_REACH, REACH * radius);
  const cv::Rect image(cv::Point(), bgr.size());
  cv::Vec3f sum(0, 0, 0);
  int count = 0;
  for (int i = 0; i < LOOKS; ++i)
  {
    const double phi = 2 * CV_PI * i / LOOKS;
    const cv::Point2d direction(std::cos(phi), std::sin(phi));
    const cv::Point inner = family.toImage((radius - reach) * direction);
    const cv::Point outer = family.toImage((radius + reach) * direction);
    if (image.contains(inner) && image.contains(outer))
    {
      const cv::Vec3f inside = bgr.at<cv::Vec3b>(inner);
      const cv::Vec3f outside = bgr.at<cv::Vec3b>(outer);
      const float brightness =
          std::max({inside[0], inside[1], inside[2]}) + std::max({outside[0], outside[1], outside[2]}) + 2 * DARK_LEVEL;
      const cv::Vec3f change = (outside - inside) * (2 / brightness);
      sum += change * (1 / (static_cast<float>(cv::norm(change)) + FAINT));
      ++count;
    }
  }
  return 2 * count < LOOKS || cv::norm(sum) >= MIN_COHERENCE * count;
}
}  // namespace

bool hasOwnBoundary(EdgelMap& map, const cv::Mat& bgr, const RingSeed& seed)
{
  if (!changesAlike(bgr, seed.family, seed.radius + 1.2))
  {
    return false;
  }
  std::vector<RadialEdgel> edgels;
  const double radius = seed.radius + 1.2;  // the region ends where its edge begins
  collectRadialEdgels(map, seed.family, radius * 1.2 + 2, .85, edgels);
  const AngularSupport support(edgels, radius * 1.2 + 2);
  const double tolerance = std::max(.9, .03 * radius);
  double best = 0;
  const double from = radius * .85 - .6;
  const int steps = static_cast<int>((radius * 1.2 + 1 - from) / tolerance) + 1;
  for (int i = 0; i <= steps; ++i)
  {
    best = std::max(best, share(support.at(from + i * tolerance, tolerance)));
  }
  return best >= .55;
}

}  // namespace omr
