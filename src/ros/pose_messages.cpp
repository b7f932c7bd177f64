#include "pose_messages.h"

#include <tf2/LinearMath/Matrix3x3.h>
#include <tf2/LinearMath/Quaternion.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omr
{
namespace
{
constexpr double QUATERNION_TOLERANCE = 0.01;  // of its length

cv::Affine3d toAffine(const geometry_msgs::Quaternion& q, double x, double y, double z)
{
  const tf2::Quaternion quaternion(q.x, q.y, q.z, q.w);
  if (!std::isfinite(x + y + z) || !(std::abs(quaternion.length() - 1) < QUATERNION_TOLERANCE))
  {
    throw std::invalid_argument("a pose with a position that is no number or a quaternion of another length than 1");
  }
  const tf2::Matrix3x3 m(quaternion);
  cv::Matx33d rotation;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rotation(i, j) = m[i][j];
    }
  }
  return {rotation, cv::Vec3d(x, y, z)};
}
}  // namespace

geometry_msgs::Point toPoint(const cv::Point3d& point)
{
  geometry_msgs::Point message;
  message.x = point.x;
  message.y = point.y;
  message.z = point.z;
  return message;
}

geometry_msgs::Vector3 toVector(const cv::Vec3d& vector)
{
  geometry_msgs::Vector3 message;
  message.x = vector[0];
  message.y = vector[1];
  message.z = vector[2];
  return message;
}

geometry_msgs::Quaternion toQuaternion(const cv::Matx33d& rotation)
{
  const cv::Matx33d& r = rotation;
  tf2::Quaternion q;
  tf2::Matrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)).getRotation(q);
  geometry_msgs::Quaternion message;
  message.w = q.w();
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  return message;
}

geometry_msgs::PoseWithCovariance toMessage(const PoseEstimate& estimate)
{
  geometry_msgs::PoseWithCovariance message;
  message.pose.position = toPoint(cv::Point3d(estimate.pose.translation()));
  message.pose.orientation = toQuaternion(estimate.pose.rotation());
  std::copy(estimate.covariance.val, estimate.covariance.val + 36, message.covariance.begin());
  return message;
}

PoseEstimate fromMessage(const geometry_msgs::PoseWithCovariance& message)
{
  const geometry_msgs::Point& position = message.pose.position;
  PoseEstimate estimate;
  estimate.pose = toAffine(message.pose.orientation, position.x, position.y, position.z);
  std::copy(message.covariance.begin(), message.covariance.end(), estimate.covariance.val);
  if (!cv::checkRange(estimate.covariance))
  {
    throw std::invalid_argument("a covariance that is no number");
  }
  return estimate;
}

cv::Affine3d fromMessage(const geometry_msgs::Transform& message)
{
  return toAffine(message.rotation, message.translation.x, message.translation.y, message.translation.z);
}

}  // namespace omr
