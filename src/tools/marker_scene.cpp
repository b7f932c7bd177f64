#include "marker_scene.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace omr
{
namespace
{
const cv::Size SCENE_SIZE(480, 360);
constexpr int SUPERSAMPLING = 3;
constexpr int CIRCLE_POINTS = 64;
constexpr double GAMMA = 2.2;

double logUniform(cv::RNG& random, double min, double max)
{
  return min * std::pow(max / min, random.uniform(0., 1.));
}

bool chance(cv::RNG& random, double probability)
{
  return random.uniform(0., 1.) < probability;
}

cv::Scalar ink(char letter, cv::RNG& random)
{
  const double fade = random.uniform(0., .06);
  const double strength = random.uniform(.8, 1.2);
  const auto shade = [&](double b, double g, double r) {
    return cv::Scalar(std::min(1., b * strength + fade), std::min(1., g * strength + fade),
                      std::min(1., r * strength + fade));
  };
  switch (letter)
  {
    case 'P':
      return shade(.03, .03, .03);
    case 'R':
      return shade(.06, .05, .6);
    case 'G':
      return shade(.1, .4, .07);
    case 'B':
      return shade(.45, .12, .06);
    default:
      return shade(.8, .8, .8);
  }
}

/** A random part of the background in linear light, at the fine scale. */
cv::Mat fineBackground(const cv::Mat& background, cv::RNG& random)
{
  const double largest = std::min(background.cols / 4., background.rows / 3.);
  const double unit = logUniform(random, std::min(largest, 40.), largest);
  const cv::Size part(static_cast<int>(4 * unit), static_cast<int>(3 * unit));
  const cv::Rect place(random.uniform(0, background.cols - part.width + 1),
                       random.uniform(0, background.rows - part.height + 1), part.width, part.height);
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

/** A view of the plane with its origin at a point of the picture; unit is the size of a square or ring there [px]. */
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

std::vector<cv::Point2d> circle(double radius)
{
  std::vector<cv::Point2d> outline;
  outline.reserve(CIRCLE_POINTS);
  for (int i = 0; i < CIRCLE_POINTS; ++i)
  {
    const double angle = 2 * CV_PI * i / CIRCLE_POINTS;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

void drawCheckerboard(cv::Mat& canvas, const PlacedMarker& board, const cv::Matx33d& to_fine, cv::RNG& random)
{
  const cv::Size squares = board.squares;
  const double margin = random.uniform(0., 1.5);
  const cv::Scalar white = ink('W', random);
  const cv::Scalar black = ink('P', random);
  const int parity = random.uniform(0, 2);
  fillPolygon(canvas, rectangle(-margin, -margin, squares.width + margin, squares.height + margin), to_fine, white);
  for (int y = 0; y < squares.height; ++y)
  {
    for (int x = 0; x < squares.width; ++x)
    {
      if ((x + y) % 2 == parity)
      {
        fillPolygon(canvas, rectangle(x, y, x + 1, y + 1), to_fine, black);
      }
    }
  }
}

void drawTarget(cv::Mat& canvas, const PlacedMarker& target, const cv::Matx33d& to_fine, cv::RNG& random)
{
  const int rings = static_cast<int>(target.colors.size());
  if (chance(random, .8))
  {
    const double half = rings * random.uniform(1.05, 1.5);
    fillPolygon(canvas, rectangle(-half, -half, half, half), to_fine, ink('W', random));
  }
  for (int ring = rings; ring > 0; --ring)
  {
    fillPolygon(canvas, circle(ring), to_fine, ink(target.colors[ring - 1], random));
  }
}

std::string randomColors(cv::RNG& random)
{
  const std::string letters = "WPRGB";
  std::string colors;
  for (int ring = random.uniform(3, 8); ring > 0; --ring)
  {
    char letter = 0;
    do
    {
      letter = letters[random.uniform(0, static_cast<int>(letters.size()))];
    } while (!colors.empty() && letter == colors.back());
    colors += letter;
  }
  return colors;
}

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
      outline.emplace_back(random.uniform(-size.width / 4, size.width * 5 / 4),
                           random.uniform(-size.height / 4, size.height * 5 / 4));
    }
    cv::Mat shadow = cv::Mat::zeros(size, CV_32FC1);
    cv::fillConvexPoly(shadow, outline, cv::Scalar(random.uniform(.3, .85)));
    const int soft = 1 + 2 * random.uniform(1, 12);
    cv::blur(shadow, shadow, {soft, soft});
    light = light.mul(1 - shadow);
  }
  return light;
}

/** What camera and file make of linear light. */
cv::Mat photograph(const cv::Mat& fine, double unit, cv::RNG& random)
{
  cv::Mat picture;
  cv::GaussianBlur(fine, picture, {0, 0}, SUPERSAMPLING * random.uniform(.3, std::min(2.5, .25 * unit)));
  cv::resize(picture, picture, SCENE_SIZE, 0, 0, cv::INTER_AREA);
  const double exposure = logUniform(random, .3, 1.3);
  const double haze = chance(random, .25) ? random.uniform(0., .3) : 0;
  const cv::Scalar tint(random.uniform(.8, 1.2), random.uniform(.95, 1.05), random.uniform(.8, 1.2));
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
}  // namespace

MarkerScene renderMarkerScene(const cv::Mat& background, cv::RNG& random)
{
  MarkerScene scene;
  cv::Mat canvas = fineBackground(background, random);
  const double unit = logUniform(random, 2.5, 24);
  const int grid = unit < 7 ? 2 : 1;  // places for markers in a row and a column
  for (int i = 0; i < grid * grid; ++i)
  {
    PlacedMarker marker;
    marker.kind = chance(random, .3) ? MarkerKind::checkerboard : MarkerKind::target;
    const bool board = marker.kind == MarkerKind::checkerboard;
    marker.squares = {random.uniform(5, 22), random.uniform(5, 22)};
    marker.colors = randomColors(random);
    const double extent =
        board ? std::hypot(marker.squares.width, marker.squares.height) / 2 : static_cast<double>(marker.colors.size());
    if (grid > 1 && extent * unit > SCENE_SIZE.height / 4.)
    {
      continue;  // it would lie over its neighbours
    }
    const cv::Point cell(i % grid, i / grid);
    const cv::Point2d place(SCENE_SIZE.width * (cell.x + random.uniform(.4, .6)) / grid,
                            SCENE_SIZE.height * (cell.y + random.uniform(.4, .6)) / grid);
    const cv::Matx33d origin(1, 0, board ? -marker.squares.width / 2. : 0, 0, 1,
                             board ? -marker.squares.height / 2. : 0, 0, 0, 1);
    marker.to_pixels = randomView(place, unit, extent, random) * origin;
    // The centre of the top-left pixel is (0, 0), also of the fine picture.
    const double offset = (SUPERSAMPLING - 1) / 2.;
    const cv::Matx33d to_fine =
        cv::Matx33d(SUPERSAMPLING, 0, offset, 0, SUPERSAMPLING, offset, 0, 0, 1) * marker.to_pixels;
    board ? drawCheckerboard(canvas, marker, to_fine, random) : drawTarget(canvas, marker, to_fine, random);
    scene.markers.push_back(marker);
  }
  cv::Mat light;
  cv::cvtColor(sunlight(canvas.size(), random), light, cv::COLOR_GRAY2BGR);
  scene.image = photograph(canvas.mul(light), unit, random);
  return scene;
}

}  // namespace omr
