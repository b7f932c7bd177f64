#ifndef OUTDOOR_OMR_ROS_POSE_MESSAGES_H
#define OUTDOOR_OMR_ROS_POSE_MESSAGES_H

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

#include "outdoor_omr/pose_estimate.h"

namespace omr
{
geometry_msgs::Point toPoint(const cv::Point3d& point);
geometry_msgs::Vector3 toVector(const cv::Vec3d& vector);
geometry_msgs::Quaternion toQuaternion(const cv::Matx33d& rotation);
geometry_msgs::PoseWithCovariance toMessage(const PoseEstimate& estimate);

/** @throws std::invalid_argument unless the orientation is of length 1 and all numbers are finite. */
PoseEstimate fromMessage(const geometry_msgs::PoseWithCovariance& message);
cv::Affine3d fromMessage(const geometry_msgs::Transform& message);

}  // namespace omr

#endif
