#include "outdoor_omr/pose_estimate.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
double radius95(const cv::Matx33d& covariance)
{
  constexpr double CHI_SQUARE_95 = 7.815;  // of three coordinates
  cv::Vec3d variances;
  cv::eigen(covariance, variances);
  return std::sqrt(CHI_SQUARE_95 * std::max(0., variances[0]));
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

double positionRadius95(const cv::Matx66d& covariance)
{
  return radius95(covariance.get_minor<3, 3>(0, 0));
}

double rotationRadius95(const cv::Matx66d& covariance)
{
  return radius95(covariance.get_minor<3, 3>(3, 3));
}

}  // namespace omr
