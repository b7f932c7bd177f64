#include "clutter_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_canvas.h"

namespace omr
{
namespace
{
/** Draws on a plane of so many columns and rows; a column is one unit wide, and so is a row high. */
struct Sheet
{
  cv::Mat& canvas;
  cv::Matx33d to_fine;
  int columns, rows;
  cv::Scalar ink, paper;
  cv::RNG& random;

  void fill(double left, double top, double right, double bottom, const cv::Scalar& color) const
  {
    fillPolygon(canvas, rectangle(left, top, right, bottom), to_fine, color);
  }
  void disk(const cv::Point2d& center, double radius, const cv::Scalar& color) const
  {
    fillPolygon(canvas, circle(radius, center), to_fine, color);
  }
  /** Calls with the column and the row of each place. */
  template <typename Call>
  void forEachPlace(const Call& call) const
  {
    for (int y = 0; y < rows; ++y)
    {
      for (int x = 0; x < columns; ++x)
      {
        call(x, y);
      }
    }
  }
};

/** Woven stripes: three tones, of which the middle one is everywhere. */
void drawGingham(const Sheet& sheet)
{
  const cv::Scalar middle = (sheet.ink + sheet.paper) / 2;
  sheet.forEachPlace([&](int x, int y) {
    const int threads = x % 2 + y % 2;
    sheet.fill(x, y, x + 1, y + 1, threads == 0 ? sheet.paper : threads == 1 ? middle : sheet.ink);
  });
}

void drawDots(const Sheet& sheet)
{
  const double radius = sheet.random.uniform(.2, .45);
  sheet.forEachPlace([&](int x, int y) { sheet.disk({x + .5, y + .5}, radius, sheet.ink); });
}

/** Squares or windows that do not touch. */
void drawHoles(const Sheet& sheet)
{
  const double width = sheet.random.uniform(.3, .8);
  const double height = chance(sheet.random, .5) ? width : sheet.random.uniform(.3, .9);
  const double bar = chance(sheet.random, .3) ? .08 : 0;
  sheet.forEachPlace([&](int x, int y) {
    sheet.fill(x, y, x + width, y + height, sheet.ink);
    if (bar > 0)
    {
      sheet.fill(x, y + height / 2 - bar / 2, x + width, y + height / 2 + bar / 2, sheet.paper);
      sheet.fill(x + width / 2 - bar / 2, y, x + width / 2 + bar / 2, y + height, sheet.paper);
    }
  });
}

void drawStripes(const Sheet& sheet)
{
  const double width = sheet.random.uniform(.2, .7);
  for (int x = 0; x < sheet.columns; ++x)
  {
    sheet.fill(x, 0, x + width, sheet.rows, sheet.ink);
  }
}

/** Bars one way and the other. */
void drawGrille(const Sheet& sheet)
{
  const double width = sheet.random.uniform(.05, .3);
  const double step = sheet.random.uniform(1., 2.);
  for (int x = 0; x < sheet.columns; ++x)
  {
    sheet.fill(x, 0, x + width, sheet.rows, sheet.ink);
  }
  double y = 0;
  while (y < sheet.rows)
  {
    sheet.fill(0, y, sheet.columns, y + width, sheet.ink);
    y += step;
  }
}

/** Stones of about one colour with joints, each row shifted; tiles where the shift is none. */
void drawBricks(const Sheet& sheet)
{
  const double joint = sheet.random.uniform(.06, .25);
  const double length = sheet.random.uniform(1., 3.);
  const double shift = chance(sheet.random, .6) ? length / 2 : 0;
  const double spread = sheet.random.uniform(0., .4);
  for (int y = 0; y < sheet.rows; ++y)
  {
    for (double x = y % 2 * shift; x + length < sheet.columns; x += length)
    {
      const double tone = 1 + spread * sheet.random.uniform(-1., 1.);
      sheet.fill(x, y, x + length - joint, y + 1 - joint, sheet.ink * tone);
    }
  }
}

/** Lines of letters: a stem or a bow with strokes. */
void drawLettering(const Sheet& sheet)
{
  const double stroke = sheet.random.uniform(.12, .22);
  const double line = sheet.random.uniform(1.1, 1.8);
  for (double y = 0; y + 1 < sheet.rows; y += line)
  {
    for (double x = 0; x + .7 < sheet.columns; x += .8)
    {
      const int letter = sheet.random.uniform(0, 8);
      if (letter == 0)
      {
        continue;  // between two words
      }
      if (letter < 3)
      {
        sheet.disk({x + .35, y + .5}, .35, sheet.ink);
        sheet.disk({x + .35, y + .5}, .35 - stroke, sheet.paper);
      }
      else
      {
        sheet.fill(x, y, x + stroke, y + 1, sheet.ink);
      }
      for (int i = 0; i < letter % 4; ++i)
      {
        const double at = sheet.random.uniform(0, 3) * (1 - stroke) / 2;
        sheet.fill(x, y + at, x + .6, y + at + stroke, sheet.ink);
      }
      if (letter > 5)
      {
        sheet.fill(x + .6 - stroke, y, x + .6, y + 1, sheet.ink);
      }
    }
  }
}

/** Four-sided pieces of any shape, black or white by chance. */
void drawMosaic(const Sheet& sheet)
{
  const int across = sheet.columns + 1;
  std::vector<cv::Point2d> knots;
  for (int y = 0; y <= sheet.rows; ++y)
  {
    for (int x = 0; x <= sheet.columns; ++x)
    {
      const double right = sheet.random.uniform(-.4, .4);  // before down, whatever the compiler
      const double down = sheet.random.uniform(-.4, .4);
      knots.emplace_back(x + right, y + down);
    }
  }
  sheet.forEachPlace([&](int x, int y) {
    const int first = y * across + x;
    const cv::Scalar color = chance(sheet.random, .5) ? sheet.ink : sheet.paper;
    fillPolygon(sheet.canvas, {knots[first], knots[first + 1], knots[first + across + 1], knots[first + across]},
                sheet.to_fine, color);
  });
}

/** Disks with a hole or a core, side by side: two rings are no target. */
void drawBullsEyes(const Sheet& sheet)
{
  const double radius = sheet.random.uniform(.6, 1.4);
  const double core = radius * sheet.random.uniform(.3, .75);
  const double step = 2 * radius * sheet.random.uniform(1.05, 2.);
  for (double y = radius; y + radius < sheet.rows; y += step)
  {
    for (double x = radius; x + radius < sheet.columns; x += step)
    {
      sheet.disk({x, y}, radius, sheet.ink);
      sheet.disk({x, y}, core, sheet.paper);
    }
  }
}

/** A fan or a wheel. */
void drawSpokes(const Sheet& sheet)
{
  const int spokes = sheet.random.uniform(3, 16);
  const double radius = std::min(sheet.columns, sheet.rows) / 2.;
  const double share = sheet.random.uniform(.2, .7);
  const double hub = radius * sheet.random.uniform(.1, .4);
  const cv::Point2d center(sheet.columns / 2., sheet.rows / 2.);
  for (int i = 0; i < spokes; ++i)
  {
    const auto rim = [&](double turn) {
      return center + radius * cv::Point2d(std::cos(2 * CV_PI * turn), std::sin(2 * CV_PI * turn));
    };
    fillPolygon(sheet.canvas, {center, rim(1. * i / spokes), rim((i + share) / spokes)}, sheet.to_fine, sheet.ink);
  }
  sheet.disk(center, hub, sheet.ink);
}

constexpr std::array<void (*)(const Sheet&), 10> PATTERNS = {drawGingham,   drawDots,   drawHoles,     drawStripes,
                                                             drawGrille,    drawBricks, drawLettering, drawMosaic,
                                                             drawBullsEyes, drawSpokes};

/** A dark and a light colour, or any two. */
std::pair<cv::Scalar, cv::Scalar> twoColors(cv::RNG& random)
{
  const bool gray = chance(random, .5);
  const auto color = [&](double low, double high) {
    const double tone = random.uniform(low, high);
    const cv::Scalar any{random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
    return gray ? cv::Scalar::all(tone) : any;
  };
  const cv::Scalar dark = color(.01, .3);
  const cv::Scalar light = color(.25, .9);
  return chance(random, .7) ? std::make_pair(dark, light) : std::make_pair(light, dark);
}
}  // namespace

cv::Mat renderClutterScene(const cv::Mat& background, cv::RNG& random)
{
  cv::Mat canvas = fineBackground(background, random);
  const double unit = logUniform(random, 2.5, 40);
  const int columns = random.uniform(5, 25);
  const int rows = random.uniform(5, 25);
  const double extent = std::hypot(columns, rows) / 2;
  const cv::Point2d place{SCENE_SIZE.width * random.uniform(.4, .6), SCENE_SIZE.height * random.uniform(.4, .6)};
  const cv::Matx33d origin(1, 0, -columns / 2., 0, 1, -rows / 2., 0, 0, 1);
  const cv::Matx33d to_fine = toCanvas(randomView(place, unit, extent, random) * origin);
  const auto [ink, paper] = twoColors(random);
  const Sheet sheet = {canvas, to_fine, columns, rows, ink, paper, random};
  sheet.fill(-.5, -.5, columns + .5, rows + .5, paper);
  PATTERNS[random.uniform(0, static_cast<int>(PATTERNS.size()))](sheet);
  return photograph(canvas, unit, random);
}

}  // namespace omr
