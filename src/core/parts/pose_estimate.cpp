#include "outdoor_omr/pose_estimate.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
double radius95(const cv::Matx33d& covariance)
{
  cv::Vec3d variances;
  cv::eigen(covariance, variances);
  return std::sqrt(CHI_SQUARE_95 * std::max(0., variances[0]));
}

/** The Jacobian of where the end of an arm is by the step of its beginning: a turn w moves it by w x arm. */
cv::Matx66d swingOf(const cv::Vec3d& arm)
{
  const cv::Matx33d swing(0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0);
  cv::Matx66d jacobian = cv::Matx66d::eye();
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      jacobian(i, 3 + j) = swing(i, j);
    }
  }
  return jacobian;
}
}  // namespace

PoseEstimate transformed(const PoseEstimate& estimate, const cv::Affine3d& other_frame)
{
  const cv::Matx33d rotation = other_frame.rotation();
  cv::Matx66d turn = cv::Matx66d::zeros();
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      turn(i, j) = turn(3 + i, 3 + j) = rotation(i, j);
    }
  }
  return {other_frame * estimate.pose, turn * estimate.covariance * turn.t()};
}

PoseEstimate movedTo(const PoseEstimate& estimate, const cv::Affine3d& origin)
{
  const cv::Affine3d pose = estimate.pose * origin;
  const cv::Matx66d jacobian = swingOf(pose.translation() - estimate.pose.translation());
  return {pose, jacobian * estimate.covariance * jacobian.t()};
}

PoseEstimate relativeTo(const PoseEstimate& other, const PoseEstimate& part)
{
  // What moves the other part moves this one, seen from it, the other way.
  const cv::Matx66d by_other = swingOf(part.pose.translation() - other.pose.translation());
  const PoseEstimate apart{part.pose, part.covariance + by_other * other.covariance * by_other.t()};
  return transformed(apart, other.pose.inv());
}

cv::Vec6d stepBetween(const cv::Affine3d& from, const cv::Affine3d& to)
{
  const cv::Vec3d shift = to.translation() - from.translation();
  const cv::Vec3d turn = cv::Affine3d(to.rotation() * from.rotation().t()).rvec();
  return {shift[0], shift[1], shift[2], turn[0], turn[1], turn[2]};
}

cv::Affine3d stepped(const cv::Affine3d& from, const cv::Vec6d& step)
{
  const cv::Affine3d turn(cv::Vec3d(step[3], step[4], step[5]));
  return {turn.rotation() * from.rotation(), from.translation() + cv::Vec3d(step[0], step[1], step[2])};
}

cv::Vec3d rollPitchYaw(const cv::Matx33d& rotation)
{
  constexpr double UPRIGHT = 1e-9;  // cosine of the pitch; below it is rounding
  const double cosine = std::hypot(rotation(0, 0), rotation(1, 0));
  const double pitch = std::atan2(-rotation(2, 0), cosine);
  if (cosine < UPRIGHT)
  {
    return {std::atan2(-rotation(1, 2), rotation(1, 1)), pitch, 0};
  }
  return {std::atan2(rotation(2, 1), rotation(2, 2)), pitch, std::atan2(rotation(1, 0), rotation(0, 0))};
}

double positionRadius95(const cv::Matx66d& covariance)
{
  return radius95(covariance.get_minor<3, 3>(0, 0));
}

double rotationRadius95(const cv::Matx66d& covariance)
{
  return radius95(covariance.get_minor<3, 3>(3, 3));
}

}  // namespace omr
