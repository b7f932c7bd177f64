#include "radial_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "homography_fit.h"
#include "lattice.h"

namespace omr
{
namespace
{
// Points are taken around the middle of the picture, in units of its radius.

cv::Point2d undistort(const cv::Point2d& point, double distortion)
{
  return point / (1 - distortion * point.dot(point));
}

cv::Point2d distort(const cv::Point2d& point, double distortion)
{
  return point * (2 / (1 + std::sqrt(1 + 4 * distortion * point.dot(point))));
}

/** A lattice's corners, and how well a distortion and the best homography describe them. */
struct Corners
{
  std::vector<cv::Point2d> places;
  std::vector<cv::Point2d> points;

  /** Root mean square of the residuals. Infinite where nothing fits. */
  double residual(double distortion, cv::Matx33d& homography) const
  {
    std::vector<cv::Point2d> straight;
    std::vector<double> weights;
    straight.reserve(points.size());
    weights.reserve(points.size());
    for (const cv::Point2d& point : points)
    {
      const double shrunk = distortion * point.dot(point);
      straight.push_back(undistort(point, distortion));
      const double rest = 1 - shrunk;
      weights.push_back(rest * rest * rest / (1 + shrunk));  // of the stretch's area: residuals are the picture's
    }
    if (!fitHomography(places, straight, weights, homography))
    {
      return std::numeric_limits<double>::infinity();
    }
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const cv::Point2d offset = distort(mapPoint(homography, places[i]), distortion) - points[i];
      sum += offset.dot(offset);
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
  }

  /** The distortion that fits best, steps first, since there may be two: the residual is smooth between. */
  double bestDistortion() const
  {
    constexpr double MAX_SHRUNK = 0.9;  // 1 is a right angle to the lens
    constexpr int STEPS = 12;
    constexpr int HALVINGS = 6;
    double farthest = 1e-6;
    for (const cv::Point2d& point : points)
    {
      farthest = std::max(farthest, point.dot(point));
    }
    const double limit = MAX_SHRUNK / farthest;
    cv::Matx33d homography;
    double best = 0;
    double least = residual(0, homography);
    const auto consider = [&](double distortion) {
      const double value = distortion < 0 || distortion > limit ? least : residual(distortion, homography);
      if (value < least)
      {
        least = value;
        best = distortion;
      }
    };
    double step = limit / STEPS;
    for (int i = 1; i <= STEPS; ++i)
    {
      consider(i * step);
    }
    for (int i = 0; i < HALVINGS; ++i)
    {
      step /= 2;
      const double middle = best;
      consider(middle - step);
      consider(middle + step);
    }
    return best;
  }
};
}  // namespace

cv::Point2d RadialModel::place(int row, int col) const
{
  return {(col - col_) / scale_, (row - row_) / scale_};
}

bool RadialModel::fit(const Lattice& lattice, const cv::Size& picture)
{
  constexpr double MAX_RESIDUAL = 0.1;  // squares; with 0.06 and 0.2 fewer boards in wide lenses
  const cv::Rect& box = lattice.box;
  center_ = {(picture.width - 1) / 2., (picture.height - 1) / 2.};
  radius_ = cv::norm(center_);
  row_ = box.y + (box.height - 1) / 2.;
  col_ = box.x + (box.width - 1) / 2.;
  scale_ = std::max({box.width, box.height, 2}) / 2.;
  Corners corners;
  for (int i = box.y; i < box.br().y; ++i)
  {
    for (int j = box.x; j < box.br().x; ++j)
    {
      if (lattice.found(i, j))
      {
        corners.places.push_back(place(i, j));
        corners.points.push_back((cv::Point2d(lattice.at(i, j).position) - center_) / radius_);
      }
    }
  }
  distortion_ = corners.bestDistortion();
  return radius_ * corners.residual(distortion_, homography_) < MAX_RESIDUAL * squareHeight(lattice.seedFrame());
}

bool RadialModel::at(int row, int col, cv::Point2d& position) const
{
  const cv::Point2d node = place(row, col);
  const cv::Vec3d mapped = homography_ * cv::Vec3d(node.x, node.y, 1);
  position = center_ + radius_ * distort({mapped[0] / mapped[2], mapped[1] / mapped[2]}, distortion_);
  return mapped[2] > 0;
}

bool RadialModel::frameAt(int row, int col, LocalFrame& frame) const
{
  cv::Point2d node;
  cv::Point2d left;
  cv::Point2d right;
  cv::Point2d above;
  cv::Point2d below;
  if (!at(row, col, node) || !at(row, col - 1, left) || !at(row, col + 1, right) || !at(row - 1, col, above) ||
      !at(row + 1, col, below))
  {
    return false;
  }
  frame = {node, (right - left) / 2, (below - above) / 2};
  return true;
}

}  // namespace omr
