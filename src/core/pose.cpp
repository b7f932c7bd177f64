#include "outdoor_omr/pose.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace omr
{
namespace
{
constexpr int UNKNOWNS = 6;
constexpr int MIN_PAIRS = 4;
constexpr int MAX_STEPS = 30;               // of Levenberg-Marquardt; from IPPE 4 to 8 are needed
constexpr double CONVERGED = 1e-10;         // relative gain of a step
constexpr double CAUCHY = 2.385;            // standard deviations; 95 % efficiency on normal noise
constexpr double OUTLIER = 4.5;             // standard deviations; a good point lies farther once in 25000 times
constexpr int REJECTIONS = 5;               // rounds
constexpr double RAYLEIGH_MEDIAN = 1.1774;  // median length of a plane vector of unit normals
constexpr double MIN_SCALE = 0.2;           // of sigma: 0.01 px for a corner, which no image reaches
constexpr double MAX_RMS_ERROR = 2;         // [px]; a wrong size or orientation of a board gives tens
constexpr double SAME_TURN = 1e-3;          // [rad] and relative to the distance: two starts met in one minimum
// Difference of chi^2 from which the residuals tell two poses apart: by chance the wrong one is the better once in
// exp(20 / 2) = 22000 times.
constexpr double EVIDENCE = 20;

/** Sums of the normal equations at a pose. */
struct Normal
{
  cv::Matx66d hessian = cv::Matx66d::zeros();
  cv::Matx<double, UNKNOWNS, 1> gradient = cv::Matx<double, UNKNOWNS, 1>::zeros();
  double cost = 0;
};

cv::Matx33d cross(const cv::Vec3d& v)
{
  return {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
}

class Problem
{
 public:
  Problem(const std::vector<PointPair>& pairs, const Camera& camera) : pairs_(pairs), camera_(camera)
  {
    weights_.assign(pairs.size(), 1);
  }

  std::vector<double>& weights()
  {
    return weights_;
  }

  /** Pixel minus reprojected point, over sigma; empty if a point lies behind the camera. */
  std::vector<cv::Vec2d> residuals(const cv::Affine3d& pose, std::vector<cv::Matx23d>* derivatives = nullptr) const
  {
    std::vector<cv::Point3d> points;
    for (const PointPair& pair : pairs_)
    {
      points.push_back(pose * pair.point);
      if (!(points.back().z > 1e-6))
      {
        return {};
      }
    }
    const std::vector<cv::Point2d> projected = camera_.project(points, derivatives);
    std::vector<cv::Vec2d> result;
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
      const cv::Point2d difference = pairs_[i].pixel - projected[i];
      result.emplace_back(difference.x / pairs_[i].sigma, difference.y / pairs_[i].sigma);
    }
    return result;
  }

  double cost(const std::vector<cv::Vec2d>& residuals) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < residuals.size(); ++i)
    {
      sum += weights_[i] * residuals[i].dot(residuals[i]);
    }
    return sum;
  }

  Normal normal(const cv::Affine3d& pose) const
  {
    Normal sums;
    std::vector<cv::Matx23d> derivatives;
    const std::vector<cv::Vec2d> differences = residuals(pose, &derivatives);
    sums.cost = cost(differences);
    for (std::size_t i = 0; i < differences.size(); ++i)
    {
      const cv::Matx23d by_shift = derivatives[i] * (1 / pairs_[i].sigma);
      const cv::Matx23d by_turn = by_shift * cross(pose.rotation() * cv::Vec3d(pairs_[i].point)) * -1.0;
      cv::Matx<double, 2, UNKNOWNS> jacobian;
      for (int row = 0; row < 2; ++row)
      {
        for (int column = 0; column < 3; ++column)
        {
          jacobian(row, column) = by_shift(row, column);
          jacobian(row, column + 3) = by_turn(row, column);
        }
      }
      sums.hessian += weights_[i] * (jacobian.t() * jacobian);
      sums.gradient += weights_[i] * (jacobian.t() * differences[i]);
    }
    return sums;
  }

  /** Levenberg-Marquardt from `pose`. @return false if it starts behind the camera or degenerates. */
  bool minimize(cv::Affine3d& pose) const
  {
    double damping = 1e-4;
    for (int step = 0; step < MAX_STEPS; ++step)
    {
      const Normal sums = normal(pose);
      if (!(sums.hessian(0, 0) > 0) || !std::isfinite(sums.cost))
      {
        return false;
      }
      bool gained = false;
      double gain = 0;
      while (!gained && damping < 1e12)
      {
        cv::Matx66d damped = sums.hessian;
        for (int i = 0; i < UNKNOWNS; ++i)
        {
          damped(i, i) *= 1 + damping;
        }
        const cv::Matx<double, UNKNOWNS, 1> move = damped.solve(sums.gradient, cv::DECOMP_CHOLESKY);
        const cv::Affine3d turn(cv::Vec3d(move(3), move(4), move(5)));
        const cv::Affine3d moved(turn.rotation() * pose.rotation(),
                                 pose.translation() + cv::Vec3d(move(0), move(1), move(2)));
        const std::vector<cv::Vec2d> differences = residuals(moved);
        const double new_cost = cost(differences);
        gained = !differences.empty() && new_cost <= sums.cost;
        damping *= gained ? 0.1 : 10;
        if (gained)
        {
          gain = sums.cost - new_cost;
          pose = moved;
        }
      }
      if (!gained || gain <= CONVERGED * sums.cost)
      {
        break;
      }
    }
    return true;
  }

 private:
  const std::vector<PointPair>& pairs_;
  const Camera& camera_;
  std::vector<double> weights_;
};

