#include "scene.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
void drawBoard(cv::Mat& image, const cv::Point& corner, const cv::Size& squares, int side)
{
  for (int row = 0; row < squares.height; ++row)
  {
    for (int col = 0; col < squares.width; ++col)
    {
      const cv::Scalar color = (row + col) % 2 == 0 ? cv::Scalar(20, 20, 20) : cv::Scalar(235, 235, 235);
      cv::rectangle(image, cv::Rect(corner.x + col * side, corner.y + row * side, side, side), color, cv::FILLED);
    }
  }
}
}  // namespace

cv::Mat drawScene(const cv::Size& size, double noise)
{
  const std::vector<cv::Scalar> colors = {{255, 255, 255}, {0, 0, 0}, {20, 20, 220}, {20, 200, 20}, {220, 30, 20}};
  cv::Mat image(size, CV_8UC3, cv::Scalar(150, 160, 155));
  cv::RNG random(7);
  const auto any_color = [&] { return colors[random.uniform(0, static_cast<int>(colors.size()))]; };
  const auto any_point = [&] { return cv::Point(random.uniform(0, size.width), random.uniform(0, size.height)); };
  const auto scaled = [&](int length) { return std::max(1, length * size.width / 1920); };
  drawBoard(image, {scaled(100), scaled(120)}, {21, 15}, scaled(24));
  drawBoard(image, {scaled(800), scaled(500)}, {9, 7}, scaled(40));
  drawBoard(image, {scaled(1400), scaled(80)}, {7, 5}, scaled(30));
  for (int target = 0; target < 14; ++target)
  {
    const cv::Point center = any_point();
    for (int ring = 5; ring > 0; --ring)
    {
      cv::circle(image, center, scaled(12 * ring), any_color(), cv::FILLED, cv::LINE_AA);
    }
  }
  for (int line = 0; line < 40; ++line)
  {
    const cv::Point from = any_point();
    cv::line(image, from, any_point(), any_color(), scaled(3), cv::LINE_AA);
  }
  cv::Mat deviation(size, CV_16SC3);
  random.fill(deviation, cv::RNG::NORMAL, 0, noise);
  cv::Mat noisy;
  image.convertTo(noisy, CV_16SC3);
  noisy += deviation;
  noisy.convertTo(image, CV_8UC3);
  return image;
}

}  // namespace omr
