#include "marker_scene.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "scene_canvas.h"

namespace omr
{
namespace
{
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
}  // namespace

cv::Rect boxOf(const PlacedMarker& marker)
{
  std::vector<cv::Point2f> outline;
  const auto add = [&](double x, double y) {
    const cv::Vec3d at = marker.to_pixels * cv::Vec3d(x, y, 1);
    outline.emplace_back(static_cast<float>(at[0] / at[2]), static_cast<float>(at[1] / at[2]));
  };
  if (marker.kind == MarkerKind::checkerboard)
  {
    const cv::Size& squares = marker.squares;
    add(0, 0);
    add(squares.width, 0);
    add(squares.width, squares.height);
    add(0, squares.height);
  }
  else
  {
    constexpr int POINTS = 32;
    const auto radius = static_cast<double>(marker.colors.size());
    for (int i = 0; i < POINTS; ++i)
    {
      add(radius * std::cos(2 * CV_PI * i / POINTS), radius * std::sin(2 * CV_PI * i / POINTS));
    }
  }
  return cv::boundingRect(outline);
}

MarkerScene renderMarkerScene(const cv::Mat& background, cv::RNG& random)
{
  MarkerScene scene;
  cv::Mat canvas = fineBackground(background, random);
  const double unit = logUniform(random, 2.5, 24);
  const int grid = unit < 5 ? 3 : unit < 12 ? 2 : 1;  // places for markers in a row and a column
  for (int i = 0; i < grid * grid; ++i)
  {
    PlacedMarker marker;
    marker.kind = chance(random, .3) ? MarkerKind::checkerboard : MarkerKind::target;
    const bool board = marker.kind == MarkerKind::checkerboard;
    marker.squares = {random.uniform(5, 22), random.uniform(5, 22)};
    marker.colors = randomColors(random);
    const double extent =
        board ? std::hypot(marker.squares.width, marker.squares.height) / 2 : static_cast<double>(marker.colors.size());
    if (grid > 1 && extent * unit > SCENE_SIZE.height / (2. * grid))
    {
      continue;  // it would lie over its neighbours
    }
    const cv::Point cell(i % grid, i / grid);
    const cv::Point2d place{SCENE_SIZE.width * (cell.x + random.uniform(.4, .6)) / grid,
                            SCENE_SIZE.height * (cell.y + random.uniform(.4, .6)) / grid};
    const cv::Matx33d origin(1, 0, board ? -marker.squares.width / 2. : 0, 0, 1,
                             board ? -marker.squares.height / 2. : 0, 0, 0, 1);
    marker.to_pixels = randomView(place, unit, extent, random) * origin;
    const cv::Matx33d to_fine = toCanvas(marker.to_pixels);
    board ? drawCheckerboard(canvas, marker, to_fine, random) : drawTarget(canvas, marker, to_fine, random);
    scene.markers.push_back(marker);
  }
  scene.image = photograph(canvas, unit, random);
  return scene;
}

}  // namespace omr
