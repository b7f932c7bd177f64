#ifndef OUTDOOR_OMR_FUSION_H
#define OUTDOOR_OMR_FUSION_H

#include <opencv2/core/affine.hpp>
#include <vector>

#include "outdoor_omr/pose_estimate.h"

namespace omr
{
/** How well it is known where a camera stands: standard deviations of each coordinate [m] and each small turn [rad]. */
struct CameraSigma
{
  double position = 0;
  double rotation = 0;
};

/**
 * The estimate of one camera in a frame that several share. Its covariance grows by what the camera's own place is
 * uncertain by: a turn of the camera moves what it sees with the distance.
 *
 * @param estimate     in the camera's frame.
 * @param frame_camera X_frame = frame_camera * X_camera.
 */
PoseEstimate inSharedFrame(const PoseEstimate& estimate, const cv::Affine3d& frame_camera, const CameraSigma& sigma);

/** What several cameras say of one part. */
struct FusedPose
{
  PoseEstimate estimate;             ///< the most likely pose, and its covariance if the cameras agree
  std::vector<cv::Vec6d> residuals;  ///< stepBetween() the fused pose and each camera's
  double chi_square = 0;             ///< their squares over their covariances
  int degrees_of_freedom = 0;        ///< 6 for every camera beyond the first
  bool agree = true;  ///< chi_square is below its 99.9 % quantile: otherwise the estimate is not to be used
};

/**
 * Most likely pose of independent estimates in one frame: least squares over position and rotation, weighted by the
 * inverse covariances, iterated because rotations do not add up.
 *
 * @throws std::invalid_argument for no estimate, or a covariance that is not positive definite.
 */
FusedPose fuse(const std::vector<PoseEstimate>& estimates);

}  // namespace omr

#endif
