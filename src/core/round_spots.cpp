#include "round_spots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int CELL = 8;           // [px]
constexpr int CELL_ROW_STEP = 4;  // of the rows whose gradients stand for a cell
// The weakest of 188 small targets has 15 within 11 px of its centre.
constexpr double MIN_GRADIENT = 12;      // of a window, root mean square [grey levels over two pixels]
constexpr float MIN_ISOTROPY = .4F;      // 4 det / trace^2 of the tensor: circles tilted by 60 degrees have .64
constexpr double MIN_DETERMINANT = .02;  // over trace^2: else the lines along the gradients meet nowhere
// Mean squares of sines. Texture has .5; of small targets nine of ten have less than .06 (sharp, tilted up to 50
// degrees) and .18 (blurred, tilted up to 60, on pipes).
constexpr double FIRST_DEVIATION = .35;
constexpr double MAX_DEVIATION = .2;
// Within RING_REACH of the centre, of the squares of slope times radius. Nine of ten small targets have .07 and more,
// disks, squares and leaves less than .04: three of four spots on boards, half of those in clutter.
constexpr int RING_REACH = 17;  // [px]
constexpr double MIN_OTHER_KIND = .04;
constexpr std::size_t MAX_SPOTS = 40;
constexpr double APART = 6;  // centres of two spots [px]

/** Size of a window in which spots are looked for. */
struct Scale
{
  int cells;         // to either side of the middle one
  int reach;         // of the look at a spot [px]
  int row_step;      // of the rows whose gradients are taken there
  double max_shift;  // of the spot from the window's middle [px]
};
constexpr std::array<Scale, 2> SCALES = {Scale{1, 11, 2, 9}, Scale{2, 17, 3, 12}};

/** Adds the products of a row's gradients to those of each column. */
OMR_VECTORIZED void addRow(const std::uint8_t* __restrict above, const std::uint8_t* __restrict row,
                           const std::uint8_t* __restrict below, int width, float* __restrict xx, float* __restrict xy,
                           float* __restrict yy)
{
  for (int x = 1; x + 1 < width; ++x)
  {
    const auto gx = static_cast<float>(row[x + 1] - row[x - 1]);
    const auto gy = static_cast<float>(below[x] - above[x]);
    xx[x] += gx * gx;
    xy[x] += gx * gy;
    yy[x] += gy * gy;
  }
}

/** Sums over the cells of xx, xy and yy, the products of the gradients. @return CV_32FC3 */
cv::Mat3f tensorsOf(const cv::Mat& grey)
{
  cv::Mat3f cells(grey.rows / CELL, grey.cols / CELL);
  cv::parallel_for_(cv::Range(0, cells.rows), [&](const cv::Range& range) {
    const auto width = static_cast<std::size_t>(grey.cols);
    std::vector<float> sums(3 * width);
    for (int row = range.start; row < range.end; ++row)
    {
      std::fill(sums.begin(), sums.end(), 0.F);
      for (int y = row * CELL + 1; y < std::min(grey.rows - 1, (row + 1) * CELL); y += CELL_ROW_STEP)
      {
        addRow(grey.ptr(y - 1), grey.ptr(y), grey.ptr(y + 1), grey.cols, sums.data(), sums.data() + width,
               sums.data() + 2 * width);
      }
      for (int col = 0; col < cells.cols; ++col)
      {
        for (std::size_t product = 0; product < 3; ++product)
        {
          const auto from = sums.begin() + static_cast<std::ptrdiff_t>(product * width) + col * CELL;
          cells(row, col)[static_cast<int>(product)] = std::accumulate(from, from + CELL, 0.F);
        }
      }
    }
  });
  return cells;
}

