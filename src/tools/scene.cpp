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

void addNoise(cv::Mat& image, cv::RNG& random, double noise)
{
  cv::Mat deviation(image.size(), CV_16SC3);
  random.fill(deviation, cv::RNG::NORMAL, 0, noise);
  cv::Mat noisy;
  image.convertTo(noisy, CV_16SC3);
  noisy += deviation;
  noisy.convertTo(image, CV_8UC3);
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
  addNoise(image, random, noise);
  return image;
}

cv::Mat drawBoards(const cv::Size& size, const cv::Size& boards, const cv::Size& squares)
{
  cv::Mat image(size, CV_8UC3, cv::Scalar(110, 125, 120));
  const cv::Size cell(size.width / boards.width, size.height / boards.height);
  // A square's width of white around the board, half of one between the sheets.
  const int side =
      std::max(1, std::min(2 * cell.width / (2 * squares.width + 5), 2 * cell.height / (2 * squares.height + 5)));
  for (int board = 0; board < boards.area(); ++board)
  {
    const cv::Point center(board % boards.width * cell.width + cell.width / 2,
                           board / boards.width * cell.height + cell.height / 2);
    const cv::Point corner = center - cv::Point(squares.width * side / 2, squares.height * side / 2);
    cv::rectangle(image,
                  cv::Rect(corner.x - side, corner.y - side, (squares.width + 2) * side, (squares.height + 2) * side),
                  cv::Scalar(235, 235, 235), cv::FILLED);
    drawBoard(image, corner, squares, side);
  }
  cv::GaussianBlur(image, image, {0, 0}, 0.7);
  cv::RNG random(11);
  addNoise(image, random, 3);
  return image;
}

cv::Mat drawPaperShapes()
{
  constexpr int CELL = 200;
  cv::Mat image(1000, 1200, CV_8UC3, cv::Scalar(255, 255, 255));
  cv::RNG random(13);
  for (int shape = 0; shape < 30; ++shape)
  {
    const cv::Rect cell(shape % 6 * CELL, shape / 6 * CELL, CELL, CELL);
    cv::Mat place = image(cell);
    const cv::Scalar color(random.uniform(0, 200), random.uniform(0, 200), random.uniform(0, 200));
    if (shape % 3 == 0)
    {
      cv::circle(place, {CELL / 2, CELL / 2}, CELL / 2, color, cv::FILLED);
    }
    else if (shape % 3 == 1)
    {
      cv::rectangle(place, cv::Rect(CELL / 4, CELL / 4, CELL / 2, CELL / 2), color, cv::FILLED);
    }
    else
    {
      for (int blot = 0; blot < 40; ++blot)
      {
        cv::circle(place, {random.uniform(0, CELL), random.uniform(0, CELL)}, random.uniform(4, 16), color, cv::FILLED);
      }
    }
  }
  return image;
}

}  // namespace omr
