#include "outdoor_omr/deviation.h"

namespace omr
{
namespace
{
Verdict judge(double deviation, double uncertainty, double tolerance)
{
  if (deviation + uncertainty <= tolerance)
  {
    return Verdict::within;
  }
  return deviation - uncertainty > tolerance ? Verdict::outside : Verdict::undecided;
}

Verdict both(Verdict a, Verdict b)
{
  if (a == Verdict::outside || b == Verdict::outside)
  {
    return Verdict::outside;
  }
  return a == b ? a : Verdict::undecided;
}
}  // namespace

Deviation deviationFrom(const Goal& goal, const PoseEstimate& estimate)
{
  const cv::Affine3d goal_part = goal.pose.inv() * estimate.pose;
  Deviation deviation;
  deviation.translation = goal_part.translation();
  deviation.rotation = goal_part.rvec();
  deviation.position_uncertainty = positionRadius95(estimate.covariance);
  deviation.rotation_uncertainty = rotationRadius95(estimate.covariance);
  deviation.verdict =
      both(judge(cv::norm(deviation.translation), deviation.position_uncertainty, goal.position_tolerance),
           judge(cv::norm(deviation.rotation), deviation.rotation_uncertainty, goal.rotation_tolerance));
  return deviation;
}

}  // namespace omr
