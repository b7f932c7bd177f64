#include "outdoor_omr/fusion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace omr
{
namespace
{
constexpr int MAX_ITERATIONS = 20;
constexpr double CONVERGED = 1e-12;  // [m], [rad]

/** 99.9 % quantile of chi square, by the approximation of Wilson and Hilferty (1931): too large by 0.97 % at 6 degrees
 * of freedom (22.677, not 22.458), by 0.49 % at 12 and less from there on. */
double chiSquare999(int degrees_of_freedom)
{
  constexpr double NORMAL_999 = 3.0902;
  const double spread = 2.0 / (9.0 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1 - spread + NORMAL_999 * std::sqrt(spread), 3);
}

cv::Matx66d informationOf(const PoseEstimate& estimate)
{
  bool invertible = false;
  const cv::Matx66d information = estimate.covariance.inv(cv::DECOMP_CHOLESKY, &invertible);
  if (!invertible)
  {
    throw std::invalid_argument("a covariance of a pose that is not positive definite");
  }
  return information;
}
}  // namespace

PoseEstimate inSharedFrame(const PoseEstimate& estimate, const cv::Affine3d& frame_camera, const CameraSigma& sigma)
{
  PoseEstimate shared = transformed(estimate, frame_camera);
  const cv::Vec3d ray = shared.pose.translation() - frame_camera.translation();
  // A turn w of the camera moves the part by w x ray = -[ray]x w, and turns it by w.
  const cv::Matx33d shift(0, ray[2], -ray[1], -ray[2], 0, ray[0], ray[1], -ray[0], 0);
  cv::Matx<double, 6, 3> by_turn;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      by_turn(i, j) = shift(i, j);
      by_turn(3 + i, j) = i == j ? 1 : 0;
    }
    shared.covariance(i, i) += sigma.position * sigma.position;
  }
  shared.covariance += by_turn * by_turn.t() * (sigma.rotation * sigma.rotation);
  return shared;
}

FusedPose fuse(const std::vector<PoseEstimate>& estimates)
{
  if (estimates.empty())
  {
    throw std::invalid_argument("no estimate of a pose to fuse");
  }
  std::vector<cv::Matx66d> information;
  cv::Matx66d total = cv::Matx66d::zeros();
  for (const PoseEstimate& estimate : estimates)
  {
    information.push_back(informationOf(estimate));
    total += information.back();
  }
  FusedPose fused;
  fused.estimate.pose = estimates.front().pose;
  fused.estimate.covariance = total.inv(cv::DECOMP_CHOLESKY);
  for (int iteration = 0; iteration < MAX_ITERATIONS; ++iteration)
  {
    cv::Vec6d pull = cv::Vec6d::all(0);
    for (std::size_t i = 0; i < estimates.size(); ++i)
    {
      pull += information[i] * stepBetween(fused.estimate.pose, estimates[i].pose);
    }
    const cv::Vec6d step = fused.estimate.covariance * pull;
    fused.estimate.pose = stepped(fused.estimate.pose, step);
    if (cv::norm(step) < CONVERGED)
    {
      break;
    }
  }
  for (std::size_t i = 0; i < estimates.size(); ++i)
  {
    fused.residuals.push_back(stepBetween(fused.estimate.pose, estimates[i].pose));
    fused.chi_square += fused.residuals.back().dot(information[i] * fused.residuals.back());
  }
  fused.degrees_of_freedom = 6 * (static_cast<int>(estimates.size()) - 1);
  fused.agree = fused.degrees_of_freedom == 0 || fused.chi_square <= chiSquare999(fused.degrees_of_freedom);
  return fused;
}

}  // namespace omr