/** Standard deviation of residuals over sigma, from their median length. */
double robustScale(const std::vector<cv::Vec2d>& residuals)
{
  std::vector<double> lengths;
  for (const cv::Vec2d& residual : residuals)
  {
    lengths.push_back(cv::norm(residual));
  }
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  return std::max(lengths[lengths.size() / 2] / RAYLEIGH_MEDIAN, MIN_SCALE);
}

/** Covariance, errors and counts of a pose that has converged; `scale` bounds what an outlier counts. */
bool assess(const std::vector<PointPair>& pairs, const Problem& problem, double scale, Pose& pose)
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
  const int freedom = 2 * used - UNKNOWNS;
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
  const cv::Matx66d inverse = problem.normal(pose.camera_part).hessian.inv(cv::DECOMP_CHOLESKY, &regular);
  // The scale is an estimate itself, which makes the pose a variable of Student's: wider than a normal one.
  pose.covariance = inverse * (pose.variance_factor * (enough ? freedom / (freedom - 2.0) : 1));
  return regular;
}

/** The plane that fits the points best: maps its coordinates (z across it) to theirs. @return false for a line. */
bool bestPlane(const std::vector<PointPair>& pairs, cv::Affine3d& plane)
{
  cv::Vec3d mean(0, 0, 0);
  for (const PointPair& pair : pairs)
  {
    mean += cv::Vec3d(pair.point) * (1.0 / pairs.size());
  }
  cv::Matx33d scatter = cv::Matx33d::zeros();
  for (const PointPair& pair : pairs)
  {
    const cv::Vec3d arm = cv::Vec3d(pair.point) - mean;
    scatter += arm * arm.t();
  }
  cv::Vec3d values;
  cv::Matx33d vectors;  // rows, the largest first
  cv::eigen(scatter, values, vectors);
  const cv::Vec3d x(vectors(0, 0), vectors(0, 1), vectors(0, 2));
  const cv::Vec3d y(vectors(1, 0), vectors(1, 1), vectors(1, 2));
  const cv::Vec3d z = x.cross(y);
  plane = cv::Affine3d(cv::Matx33d(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]), mean);
  return values[1] > 1e-6 * values[0];
}

/** Both poses of the points as if they lay in their best plane. */
std::vector<cv::Affine3d> planarStarts(const std::vector<PointPair>& pairs, const Camera& camera)
{
  cv::Affine3d plane;
  if (!bestPlane(pairs, plane))
  {
    return {};
  }
  const cv::Affine3d to_plane = plane.inv();
  std::vector<cv::Point3d> flat;
  std::vector<cv::Point2d> pixels;
  for (const PointPair& pair : pairs)
  {
    const cv::Point3d point = to_plane * pair.point;
    flat.emplace_back(point.x, point.y, 0);
    pixels.push_back(pair.pixel);
  }
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::solvePnPGeneric(flat, camera.normalize(pixels), cv::Matx33d::eye(), cv::noArray(), turns, shifts, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<cv::Affine3d> starts;
  for (std::size_t i = 0; i < turns.size(); ++i)
  {
    const cv::Vec3d turn(turns[i].ptr<double>());
    const cv::Vec3d shift(shifts[i].ptr<double>());
    if (std::isfinite(cv::norm(turn)) && std::isfinite(cv::norm(shift)))
    {
      starts.push_back(cv::Affine3d(turn, shift) * to_plane);
    }
  }
  return starts;
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

bool isSame(const Pose& a, const Pose& b)
{
  const cv::Affine3d difference = a.camera_part.inv() * b.camera_part;
  return cv::norm(difference.rvec()) < SAME_TURN &&
         cv::norm(difference.translation()) < SAME_TURN * cv::norm(a.camera_part.translation());
}
}  // namespace

bool refinePose(const std::vector<PointPair>& pairs, const Camera& camera, Pose& pose)
{
  check(pairs);
  Problem problem(pairs, camera);
  double scale = 0;
  // Weights of Cauchy first: a target at a wrong place must not bend the pose until corners look like the outliers.
  for (int round = 0; round < REJECTIONS; ++round)
  {
    const std::vector<cv::Vec2d> residuals = problem.residuals(pose.camera_part);
    if (residuals.empty())
    {
      return false;
    }
    scale = robustScale(residuals);
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

std::vector<Pose> solvePose(const std::vector<PointPair>& pairs, const Camera& camera)
{
  check(pairs);
  std::vector<Pose> poses;
  for (const cv::Affine3d& start : planarStarts(pairs, camera))
  {
    Pose pose;
    pose.camera_part = start;
    if (refinePose(pairs, camera, pose) &&
        std::none_of(poses.begin(), poses.end(), [&](const Pose& known) { return isSame(known, pose); }))
    {
      poses.push_back(pose);
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
