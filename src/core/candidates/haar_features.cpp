#include "outdoor_omr/haar_features.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "haar_blocks.h"
#include "haar_shifts.h"

namespace omr
{
namespace
{
constexpr int CELLS = WINDOW_CELLS * WINDOW_CELLS;

/** Least mean difference of neighbours in a quarter of the window [1/256 octave, three channels]. Of the held-out
 * windows with a checkerboard 0.5 % have less, with a target 0.7 %; 3.9 % in brightness alone. */
constexpr int LEAST_CONTRAST = 20;
constexpr int QUARTERS = 4;

/** Twice the points of symmetry that are tried, along each axis [cells]; the window's centre is at 7. */
constexpr int FIRST_CENTER = 5;
constexpr int LAST_CENTER = 9;
constexpr int BEST = 3;

/** One channel of a window. */
using Plane = std::array<std::array<int, WINDOW_CELLS>, WINDOW_CELLS>;

struct Window
{
  Plane light, red, blue;
};

Window readWindow(const cv::Mat& cells, const cv::Point& first)
{
  Window window;
  for (int y = 0; y < WINDOW_CELLS; ++y)
  {
    const auto* row = cells.ptr<cv::Vec3s>(first.y + y) + first.x;
    for (int x = 0; x < WINDOW_CELLS; ++x)
    {
      window.light[y][x] = row[x][0];
      window.red[y][x] = row[x][1];
      window.blue[y][x] = row[x][2];
    }
  }
  return window;
}

HaarBlock blockOf(const Plane& plane, int row, int col)
{
  return haarBlock(plane[2 * row][2 * col], plane[2 * row][2 * col + 1], plane[2 * row + 1][2 * col],
                   plane[2 * row + 1][2 * col + 1]);
}

/** Of each quarter of a plane the sum of the differences of neighbours. All of them count: squares may coincide with
 * the blocks. */
std::array<int, QUARTERS> contrastOfQuarters(const Plane& plane)
{
  constexpr int HALF = WINDOW_CELLS / 2;
  std::array<int, QUARTERS> contrast = {};
  for (int quarter = 0; quarter < QUARTERS; ++quarter)
  {
    const int top = quarter / 2 * HALF;
    const int left = quarter % 2 * HALF;
    for (int i = 0; i < HALF; ++i)
    {
      for (int j = 1; j < HALF; ++j)
      {
        contrast[quarter] += std::abs(plane[top + i][left + j] - plane[top + i][left + j - 1]);
        contrast[quarter] += std::abs(plane[top + j][left + i] - plane[top + j - 1][left + i]);
      }
    }
  }
  return contrast;
}

/** The Haar responses of a block in colour. */
int colorOf(const Window& window, int row, int col)
{
  const HaarBlock red = blockOf(window.red, row, col);
  const HaarBlock blue = blockOf(window.blue, row, col);
  return red.across + red.down + blue.across + blue.down;
}

/** Whether each quarter of the window has contrast, in brightness or in the colours of its blocks. @param light
 * contrastOfQuarters(). */
bool hasContrast(const Window& window, std::array<int, QUARTERS> light)
{
  constexpr int HALF = WINDOW_CELLS / 2;
  constexpr int PAIRS = 2 * HALF * (HALF - 1);
  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    light[i / 8 * 2 + i % 4 / 2] += colorOf(window, i / 4, i % 4);
  }
  return *std::min_element(light.begin(), light.end()) >= LEAST_CONTRAST * PAIRS;
}

/** The plane with the most contrast: pale rings differ in colour alone. */
const Plane& mainPlane(const Window& window, const std::array<int, QUARTERS>& light)
{
  const auto sum = [](const std::array<int, QUARTERS>& quarters) {
    return std::accumulate(quarters.begin(), quarters.end(), 0);
  };
  const int of_light = sum(light);
  const int of_red = sum(contrastOfQuarters(window.red));
  const int of_blue = sum(contrastOfQuarters(window.blue));
  if (of_light >= std::max(of_red, of_blue))
  {
    return window.light;
  }
  return of_red >= of_blue ? window.red : window.blue;
}

int total(const Plane& plane)
{
  int sum = 0;
  for (const auto& row : plane)
  {
    for (const int value : row)
    {
      sum += value;
    }
  }
  return sum;
}

/** Mean |difference| of the cells that are a shift apart. */
float meanDifference(const Plane& light, int dx, int dy)
{
  int sum = 0;
  for (int y = std::max(0, -dy); y < WINDOW_CELLS - std::max(0, dy); ++y)
  {
    for (int x = 0; x < WINDOW_CELLS - dx; ++x)
    {
      sum += std::abs(light[y + dy][x + dx] - light[y][x]);
    }
  }
  return static_cast<float>(sum) / static_cast<float>((WINDOW_CELLS - dx) * (WINDOW_CELLS - std::abs(dy)));
}

/** A black square's neighbours along u and v are white, those along u + v and u - v are black. */
float largestCrossing(const std::array<float, HAAR_SHIFTS>& differences)
{
  float along = 0;
  float diagonal = 1;
  for (const HaarTables::Crossing& crossing : haarTables().crossings)
  {
    const float a = differences[crossing.first] + differences[crossing.second];
    const float d = differences[crossing.sum] + differences[crossing.difference];
    if (a * diagonal > along * d)
    {
      along = a;
      diagonal = d;
    }
  }
  return (along - diagonal) / (along + diagonal);
}

/** Keeps the smallest values, ascending. */
void keepSmallest(std::array<float, BEST>& smallest, float value)
{
  for (float& kept : smallest)
  {
    if (value < kept)
    {
      std::swap(value, kept);
    }
  }
}

struct Symmetry
{
  std::array<float, BEST> same = {1e9F, 1e9F, 1e9F};
  std::array<float, BEST> negative = {1e9F, 1e9F, 1e9F};
};

/** @param mean of the window. */
Symmetry symmetryOf(const Plane& light, int mean)
{
  Symmetry symmetry;
  for (int cy = FIRST_CENTER; cy <= LAST_CENTER; ++cy)
  {
    for (int cx = FIRST_CENTER; cx <= LAST_CENTER; ++cx)
    {
      int same = 0;
      int negative = 0;
      int count = 0;
      for (int y = std::max(0, cy - 7); y <= std::min(7, cy); ++y)
      {
        for (int x = std::max(0, cx - 7); x <= std::min(7, cx); ++x)
        {
          same += std::abs(light[y][x] - light[cy - y][cx - x]);
          negative += std::abs(light[y][x] + light[cy - y][cx - x] - 2 * mean);
          ++count;
        }
      }
      keepSmallest(symmetry.same, static_cast<float>(same) / static_cast<float>(count));
      keepSmallest(symmetry.negative, static_cast<float>(negative) / static_cast<float>(count));
    }
  }
  return symmetry;
}

float meanDeviation(const Plane& plane)
{
  const int mean = total(plane) / CELLS;
  int sum = 0;
  for (const auto& row : plane)
  {
    for (const int value : row)
    {
      sum += std::abs(value - mean);
    }
  }
  return static_cast<float>(sum) / CELLS;
}

}  // namespace

