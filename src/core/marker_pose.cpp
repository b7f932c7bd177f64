#include "marker_pose.h"

#include <algorithm>

namespace omr
{
namespace
{
// Squared errors of the corners of a board of 6 x 8 over those that are left of them after smoothing, each by its
// degrees of freedom: 68 of the 90 lie outside the smooth surface and keep a fifth of their length.
constexpr double SMOOTHING = 3.6;
}  // namespace

std::vector<Pose> solveMarkers(const std::vector<PointPair>& pairs, const Camera& camera)
{
  std::vector<Pose> poses = solvePose(pairs, camera);
  for (Pose& pose : poses)
  {
    const double variance = std::max(1.0, SMOOTHING * pose.variance_factor);
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