/** Middles of the windows whose gradients are strong in all directions, more so than in those beside them. */
std::vector<cv::Point2d> strongWindows(const cv::Mat3f& cells, const Scale& scale)
{
  const int side = 2 * scale.cells + 1;
  cv::Mat3f windows;
  cv::boxFilter(cells, windows, -1, cv::Size(side, side), cv::Point(-1, -1), false, cv::BORDER_CONSTANT);
  const auto least = static_cast<float>(MIN_GRADIENT * MIN_GRADIENT * (side * CELL) * (side * CELL) / CELL_ROW_STEP);
  cv::Mat1f marks(cells.size());
  std::transform(windows[0], windows[0] + windows.total(), marks[0], [&](const cv::Vec3f& tensor) {
    const float trace = tensor[0] + tensor[2];
    const float determinant = 4 * (tensor[0] * tensor[2] - tensor[1] * tensor[1]);
    return trace > least && determinant > MIN_ISOTROPY * trace * trace ? determinant / trace : 0;
  });
  std::vector<cv::Point2d> middles;
  for (int row = 1; row + 1 < cells.rows; ++row)
  {
    for (int col = 1; col + 1 < cells.cols; ++col)
    {
      const float mark = marks(row, col);
      bool is_best = mark > 0;
      for (int i = 0; i < 9 && is_best; ++i)
      {
        is_best = marks(row + i / 3 - 1, col + i % 3 - 1) <= mark;
      }
      if (is_best)
      {
        middles.emplace_back((col + .5) * CELL - .5, (row + .5) * CELL - .5);
      }
    }
  }
  return middles;
}

/** Sums over the columns of a spot, y from its middle: of the gradients' products, these times y, and times y^2. */
struct ColumnSums
{
  static constexpr int WIDTH = 40;

  std::array<float, WIDTH> xx{}, xy{}, yy{}, y_xx{}, y_xy{}, y_yy{}, y2_xx{}, y2_yy{};
};

/** Adds a row of a spot: what lies within the reach of its middle. @param count of the columns, a multiple of 8 */
OMR_VECTORIZED void addSpotRow(const std::uint8_t* __restrict above, const std::uint8_t* __restrict row,
                               const std::uint8_t* __restrict below, int count, int reach, int y,
                               ColumnSums& __restrict sums)
{
  const auto height = static_cast<float>(y);
  const int room = reach * reach - y * y;
  for (int i = 0; i < count; ++i)
  {
    const int x = i - count / 2;
    const float weight = x * x <= room ? 1.F : 0.F;
    const auto gx = weight * static_cast<float>(row[i + 1] - row[i - 1]);
    const auto gy = weight * static_cast<float>(below[i] - above[i]);
    sums.xx[i] += gx * gx;
    sums.xy[i] += gx * gy;
    sums.yy[i] += gy * gy;
    sums.y_xx[i] += gx * gx * height;
    sums.y_xy[i] += gx * gy * height;
    sums.y_yy[i] += gy * gy * height;
    sums.y2_xx[i] += gx * gx * height * height;
    sums.y2_yy[i] += gy * gy * height * height;
  }
}

/** The point that the gradients around a place point to best. @return nothing at the image's edge or if there is none
 */
std::optional<RoundSpot> meetingPoint(const cv::Mat& grey, const cv::Point& middle, const Scale& scale)
{
  const int count = (2 * scale.reach + 8) / 8 * 8;
  const int margin = count / 2 + 1;
  if (!cv::Rect(margin, margin, grey.cols - 2 * margin, grey.rows - 2 * margin).contains(middle))
  {
    return {};
  }
  ColumnSums sums;
  for (int y = -scale.reach + scale.reach % scale.row_step; y <= scale.reach; y += scale.row_step)
  {
    const int from = middle.x - count / 2;
    addSpotRow(grey.ptr(middle.y + y - 1) + from, grey.ptr(middle.y + y) + from, grey.ptr(middle.y + y + 1) + from,
               count, scale.reach, y, sums);
  }
  // A gradient g at p gives the line g x (c - p) = 0, weighted by |g|: normal equations for the point c.
  double n11 = 0, n12 = 0, n22 = 0, b1 = 0, b2 = 0, constant = 0;
  double weight = 0, moment_x = 0, moment_y = 0, moment = 0;  // of |g|^2
  for (int i = 0; i < count; ++i)
  {
    const int x = i - count / 2;
    n11 += sums.yy[i];
    n12 -= sums.xy[i];
    n22 += sums.xx[i];
    b1 += x * sums.yy[i] - sums.y_xy[i];
    b2 += sums.y_xx[i] - x * sums.xy[i];
    constant += sums.y2_xx[i] - 2 * x * sums.y_xy[i] + x * x * sums.yy[i];
    const double energy = static_cast<double>(sums.xx[i]) + sums.yy[i];
    weight += energy;
    moment_x += x * energy;
    moment_y += static_cast<double>(sums.y_xx[i]) + sums.y_yy[i];
    moment += x * x * energy + sums.y2_xx[i] + sums.y2_yy[i];
  }
  const double determinant = n11 * n22 - n12 * n12;
  if (determinant <= MIN_DETERMINANT * (n11 + n22) * (n11 + n22))
  {
    return {};
  }
  const cv::Point2d shift((b1 * n22 - b2 * n12) / determinant, (b2 * n11 - b1 * n12) / determinant);
  const double rest = constant - shift.x * b1 - shift.y * b2;
  const double all = moment - 2 * (shift.x * moment_x + shift.y * moment_y) + shift.dot(shift) * weight;
  return RoundSpot{cv::Point2d(middle) + shift, rest / all};
}

