#include "render.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace test
{
namespace
{
constexpr int SUPERSAMPLING = 4;
constexpr int SHIFT = 8;  // fractional bits of OpenCV's polygon corners

std::vector<cv::Point> toCanvas(const std::vector<cv::Point2d>& outline)
{
  std::vector<cv::Point> points;
  for (const cv::Point2d& point : outline)
  {
    const cv::Point2d scaled((point.x + 0.5) * SUPERSAMPLING - 0.5, (point.y + 0.5) * SUPERSAMPLING - 0.5);
    points.emplace_back(cvRound(scaled.x * (1 << SHIFT)), cvRound(scaled.y * (1 << SHIFT)));
  }
  return points;
}

std::vector<cv::Point2d> rectangle(const cv::Matx33d& to_pixels, double x, double y, double width, double height)
{
  return {project(to_pixels, x, y), project(to_pixels, x + width, y), project(to_pixels, x + width, y + height),
          project(to_pixels, x, y + height)};
}
}  // namespace

cv::Point2d project(const cv::Matx33d& homography, double x, double y)
{
  const cv::Vec3d mapped = homography * cv::Vec3d(x, y, 1);
  return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
}

cv::Matx33d boardHomography(int rows, int cols, const cv::Point2d& center, double square_px, double turn_degrees,
                            double tilt_degrees)
{
  const double turn = turn_degrees * CV_PI / 180;
  const double tilt = tilt_degrees * CV_PI / 180;
  const double distance = 3. * std::max(rows, cols);  // squares, of a camera that sees 1 square as square_px there
  const cv::Matx33d to_middle(1, 0, -cols / 2., 0, 1, -rows / 2., 0, 0, 1);
  const cv::Matx33d turned(std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1);
  const cv::Matx33d tilted(std::cos(tilt), 0, 0, 0, 1, 0, std::sin(tilt) / distance, 0, 1);
  const cv::Matx33d to_image(square_px, 0, center.x, 0, square_px, center.y, 0, 0, 1);
  return to_image * tilted * turned * to_middle;
}

Render::Render(const cv::Size& size, const cv::Scalar& background)
    : size_(size), canvas_(size * SUPERSAMPLING, CV_32FC3, background)
{
}

void Render::addPolygon(const std::vector<cv::Point2d>& outline, const cv::Scalar& color)
{
  cv::fillPoly(canvas_, std::vector<std::vector<cv::Point>>{toCanvas(outline)}, color, cv::LINE_8, SHIFT);
}

void Render::addCircle(const cv::Point2d& center, double radius, const cv::Matx33d& to_pixels, const cv::Scalar& color)
{
  constexpr int CORNERS = 360;
  std::vector<cv::Point2d> outline;
  for (int i = 0; i < CORNERS; ++i)
  {
    const double angle = 2 * CV_PI * i / CORNERS;
    outline.push_back(project(to_pixels, center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)));
  }
  addPolygon(outline, color);
}

void Render::addBoard(int rows, int cols, const cv::Matx33d& to_pixels, bool first_black, double margin)
{
  addPolygon(rectangle(to_pixels, -margin, -margin, cols + 2 * margin, rows + 2 * margin), cv::Scalar::all(215));
  for (int i = 0; i < rows; ++i)
  {
    for (int j = 0; j < cols; ++j)
    {
      if (((i + j) % 2 == 0) == first_black)
      {
        addPolygon(rectangle(to_pixels, j, i, 1, 1), cv::Scalar::all(35));
      }
    }
  }
}

void Render::addShadow(const std::vector<cv::Point2d>& outline, double light)
{
  cv::Mat factor(canvas_.size(), CV_32FC3, cv::Scalar::all(1));
  cv::fillPoly(factor, std::vector<std::vector<cv::Point>>{toCanvas(outline)}, cv::Scalar::all(light), cv::LINE_8,
               SHIFT);
  cv::multiply(canvas_, factor, canvas_);
}

void Render::addLightGradient(double left, double right)
{
  cv::Mat line(1, canvas_.cols, CV_32FC3);
  for (int x = 0; x < canvas_.cols; ++x)
  {
    line.at<cv::Vec3f>(0, x) = cv::Vec3f::all(static_cast<float>(left + (right - left) * x / canvas_.cols));
  }
  cv::Mat factor;
  cv::repeat(line, canvas_.rows, 1, factor);
  cv::multiply(canvas_, factor, canvas_);
}

cv::Mat Render::picture(double blur, double noise, std::uint64_t seed) const
{
  cv::Mat light;
  cv::resize(canvas_, light, size_, 0, 0, cv::INTER_AREA);
  if (blur > 0)
  {
    cv::GaussianBlur(light, light, cv::Size(), blur, blur, cv::BORDER_REPLICATE);
  }
  cv::Mat grain(size_, CV_32FC3);
  cv::RNG random(seed);
  random.fill(grain, cv::RNG::NORMAL, 0, noise);
  cv::Mat picture;
  light += grain;
  light.convertTo(picture, CV_8UC3);
  return picture;
}

}  // namespace test
}  // namespace omr
