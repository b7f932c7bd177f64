#include "part_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace test
{
CameraInfo cameraInfo(const std::string& model)
{
  CameraInfo info;
  info.width = 1920;
  info.height = 1080;
  info.distortion_model = model;
  info.K = {1600, 0, 950, 0, 1605, 530, 0, 0, 1};
  info.P = {1500, 0, 955, 0, 0, 1500, 535, 0, 0, 0, 1, 0};
  if (model == "plumb_bob")
  {
    info.D = {-0.2, 0.1, 0.001, -0.0005, -0.02};
  }
  else if (model == "rational_polynomial")
  {
    info.D = {0.3, 0.1, 0.001, -0.0005, 0.02, 0.5, 0.1, 0.01};
  }
  else
  {
    info.D = {-0.02, 0.01, -0.005, 0.001};
  }
  return info;
}

cv::Affine3d poseAt(double x, double y, double z, double tilt_x, double tilt_y, double turn)
{
  const double degree = CV_PI / 180;
  const cv::Affine3d about_x(cv::Vec3d(tilt_x * degree, 0, 0));
  const cv::Affine3d about_y(cv::Vec3d(0, tilt_y * degree, 0));
  const cv::Affine3d about_z(cv::Vec3d(0, 0, turn * degree));
  return cv::Affine3d((about_x * about_y * about_z).rotation(), cv::Vec3d(x, y, z));
}

PartCheckerboard flatBoard(int rows, int cols, double square)
{
  PartCheckerboard board;
  board.rows = rows;
  board.cols = cols;
  board.square = square;
  board.pose = cv::Affine3d::Identity();
  return board;
}

std::vector<cv::RotatedRect> ringsOf(const PartTarget& target, const cv::Affine3d& camera_part, const Camera& camera)
{
  constexpr int POINTS = 100;
  std::vector<cv::RotatedRect> rings;
  for (std::size_t ring = 1; ring <= target.colors.size(); ++ring)
  {
    std::vector<cv::Point3d> circle;
    for (int i = 0; i < POINTS; ++i)
    {
      const double angle = 2 * CV_PI * i / POINTS;
      const cv::Point3d ray(std::cos(angle), std::sin(angle), 0);
      circle.push_back(camera_part * (target.center + ray * (target.ring * static_cast<double>(ring))));
    }
    const std::vector<cv::Point2d> pixels = camera.project(circle);
    rings.push_back(cv::fitEllipse(std::vector<cv::Point2f>(pixels.begin(), pixels.end())));
  }
  return rings;
}

PartView::PartView(const Camera& camera, double noise_px, std::uint64_t seed)
    : camera_(camera), noise_px_(noise_px), random_(seed)
{
}

cv::Point2d PartView::see(const cv::Point3d& point, const cv::Affine3d& camera_part)
{
  const cv::Point2d pixel = camera_.project({camera_part * point}).front();
  return pixel + cv::Point2d(random_.gaussian(noise_px_), random_.gaussian(noise_px_));
}

void PartView::add(const PartCheckerboard& board, const cv::Affine3d& camera_part, bool half_turn)
{
  addSection(board, camera_part, cv::Rect(0, 0, board.cols, board.rows));
  Checkerboard& seen = checkerboards.back();
  seen.size_certain = true;
  if (half_turn)
  {
    std::reverse(seen.inner_corners.begin(), seen.inner_corners.end());
  }
}

void PartView::addSection(const PartCheckerboard& board, const cv::Affine3d& camera_part, const cv::Rect& squares)
{
  const std::vector<cv::Point3d> corners = innerCorners(board);
  Checkerboard seen;
  seen.rows = squares.height;
  seen.cols = squares.width;
  seen.size_certain = false;
  for (int row = squares.y; row < squares.y + squares.height - 1; ++row)
  {
    for (int col = squares.x; col < squares.x + squares.width - 1; ++col)
    {
      seen.inner_corners.emplace_back(see(corners[row * (board.cols - 1) + col], camera_part));
    }
  }
  seen.inner_corners_seen.assign(seen.inner_corners.size(), true);
  checkerboards.push_back(seen);
}

void PartView::add(const PartTarget& target, const cv::Affine3d& camera_part, const std::string& colors)
{
  Target seen;
  seen.colors = colors.empty() ? target.colors : colors;
  seen.center = see(target.center, camera_part);
  seen.rings = ringsOf(target, camera_part, camera_);
  seen.outermost_deviation = 0.01;
  const cv::Point2d noise = seen.center - camera_.project({camera_part * target.center}).front();
  for (cv::RotatedRect& ring : seen.rings)
  {
    ring.center += cv::Point2f(noise);
  }
  targets.push_back(seen);
}

void PartView::add(const Part& part, const cv::Affine3d& camera_part, bool half_turn)
{
  for (const PartCheckerboard& board : part.checkerboards)
  {
    add(board, camera_part, half_turn);
  }
  for (const PartTarget& target : part.targets)
  {
    add(target, camera_part);
  }
}

}  // namespace test
}  // namespace omr