bool haarFeatures(const cv::Mat& cells, const cv::Point& first, float* features)
{
  const Window window = readWindow(cells, first);
  const std::array<int, QUARTERS> quarters = contrastOfQuarters(window.light);
  if (!hasContrast(window, quarters))
  {
    return false;
  }
  const Plane& main = mainPlane(window, quarters);
  const HaarTables& tables = haarTables();
  std::array<float, HAAR_SHIFTS> differences = {};
  float contrast = 0;
  forEachShift([&](int dx, int dy) {
    float& difference = differences[shiftIndex(dx, dy)];
    difference = meanDifference(main, dx, dy);
    contrast += difference;
  });
  contrast /= HAAR_SHIFTS;
  for (int i = 0; i < HAAR_SHIFTS; ++i)
  {
    features[i] = differences[tables.by_length[i]] / contrast - 1;
  }
  for (std::size_t band = 0; band + 1 < tables.bands.size(); ++band)
  {
    std::sort(features + tables.bands[band], features + tables.bands[band + 1]);
  }
  float* next = features + HAAR_SHIFTS;
  *next++ = largestCrossing(differences);
  *next++ = contrast / OCTAVE;

  const int mean = total(main) / CELLS;
  float deviation = 0;
  float variance = 0;
  for (const auto& row : main)
  {
    for (const int value : row)
    {
      const float relative = static_cast<float>(value - mean) / contrast;
      deviation += std::abs(relative);
      variance += relative * relative;
    }
  }
  *next++ = deviation / CELLS;
  *next++ = variance / CELLS;
  const Symmetry symmetry = symmetryOf(main, mean);
  for (int i = 0; i < BEST; ++i)
  {
    *next++ = symmetry.same[i] / contrast;
    *next++ = symmetry.negative[i] / contrast;
  }
  *next++ = meanDeviation(window.red) / contrast;
  *next++ = meanDeviation(window.blue) / contrast;

  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    const int row = i / 4;
    const int col = i % 4;
    const HaarBlock light = blockOf(main, row, col);
    *next++ = static_cast<float>(light.sum - 4 * mean) / (4 * contrast);
    *next++ = static_cast<float>(blockOf(window.red, row, col).sum) / (4 * OCTAVE);
    *next++ = static_cast<float>(blockOf(window.blue, row, col).sum) / (4 * OCTAVE);
    *next++ = static_cast<float>(light.across) / (2 * contrast) - 1;
    *next++ = static_cast<float>(light.down) / (2 * contrast) - 1;
    *next++ = static_cast<float>(colorOf(window, row, col)) / (2 * contrast);
  }
  for (const auto& row : main)
  {
    for (const int value : row)
    {
      *next++ = static_cast<float>(value - mean) / contrast;
    }
  }
  return true;
}

}  // namespace omr
