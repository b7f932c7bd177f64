#include "marker_pose.h"

#include <algorithm>

namespace omr
{
namespace
{
// What refineCorners() leaves of the squared errors: all in the directions of the smooth surface, of which about seven
// are not those of the pose, a fifth of the length in the others. For 6 x 8 corners that makes 9; measured on rendered
// boards at 1 to 6 m: 6 to 8.
constexpr double SURFACE_FREEDOM = 7;
constexpr double KEPT = 0.04;

/** Squared errors of the corners over those that the residuals show. */
double smoothing(const Pose& pose)
{
  const double freedom = 2.0 * static_cast<double>(std::count(pose.used.begin(), pose.used.end(), true)) - 6;
  const double in_surface = std::min(freedom, SURFACE_FREEDOM);
  return freedom > 0 ? freedom / (in_surface + KEPT * (freedom - in_surface)) : 1;
}
}  // namespace

std::vector<Pose> solveMarkers(const std::vector<PointPair>& pairs, const Camera& camera,
                               const std::vector<cv::Affine3d>& starts)
{
  std::vector<Pose> poses = solvePose(pairs, camera, starts);
  for (Pose& pose : poses)
  {
    const double variance = std::max(1.0, smoothing(pose) * pose.variance_factor);
    pose.covariance *= variance / pose.variance_factor;
    pose.variance_factor = variance;
  }
  if (poses.size() > 1 && !isRival(poses[0], poses[1]))
  {
    poses.resize(1);
  }
  return poses;
}

}  // namespace omr
