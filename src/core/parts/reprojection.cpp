#include "reprojection.h"

#include <cmath>
#include <opencv2/calib3d.hpp>

namespace omr
{
namespace
{
constexpr int MAX_STEPS = 30;       // of Levenberg-Marquardt; from IPPE 4 to 8 are needed
constexpr double CONVERGED = 1e-8;  // relative gain of a step: a thousandth of a standard deviation
constexpr double FLATTEST = 1e-6;   // squared ratio of a plane's extents, below which it is a line

cv::Matx33d cross(const cv::Vec3d& v)
{
  return {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
}

/** The plane that fits the points best: maps its coordinates (z across it) to theirs. @return false for a line. */
bool bestPlane(const std::vector<PointPair>& pairs, cv::Affine3d& plane)
{
  cv::Vec3d mean(0, 0, 0);
  for (const PointPair& pair : pairs)
  {
    mean += cv::Vec3d(pair.point) * (1.0 / static_cast<double>(pairs.size()));
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
  return values[1] > FLATTEST * values[0];
}
}  // namespace

cv::Point3d seenPoint(const cv::Affine3d& camera_part, const PointPair& pair)
{
  const cv::Point3d center = camera_part * pair.point;
  const cv::Vec3d axis = camera_part.rotation() * pair.circle;
  const cv::Vec3d shift = (axis[2] * axis - cv::Vec3d(0, 0, axis.dot(axis))) * (1 / center.z);
  return center + cv::Point3d(shift);
}

Reprojection::Reprojection(const std::vector<PointPair>& pairs, const Camera& camera) : pairs_(pairs), camera_(camera)
{
  weights_.assign(pairs.size(), 1);
}

std::vector<double>& Reprojection::weights()
{
  return weights_;
}

std::vector<cv::Vec2d> Reprojection::residuals(const cv::Affine3d& pose, std::vector<cv::Matx23d>* derivatives) const
{
  std::vector<cv::Point3d> points;
  points.reserve(pairs_.size());
  for (const PointPair& pair : pairs_)
  {
    points.push_back(seenPoint(pose, pair));
    if (!(points.back().z > 1e-6))
    {
      return {};
    }
  }
  const std::vector<cv::Point2d> projected = camera_.project(points, derivatives);
  std::vector<cv::Vec2d> result;
  result.reserve(pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
  {
    const cv::Point2d difference = pairs_[i].pixel - projected[i];
    result.emplace_back(difference.x / pairs_[i].sigma, difference.y / pairs_[i].sigma);
  }
  return result;
}

double Reprojection::cost(const std::vector<cv::Vec2d>& residuals) const
{
  double sum = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i)
  {
    sum += weights_[i] * residuals[i].dot(residuals[i]);
  }
  return sum;
}

Reprojection::Normal Reprojection::normal(const cv::Affine3d& pose) const
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

cv::Matx66d Reprojection::information(const cv::Affine3d& pose) const
{
  return normal(pose).hessian;
}

bool Reprojection::minimize(cv::Affine3d& pose) const
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

}  // namespace omr
