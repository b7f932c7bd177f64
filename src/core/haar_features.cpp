#include "outdoor_omr/haar_features.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace omr
{
namespace
{
constexpr int CELLS = WINDOW_CELLS * WINDOW_CELLS;
constexpr int OCTAVE = 256;

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

/** Of a block of 2 x 2 cells: the sum, and the Haar responses across and down. */
struct Block
{
  int sum, across, down;
};

Block blockOf(const Plane& plane, int row, int col)
{
  const int a = plane[2 * row][2 * col];
  const int b = plane[2 * row][2 * col + 1];
  const int c = plane[2 * row + 1][2 * col];
  const int d = plane[2 * row + 1][2 * col + 1];
  return {a + b + c + d, std::abs(a - b) + std::abs(c - d), std::abs(a - c) + std::abs(b - d)};
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

/** Number of a shift, or of its opposite, in the order in which they are measured; -1 if it is none. */
int shiftIndex(int dx, int dy)
{
  if (dx < 0 || (dx == 0 && dy < 0))
  {
    return shiftIndex(-dx, -dy);
  }
  if (dx > 4 || std::abs(dy) > 4 || (dx == 0 && dy == 0))
  {
    return -1;
  }
  return dx == 0 ? dy - 1 : 4 + (dx - 1) * 9 + dy + 4;
}

/** Calls with (dx, dy) in the order of shiftIndex(). */
template <typename Call>
void forEachShift(const Call& call)
{
  for (int dx = 0; dx <= 4; ++dx)
  {
    for (int dy = dx == 0 ? 1 : -4; dy <= 4; ++dy)
    {
      call(dx, dy);
    }
  }
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

/** Adds two crossing shifts, in whatever order, once. */
void addCrossing(int first, int second, int sum, int difference, std::vector<HaarTables::Crossing>& crossings)
{
  const auto byte = [](int index) { return static_cast<std::uint8_t>(index); };
  const HaarTables::Crossing crossing = {byte(std::min(first, second)), byte(std::max(first, second)), byte(sum),
                                         byte(difference)};
  const bool known = std::any_of(crossings.begin(), crossings.end(), [&](const HaarTables::Crossing& other) {
    return other.first == crossing.first && other.second == crossing.second;
  });
  if (!known)
  {
    crossings.push_back(crossing);
  }
}

HaarTables makeTables()
{
  HaarTables tables;
  for (std::size_t i = 0; i < tables.logarithm.size(); ++i)
  {
    tables.logarithm[i] = static_cast<std::int16_t>(std::lround(OCTAVE * std::log2(1 + static_cast<double>(i) / 96)));
  }
  const std::array<int, 5> longest = {2, 8, 13, 20, 32};  // squares of lengths
  int count = 0;
  for (std::size_t band = 0; band < longest.size(); ++band)
  {
    tables.bands[band] = static_cast<std::uint8_t>(count);
    forEachShift([&](int dx, int dy) {
      const int length = dx * dx + dy * dy;
      if (length <= longest[band] && (band == 0 || length > longest[band - 1]))
      {
        tables.by_length[count++] = static_cast<std::uint8_t>(shiftIndex(dx, dy));
      }
    });
  }
  tables.bands[longest.size()] = static_cast<std::uint8_t>(count);
  // Squares of up to 3 cells, seen at up to 60 degrees.
  forEachShift([&](int ux, int uy) {
    for (int vy = 0; vy <= 3; ++vy)
    {
      for (int vx = -3; vx <= 3; ++vx)
      {
        const double u = std::hypot(ux, uy);
        const double v = std::hypot(vx, vy);
        const bool crosses = ux * vy - uy * vx >= .7 * u * v;
        const int sum = shiftIndex(ux + vx, uy + vy);
        const int difference = shiftIndex(ux - vx, uy - vy);
        if (v > 0 && u <= 3 && v <= 3 && u <= 2.1 * v && v <= 2.1 * u && crosses && sum >= 0 && difference >= 0)
        {
          addCrossing(shiftIndex(ux, uy), shiftIndex(vx, vy), sum, difference, tables.crossings);
        }
      }
    }
  });
  return tables;
}
}  // namespace

const HaarTables& haarTables()
{
  static const HaarTables TABLES = makeTables();
  return TABLES;
}

cv::Size windowGrid(const cv::Size& size, int level)
{
  const auto along = [level](int pixels) {
    const int cells = pixels / cellSize(level);
    return cells < WINDOW_CELLS ? 0 : (cells - WINDOW_CELLS) / WINDOW_STRIDE + 1;
  };
  const cv::Size grid(along(size.width), along(size.height));
  return grid.empty() ? cv::Size() : grid;
}

cv::Rect windowRect(const cv::Point& index, int level)
{
  const int stride = WINDOW_STRIDE * cellSize(level);
  const int side = WINDOW_CELLS * cellSize(level);
  return {index.x * stride, index.y * stride, side, side};
}

cv::Mat haarCells(const cv::Mat& integral, int level)
{
  const auto& logarithm = haarTables().logarithm;
  const int side = cellSize(level);
  const int shift = 2 * level;  // to four times the mean: side^2 = 4 * 4^level
  cv::Mat cells((integral.rows - 1) / side, (integral.cols - 1) / side, CV_16SC3);
  for (int y = 0; y < cells.rows; ++y)
  {
    const auto* top = integral.ptr<cv::Vec3i>(y * side);
    const auto* bottom = integral.ptr<cv::Vec3i>((y + 1) * side);
    auto* row = cells.ptr<cv::Vec3s>(y);
    for (int x = 0; x < cells.cols; ++x)
    {
      std::array<int, 3> brightness = {};
      for (int k = 0; k < 3; ++k)
      {
        const auto at = [k](const cv::Vec3i& sums) { return static_cast<std::uint32_t>(sums[k]); };
        const std::uint32_t sum =
            at(bottom[(x + 1) * side]) - at(bottom[x * side]) - at(top[(x + 1) * side]) + at(top[x * side]);
        brightness[k] = logarithm[sum >> shift];
      }
      row[x] = cv::Vec3s(static_cast<short>(brightness[0] + brightness[1] + brightness[2]),
                         static_cast<short>(brightness[2] - brightness[1]),
                         static_cast<short>(brightness[0] - brightness[1]));
    }
  }
  return cells;
}

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
    const Block light = blockOf(window.light, i / 4, i % 4);
    const Block red = blockOf(window.red, i / 4, i % 4);
    const Block blue = blockOf(window.blue, i / 4, i % 4);
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
