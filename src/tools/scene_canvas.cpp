#include "scene_canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
constexpr int CIRCLE_POINTS = 64;
constexpr double GAMMA = 2.2;
/** Light on every pixel: a slope, and shadows with more or less hard edges. */
cv::Mat sunlight(const cv::Size& size, cv::RNG& random)
{
  cv::Mat light(size, CV_32FC1);
  const double slope = random.uniform(0., .5);
  const double direction = random.uniform(0., 2 * CV_PI);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      const double along = std::cos(direction) * (x - size.width / 2.) + std::sin(direction) * (y - size.height / 2.);
      light.at<float>(y, x) = static_cast<float>(1 + slope * along / size.width);
    }
  }
  const int shadows = chance(random, .5) ? 0 : random.uniform(1, 4);
  for (int i = 0; i < shadows; ++i)
  {
    std::vector<cv::Point> outline;
    outline.reserve(4);
    for (int corner = 0; corner < 4; ++corner)
    {
      const int x = random.uniform(-size.width / 4, size.width * 5 / 4);  // before y, whatever the compiler
      const int y = random.uniform(-size.height / 4, size.height * 5 / 4);
      outline.emplace_back(x, y);
    }
    cv::Mat shadow = cv::Mat::zeros(size, CV_32FC1);
    cv::fillConvexPoly(shadow, outline, cv::Scalar(random.uniform(.3, .85)));
    const int soft = 1 + 2 * random.uniform(1, 12);
    cv::blur(shadow, shadow, {soft, soft});
    light = light.mul(1 - shadow);
  }
  return light;
}
}  // namespace

double logUniform(cv::RNG& random, double min, double max)
{
  return min * std::pow(max / min, random.uniform(0., 1.));
}

bool chance(cv::RNG& random, double probability)
{
  return random.uniform(0., 1.) < probability;
}

cv::Mat fineBackground(const cv::Mat& background, cv::RNG& random)
{
  const double largest = std::min(background.cols / 4., background.rows / 3.);
  const double unit = logUniform(random, std::min(largest, 40.), largest);
  const cv::Size part(static_cast<int>(4 * unit), static_cast<int>(3 * unit));
  const cv::Rect place{random.uniform(0, background.cols - part.width + 1),
                       random.uniform(0, background.rows - part.height + 1), part.width, part.height};
  cv::Mat picture;
  cv::resize(background(place), picture, SCENE_SIZE, 0, 0,
             part.width > SCENE_SIZE.width ? cv::INTER_AREA : cv::INTER_CUBIC);
  if (chance(random, .5))
  {
    cv::flip(picture, picture, 1);
  }
  picture.convertTo(picture, CV_32F, 1 / 255.);
  cv::pow(picture, GAMMA, picture);
  cv::resize(picture, picture, SCENE_SIZE * SUPERSAMPLING, 0, 0, cv::INTER_LINEAR);
  return picture;
}

cv::Matx33d toCanvas(const cv::Matx33d& to_pixels)
{
  const double offset = (SUPERSAMPLING - 1) / 2.;
  return cv::Matx33d(SUPERSAMPLING, 0, offset, 0, SUPERSAMPLING, offset, 0, 0, 1) * to_pixels;
}

cv::Matx33d randomView(const cv::Point2d& place, double unit, double extent, cv::RNG& random)
{
  const double turn = chance(random, .4) ? random.uniform(-.15, .15) : random.uniform(0., 2 * CV_PI);
  const double tilt = std::acos(random.uniform(.45, 1.));
  const double direction = random.uniform(0., 2 * CV_PI);
  const double distance = random.uniform(3., 12.) * extent;  // [units]
  const auto turned = [](double angle) {
    return cv::Matx33d(std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1);
  };
  const cv::Matx33d tilted(unit * std::cos(tilt), 0, 0, 0, unit, 0, std::sin(tilt) / distance, 0, 1);
  const cv::Matx33d shifted(1, 0, place.x, 0, 1, place.y, 0, 0, 1);
  return shifted * turned(direction) * tilted * turned(turn - direction);
}

void fillPolygon(cv::Mat& canvas, const std::vector<cv::Point2d>& outline, const cv::Matx33d& to_fine,
                 const cv::Scalar& color)
{
  constexpr int SHIFT = 4;  // fractional bits of fillPoly
  std::vector<cv::Point2d> fine;
  cv::perspectiveTransform(outline, fine, to_fine);
  std::vector<cv::Point> points;
  points.reserve(fine.size());
  for (const cv::Point2d& point : fine)
  {
    points.emplace_back(cvRound(point.x * (1 << SHIFT)), cvRound(point.y * (1 << SHIFT)));
  }
  cv::fillPoly(canvas, std::vector<std::vector<cv::Point>>{points}, color, cv::LINE_8, SHIFT);
}

std::vector<cv::Point2d> rectangle(double left, double top, double right, double bottom)
{
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

std::vector<cv::Point2d> circle(double radius, const cv::Point2d& center)
{
  std::vector<cv::Point2d> outline;
  outline.reserve(CIRCLE_POINTS);
  for (int i = 0; i < CIRCLE_POINTS; ++i)
  {
    const double angle = 2 * CV_PI * i / CIRCLE_POINTS;
    outline.emplace_back(center.x + radius * std::cos(angle), center.y + radius * std::sin(angle));
  }
  return outline;
}

cv::Mat photograph(const cv::Mat& canvas, double unit, cv::RNG& random)
{
  cv::Mat light;
  cv::cvtColor(sunlight(canvas.size(), random), light, cv::COLOR_GRAY2BGR);
  const cv::Mat fine = canvas.mul(light);
  cv::Mat picture;
  cv::GaussianBlur(fine, picture, {0, 0}, SUPERSAMPLING * random.uniform(.3, std::min(2.5, .25 * unit)));
  cv::resize(picture, picture, SCENE_SIZE, 0, 0, cv::INTER_AREA);
  const double exposure = logUniform(random, .3, 1.3);
  const double haze = chance(random, .25) ? random.uniform(0., .3) : 0;
  const cv::Scalar tint{random.uniform(.8, 1.2), random.uniform(.95, 1.05), random.uniform(.8, 1.2)};
  cv::multiply(picture, tint * exposure, picture);
  picture = picture * (1 - haze) + cv::Scalar::all(haze);
  cv::min(picture, 1, picture);
  cv::pow(picture, 1 / GAMMA, picture);
  cv::Mat noise(picture.size(), CV_32FC3);
  random.fill(noise, cv::RNG::NORMAL, 0, random.uniform(.5, 6.) / 255);
  picture += noise;
  cv::Mat bytes;
  picture.convertTo(bytes, CV_8U, 255);
  if (chance(random, .5))
  {
    std::vector<uchar> code;
    cv::imencode(".jpg", bytes, code, {cv::IMWRITE_JPEG_QUALITY, random.uniform(50, 96)});
    bytes = cv::imdecode(code, cv::IMREAD_COLOR);
  }
  return bytes;
}
}  // namespace omr