std::optional<RoundSpot> lookAt(const cv::Mat& grey, const cv::Point2d& middle, const Scale& scale)
{
  std::optional<RoundSpot> spot = meetingPoint(grey, middle, scale);
  for (const double most : {FIRST_DEVIATION, MAX_DEVIATION})
  {
    if (!spot || spot->deviation > most || cv::norm(spot->center - middle) > scale.max_shift)
    {
      return {};
    }
    spot = meetingPoint(grey, spot->center, scale);
  }
  return spot && spot->deviation < MAX_DEVIATION ? spot : std::nullopt;
}
/** Whether the grey values fall towards the spot as well as rise: disks and squares have one kind of edges. */
bool hasRings(const cv::Mat& grey, const cv::Point2d& center)
{
  const cv::Rect inner(1, 1, grey.cols - 2, grey.rows - 2);
  const cv::Point middle = center;
  const cv::Rect around =
      cv::Rect(middle.x - RING_REACH, middle.y - RING_REACH, 2 * RING_REACH + 1, 2 * RING_REACH + 1);
  double rising = 0;
  double falling = 0;
  for (int y = (around & inner).y; y < (around & inner).br().y; ++y)
  {
    const std::uint8_t* above = grey.ptr(y - 1);
    const std::uint8_t* row = grey.ptr(y);
    const std::uint8_t* below = grey.ptr(y + 1);
    for (int x = (around & inner).x; x < (around & inner).br().x; ++x)
    {
      const cv::Point2d radius = cv::Point2d(x, y) - center;
      const double slope = (row[x + 1] - row[x - 1]) * radius.x + (below[x] - above[x]) * radius.y;
      (slope > 0 ? rising : falling) += radius.dot(radius) < RING_REACH * RING_REACH ? slope * slope : 0;
    }
  }
  return std::min(rising, falling) > MIN_OTHER_KIND * (rising + falling);
}
}  // namespace

std::vector<RoundSpot> findRoundSpots(const cv::Mat& grey)
{
  if (grey.cols < CELL || grey.rows < CELL)
  {
    return {};
  }
  const cv::Mat3f cells = tensorsOf(grey);
  std::vector<RoundSpot> spots;
  for (const Scale& scale : SCALES)
  {
    for (const cv::Point2d& middle : strongWindows(cells, scale))
    {
      if (const std::optional<RoundSpot> spot = lookAt(grey, middle, scale))
      {
        spots.push_back(*spot);
      }
    }
  }
  std::stable_sort(spots.begin(), spots.end(),
                   [](const RoundSpot& left, const RoundSpot& right) { return left.deviation < right.deviation; });
  std::vector<RoundSpot> apart;
  for (const RoundSpot& spot : spots)
  {
    if (apart.size() < MAX_SPOTS && std::none_of(apart.begin(), apart.end(), [&](const RoundSpot& other) {
          return cv::norm(other.center - spot.center) < APART;
        }))
    {
      apart.push_back(spot);
    }
  }
  std::stable_partition(apart.begin(), apart.end(), [&](const RoundSpot& spot) { return hasRings(grey, spot.center); });
  return apart;
}

}  // namespace omr
