#ifndef OUTDOOR_OMR_POSE_ESTIMATE_H
#define OUTDOOR_OMR_POSE_ESTIMATE_H

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>

namespace omr
{
/** 95 % quantile of chi square with three degrees of freedom, those of a position or of a turn. */
constexpr double CHI_SQUARE_95 = 7.815;

/** Where a part is in some frame, and how well that is known. */
struct PoseEstimate
{
  cv::Affine3d pose;  ///< X_frame = pose * X_part [m]

  /** Of x, y, z [m] of the part's origin and of small turns about axes through it parallel to the frame's x, y, z
   * [rad]: the order of ROS's PoseWithCovariance. */
  cv::Matx66d covariance;
};

/** The same estimate in another frame. @param other_frame X_other = other_frame * X_frame. */
PoseEstimate transformed(const PoseEstimate& estimate, const cv::Affine3d& other_frame);

/** The same estimate for another point of the part. @param origin X_part = origin * X_new [m]. */
PoseEstimate movedTo(const PoseEstimate& estimate, const cv::Affine3d& origin);

/** Where a part is in the frame of another, both measured in one frame, independently of each other. */
PoseEstimate relativeTo(const PoseEstimate& other, const PoseEstimate& part);

/**
 * The step from one pose to another: x, y, z [m] and the rotation vector [rad] of the turn about the fixed axes that
 * takes the rotation of `from` to that of `to`; the order and the axes of the covariance.
 */
cv::Vec6d stepBetween(const cv::Affine3d& from, const cv::Affine3d& to);

/** The pose that a step leads to. */
cv::Affine3d stepped(const cv::Affine3d& from, const cv::Vec6d& step);

/** Roll, pitch and yaw [rad] of a rotation: about the fixed axes x, then y, then z, as in URDF and in the files'
 * rpy_degrees. At a pitch of 90 degrees, where the two others are one turn, yaw is 0. */
cv::Vec3d rollPitchYaw(const cv::Matx33d& rotation);

/** Radius of the ball about the position [m] that holds it with 95 %, were it as uncertain in all directions as in the
 * worst one. */
double positionRadius95(const cv::Matx66d& covariance);

/** Likewise the angle [rad] that the turn is uncertain by. */
double rotationRadius95(const cv::Matx66d& covariance);

}  // namespace omr

#endif
