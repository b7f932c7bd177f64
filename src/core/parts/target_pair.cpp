#include "target_pair.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "marker_pose.h"

namespace omr
{
namespace
{
// How far from a board's plane a centre may lie, in rings: a target on another face has it by whole radii off.
constexpr double IN_PLANE = 0.5;
// How far the ellipse's centre may lie from that of the circles, in radii. Perspective makes it 0.06 at the most in the
// evaluation data; an ellipse that followed an edge beside the target had 0.16.
constexpr double CONCENTRIC = 0.1;

/** The axis of a target's circles; none if it lies in no flat board's plane. */
std::optional<cv::Vec3d> axisOf(const Part& part, const PartTarget& target)
{
  for (const PartCheckerboard& board : part.checkerboards)
  {
    const cv::Point3d on_board = board.pose.inv() * target.center;
    if (board.curvature == 0 && std::abs(on_board.z) < IN_PLANE * target.ring)
    {
      return board.pose.rotation() * cv::Vec3d(0, 0, 1);
    }
  }
  return std::nullopt;
}

/** The centre that an ellipse would have without the distortion of the lens, as a pixel of the image with it. */
cv::Point2d straightCenter(const cv::RotatedRect& ellipse, const Camera& camera)
{
  constexpr int POINTS = 16;
  const double turn = ellipse.angle * CV_PI / 180;
  const cv::Point2d x_axis = cv::Point2d(std::cos(turn), std::sin(turn)) * (ellipse.size.width / 2.0);
  const cv::Point2d y_axis = cv::Point2d(-std::sin(turn), std::cos(turn)) * (ellipse.size.height / 2.0);
  std::vector<cv::Point2d> boundary;
  for (int i = 0; i < POINTS; ++i)
  {
    const double angle = 2 * CV_PI * i / POINTS;
    boundary.push_back(cv::Point2d(ellipse.center) + x_axis * std::cos(angle) + y_axis * std::sin(angle));
  }
  const std::vector<cv::Point2d> rays = camera.normalize(boundary);
  const cv::Point2d center = cv::fitEllipse(std::vector<cv::Point2f>(rays.begin(), rays.end())).center;
  return camera.project({{center.x, center.y, 1}}).front();
}
}  // namespace

PointPair targetPair(const Part& part, const PartTarget& target, const Target& seen, const Camera& camera)
{
  const std::optional<cv::Vec3d> axis = axisOf(part, target);
  const bool is_placed = seen.outermost_deviation > 0;
  if (axis && is_placed && seen.rings.size() == target.colors.size())
  {
    const cv::RotatedRect& ellipse = seen.rings.back();
    const cv::Point2d middle = straightCenter(ellipse, camera);
    const double radius = std::max(ellipse.size.width, ellipse.size.height) / 2.0;
    if (cv::norm(middle - seen.center) < CONCENTRIC * radius)
    {
      const double length = target.ring * static_cast<double>(target.colors.size());
      return {target.center, middle, std::max(seen.outermost_deviation, RING_SIGMA), *axis * length};
    }
  }
  return {target.center, seen.center, axis && !is_placed ? UNPLACED_SIGMA : TARGET_SIGMA};
}

}  // namespace omr
