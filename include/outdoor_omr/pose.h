#ifndef OUTDOOR_OMR_POSE_H
#define OUTDOOR_OMR_POSE_H

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <vector>

#include "outdoor_omr/camera.h"

namespace omr
{
/** A point of a part and where it was seen. */
struct PointPair
{
  cv::Point3d point;  ///< in the frame of the part [m]
  cv::Point2d pixel;
  double sigma = 1;  ///< standard deviation of the pixel, each coordinate [px]; only ratios matter with many points

  /** Not 0: the pixel is the centre of the ellipse that is the image of a circle about the point, which is not the
   * image of the point itself. Axis of the circle, as long as its radius, in the frame of the part [m]. */
  cv::Vec3d circle{0, 0, 0};
};

/** Where a part is. */
struct Pose
{
  /** X_camera = camera_part * X_part [m], in the camera's optical frame. */
  cv::Affine3d camera_part;

  /**
   * Of x, y, z [m] of the part's origin and of small turns about axes through it parallel to the camera's x, y, z
   * [rad]: the order of ROS's PoseWithCovariance. From the Jacobian and the residuals; it knows the noise of
   * the pixels, not errors of the calibration or of the parts file.
   */
  cv::Matx66d covariance;

  double rms_error = 0;        ///< of the pairs used, pixel to reprojected point [px]
  double chi_square = 0;       ///< sum of squared residuals of all pairs over sigma, those of outliers capped
  double variance_factor = 1;  ///< squared residuals over sigma to be expected, 1 where sigma is right
  std::vector<bool> used;      ///< false: an outlier, one a pair
};

/**
 * Pose from at least four pairs: planar starts (IPPE, Collins & Bartoli 2014; depth across the best plane is left out),
 * each refined over all pairs by Levenberg-Marquardt, outliers rejected.
 *
 * @param starts further ones, as the pose of some of the pairs: of points far from any plane no planar start may lead
 *               to a pose.
 * @return the local minima, least chi_square first: none if no pose explains the pairs, two if both of a flat, small or
 *         distant part do. The second is a flip, no rival, where isRival() says no.
 * @throws std::invalid_argument for fewer than four pairs or a sigma that is not positive.
 */
std::vector<Pose> solvePose(const std::vector<PointPair>& pairs, const Camera& camera,
                            const std::vector<cv::Affine3d>& starts = {});

/** Refines one pose over other or more pairs. @return false if it does not converge to a pose in front of the camera.
 */
bool refinePose(const std::vector<PointPair>& pairs, const Camera& camera, Pose& pose);

/** Whether two poses are one minimum: they differ by less than 0.01 rad and a thousandth of the distance. */
bool isSamePose(const cv::Affine3d& a, const cv::Affine3d& b);

/** Whether the residuals do not tell `other` from `best`, a pose of the same pairs. */
bool isRival(const Pose& best, const Pose& other);

}  // namespace omr

#endif
