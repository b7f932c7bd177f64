#include <algorithm>
#include <cmath>

#include "haar_shifts.h"
#include "outdoor_omr/haar_features.h"

namespace omr
{
namespace
{
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

}  // namespace omr
