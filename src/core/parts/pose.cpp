#include "outdoor_omr/pose.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "median.h"
#include "reprojection.h"

namespace omr
{
namespace
{
constexpr int MIN_PAIRS = 4;
constexpr double CAUCHY = 2.385;            // standard deviations; 95 % efficiency on normal noise
constexpr double OUTLIER = 4.5;             // standard deviations; a good point lies farther once in 25000 times
constexpr int REJECTIONS = 5;               // rounds
constexpr double SETTLED = 0.01;            // change of the residuals' scale from round to round
constexpr double RAYLEIGH_MEDIAN = 1.1774;  // median length of a plane vector of unit normals
// Of sigma. Corners that were drawn to a smooth surface have small residuals, and centres of targets would look like
// outliers beside them (0.2: 57 of 3000 pairs left out in 60 good pictures, 0.5: 5; 1.0 instead of 0.86 mm at 6 m).
constexpr double MIN_SCALE = 0.5;
constexpr double MAX_RMS_ERROR = 2;  // [px]; a wrong size or orientation of a board gives tens
// [rad] and relative to the distance: two starts met in one minimum. They differ by less than a millionth, or by a
// thousandth if they left out other outliers; turns and flips by degrees, sections by a square.
constexpr double SAME_TURN = 1e-2;
constexpr double SAME_PLACE = 1e-3;
// Difference of chi^2 from which the residuals tell two poses apart: by chance the wrong one is the better once in
// exp(20 / 2) = 22000 times.
constexpr double EVIDENCE = 20;

/** Standard deviation of residuals over sigma, from their median length. */
double robustScale(const std::vector<cv::Vec2d>& residuals)
{
  std::vector<double> lengths;
  lengths.reserve(residuals.size());
  for (const cv::Vec2d& residual : residuals)
  {
    lengths.push_back(cv::norm(residual));
  }
  return std::max(median(std::move(lengths)) / RAYLEIGH_MEDIAN, MIN_SCALE);
}

/** Covariance, errors and counts of a pose that has converged; `scale` bounds what an outlier counts. */
bool assess(const std::vector<PointPair>& pairs, const Reprojection& problem, double scale, Pose& pose)
{
  const std::vector<cv::Vec2d> residuals = problem.residuals(pose.camera_part);
  double used_sum = 0;
  double pixel_sum = 0;
  int used = 0;
  pose.chi_square = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i)
  {
    const double squared = residuals[i].dot(residuals[i]);
    pose.chi_square += std::min(squared, OUTLIER * OUTLIER * scale * scale);
    if (pose.used[i])
    {
      ++used;
      used_sum += squared;
      pixel_sum += squared * pairs[i].sigma * pairs[i].sigma;
    }
  }
  // More than half must agree, and leave something to judge the pose by.
  const int freedom = 2 * used - Reprojection::UNKNOWNS;
  if (used < MIN_PAIRS || 2 * used < static_cast<int>(pairs.size()))
  {
    return false;
  }
  pose.rms_error = std::sqrt(pixel_sum / used);
  if (!(pose.rms_error < MAX_RMS_ERROR))
  {
    return false;
  }
  // Four points leave two degrees of freedom: too few for a scale, so sigma is believed there.
  const bool enough = freedom > 4;
  pose.variance_factor = enough ? used_sum / freedom : std::max(1.0, used_sum / freedom);
  bool regular = false;
  const cv::Matx66d inverse = problem.information(pose.camera_part).inv(cv::DECOMP_CHOLESKY, &regular);
  // The scale is an estimate itself, which makes the pose a variable of Student's: wider than a normal one.
  pose.covariance = inverse * (pose.variance_factor * (enough ? freedom / (freedom - 2.0) : 1));
  return regular;
}

void check(const std::vector<PointPair>& pairs)
{
  if (pairs.size() < MIN_PAIRS)
  {
    throw std::invalid_argument("a pose needs four points at least, not " + std::to_string(pairs.size()));
  }
  if (std::any_of(pairs.begin(), pairs.end(), [](const PointPair& pair) { return !(pair.sigma > 0); }))
  {
    throw std::invalid_argument("sigma of a point is not more than 0 pixels");
  }
}

}  // namespace

bool isSamePose(const cv::Affine3d& a, const cv::Affine3d& b)
{
  const cv::Affine3d difference = a.inv() * b;
  return cv::norm(difference.rvec()) < SAME_TURN &&
         cv::norm(difference.translation()) < SAME_PLACE * cv::norm(a.translation());
}

bool refinePose(const std::vector<PointPair>& pairs, const Camera& camera, Pose& pose)
{
  check(pairs);
  Reprojection problem(pairs, camera);
  double scale = 0;
  // Weights of Cauchy first: a target at a wrong place must not bend the pose until corners look like the outliers.
  for (int round = 0; round < REJECTIONS; ++round)
  {
    const std::vector<cv::Vec2d> residuals = problem.residuals(pose.camera_part);
    if (residuals.empty())
    {
      return false;
    }
    const double last_scale = std::exchange(scale, robustScale(residuals));
    if (std::abs(scale - last_scale) < SETTLED * scale)
    {
      break;
    }
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      problem.weights()[i] = 1 / (1 + residuals[i].dot(residuals[i]) / std::pow(CAUCHY * scale, 2));
    }
    if (!problem.minimize(pose.camera_part))
    {
      return false;
    }
  }
  for (int round = 0; round < REJECTIONS; ++round)
  {
    const std::vector<cv::Vec2d> residuals = problem.residuals(pose.camera_part);
    scale = robustScale(residuals);
    std::vector<bool> used(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
      used[i] = cv::norm(residuals[i]) < OUTLIER * scale;
      problem.weights()[i] = used[i] ? 1 : 0;
    }
    const bool settled = used == pose.used;
    pose.used = used;
    if ((settled && round > 0) || !problem.minimize(pose.camera_part))
    {
      break;
    }
  }
  return assess(pairs, problem, scale, pose);
}

std::vector<Pose> solvePose(const std::vector<PointPair>& pairs, const Camera& camera,
                            const std::vector<cv::Affine3d>& starts)
{
  check(pairs);
  std::vector<cv::Affine3d> all_starts = planarStarts(pairs, camera);
  all_starts.insert(all_starts.end(), starts.begin(), starts.end());
  std::vector<Pose> poses;
  for (const cv::Affine3d& start : all_starts)
  {
    Pose pose;
    pose.camera_part = start;
    if (!refinePose(pairs, camera, pose))
    {
      continue;
    }
    const auto same = std::find_if(poses.begin(), poses.end(),
                                   [&](const Pose& known) { return isSamePose(known.camera_part, pose.camera_part); });
    if (same == poses.end())
    {
      poses.push_back(pose);
    }
    else if (pose.chi_square < same->chi_square)
    {
      *same = pose;
    }
  }
  std::sort(poses.begin(), poses.end(), [](const Pose& a, const Pose& b) { return a.chi_square < b.chi_square; });
  return poses;
}

bool isRival(const Pose& best, const Pose& other)
{
  const double variance = std::max(best.variance_factor, MIN_SCALE * MIN_SCALE);
  return other.chi_square - best.chi_square < EVIDENCE * variance;
}

}  // namespace omr
