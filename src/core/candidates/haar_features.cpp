#include "outdoor_omr/haar_features.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "haar_blocks.h"
#include "haar_shifts.h"

namespace omr
{
namespace
{
constexpr int CELLS = WINDOW_CELLS * WINDOW_CELLS;

/** Least mean difference of neighbours in a quarter of the window [1/256 octave, three channels]: 1 % of all windows
 * with markers in the training scenes have less. */
constexpr int LEAST_CONTRAST = 20;

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

/** Whether each quarter of the window has contrast. All its neighbours count: squares may coincide with the blocks. */
bool hasContrast(const Plane& light)
{
  constexpr int HALF = WINDOW_CELLS / 2;
  constexpr int PAIRS = 2 * HALF * (HALF - 1);
  for (int top = 0; top < WINDOW_CELLS; top += HALF)
  {
    for (int left = 0; left < WINDOW_CELLS; left += HALF)
    {
      int contrast = 0;
      for (int i = 0; i < HALF; ++i)
      {
        for (int j = 1; j < HALF; ++j)
        {
          contrast += std::abs(light[top + i][left + j] - light[top + i][left + j - 1]);
          contrast += std::abs(light[top + j][left + i] - light[top + j - 1][left + i]);
        }
      }
      if (contrast < LEAST_CONTRAST * PAIRS)
      {
        return false;
      }
    }
  }
  return true;
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
  if (!hasContrast(window.light))
  {
    return false;
  }
  const HaarTables& tables = haarTables();
  std::array<float, HAAR_SHIFTS> differences = {};
  float contrast = 0;
  forEachShift([&](int dx, int dy) {
    float& difference = differences[shiftIndex(dx, dy)];
    difference = meanDifference(window.light, dx, dy);
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

  const int mean = total(window.light) / CELLS;
  float deviation = 0;
  float variance = 0;
  for (const auto& row : window.light)
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
  const Symmetry symmetry = symmetryOf(window.light, mean);
  for (int i = 0; i < BEST; ++i)
  {
    *next++ = symmetry.same[i] / contrast;
    *next++ = symmetry.negative[i] / contrast;
  }
  *next++ = meanDeviation(window.red) / contrast;
  *next++ = meanDeviation(window.blue) / contrast;

  for (int i = 0; i < HAAR_BLOCKS; ++i)
  {
    const HaarBlock light = blockOf(window.light, i / 4, i % 4);
    const HaarBlock red = blockOf(window.red, i / 4, i % 4);
    const HaarBlock blue = blockOf(window.blue, i / 4, i % 4);
    const int color = red.across + red.down + blue.across + blue.down;
    *next++ = static_cast<float>(light.sum - 4 * mean) / (4 * contrast);
    *next++ = static_cast<float>(red.sum) / (4 * OCTAVE);
    *next++ = static_cast<float>(blue.sum) / (4 * OCTAVE);
    *next++ = static_cast<float>(light.across) / (2 * contrast) - 1;
    *next++ = static_cast<float>(light.down) / (2 * contrast) - 1;
    *next++ = static_cast<float>(color) / (2 * contrast);
  }
  return true;
}

}  // namespace omr
