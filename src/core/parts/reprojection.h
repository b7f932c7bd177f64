#ifndef OUTDOOR_OMR_CORE_REPROJECTION_H
#define OUTDOOR_OMR_CORE_REPROJECTION_H

#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/pose.h"

namespace omr
{
/**
 * The point in the camera's frame that is seen at the pixel of a pair: the pair's own, and of a circle the pole of the
 * line in its plane that lies as near as the camera's centre, which is what is seen in the middle of the ellipse.
 */
cv::Point3d seenPoint(const cv::Affine3d& camera_part, const PointPair& pair);

/** The weighted least squares problem behind a pose. Its six unknowns are those of Pose::covariance. */
class Reprojection
{
 public:
  static constexpr int UNKNOWNS = 6;

  Reprojection(const std::vector<PointPair>& pairs, const Camera& camera);

  /** Of the squared residuals, one a pair; 1 at first. */
  std::vector<double>& weights();

  /** Pixel minus reprojected point, over sigma; empty if a point lies behind the camera. */
  std::vector<cv::Vec2d> residuals(const cv::Affine3d& pose, std::vector<cv::Matx23d>* derivatives = nullptr) const;

  /** Levenberg-Marquardt from `pose`. @return false if it starts behind the camera or degenerates. */
  bool minimize(cv::Affine3d& pose) const;

  /** J^T W J: the inverse of the covariance where all sigmas are right. */
  cv::Matx66d information(const cv::Affine3d& pose) const;

 private:
  /** The normal equations at a pose. */
  struct Normal
  {
    cv::Matx66d hessian = cv::Matx66d::zeros();
    cv::Matx<double, UNKNOWNS, 1> gradient = cv::Matx<double, UNKNOWNS, 1>::zeros();
    double cost = 0;
  };

  Normal normal(const cv::Affine3d& pose) const;
  double cost(const std::vector<cv::Vec2d>& residuals) const;

  const std::vector<PointPair>& pairs_;
  const Camera& camera_;
  std::vector<double> weights_;
};

/**
 * Both poses of the points as if they lay in their best plane (IPPE, Collins & Bartoli 2014).
 *
 * @return none if they lie on a line.
 */
std::vector<cv::Affine3d> planarStarts(const std::vector<PointPair>& pairs, const Camera& camera);

}  // namespace omr

#endif
