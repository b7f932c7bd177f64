#ifndef OUTDOOR_OMR_CORE_POINT_GRID_H
#define OUTDOOR_OMR_CORE_POINT_GRID_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>
#include <vector>

namespace omr
{
/** Saddle points by cells of the image. */
class PointGrid
{
 public:
  static constexpr std::size_t MAX_NEIGHBOURS = 8;
  static constexpr int MAX_POINTS = 1 << 13;

  /** @param points at most MAX_POINTS. */
  PointGrid(const std::vector<cv::Point>& points, const cv::Size& size)
      : cols_(size.width / CELL + 1),
        rows_(size.height / CELL + 1),
        first_(cols_ * rows_ + 1, 0),
        sorted_(points.size())
  {
    for (const cv::Point& point : points)
    {
      ++first_[cellOf(point) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<int> end(first_.begin() + 1, first_.end());
    for (const cv::Point& point : points)
    {
      sorted_[--end[cellOf(point)]] = point;
    }
  }

  struct Neighbour
  {
    int squared;  // distance [px^2]
    cv::Point offset;
  };

  /** The nearest of the points in the fewest cells around that hold enough, nearest first; at most MAX_NEIGHBOURS. A
   * point beyond those cells may be nearer than the last ones. */
  void neighbours(const cv::Point& center, std::vector<Neighbour>& found) const
  {
    for (int reach = 1; reach <= MAX_REACH; ++reach)
    {
      const cv::Rect cells = cellsAround(center, reach);
      if (reach < MAX_REACH && countIn(cells) <= MAX_NEIGHBOURS)  // with the point itself
      {
        continue;
      }
      Nearest nearest;
      for (int y = cells.y; y < cells.br().y; ++y)
      {
        const int to = first_[y * cols_ + cells.br().x];
        for (int i = first_[y * cols_ + cells.x]; i < to; ++i)
        {
          nearest.insert(keyOf(i, sorted_[i] - center));
        }
      }
      const std::array<float, MAX_NEIGHBOURS> keys = nearest.keys();
      if (keys.back() < NONE || reach == MAX_REACH)
      {
        found.clear();
        for (auto key = keys.begin(); key != keys.end() && *key < NONE; ++key)
        {
          const auto whole = static_cast<int>(*key);
          found.push_back({whole / MAX_POINTS, sorted_[whole % MAX_POINTS] - center});
        }
        break;
      }
    }
  }

 private:
  static constexpr int CELL = 16;  // px
  static constexpr int MAX_REACH = 3;
  static constexpr int MIN_SQUARED = 2 * 2;    // distance [px^2]
  static constexpr int MAX_SQUARED = 40 * 40;  // [px^2]; larger squares are regions

  // A key is the square of a neighbour's distance and its index, so that of those equally far the first one comes
  // first: a whole number that a float holds, as its minimum and maximum are one instruction on every processor.
  static constexpr float NONE = static_cast<float>(MAX_SQUARED * MAX_POINTS);
  static_assert(MAX_SQUARED * MAX_POINTS <= 1 << 24);

  static float keyOf(int index, const cv::Point& offset)
  {
    const int squared = offset.dot(offset);
    return squared >= MIN_SQUARED ? static_cast<float>(squared * MAX_POINTS + index) : NONE;
  }

  /** The least keys, ascending. */
  class Nearest
  {
   public:
    /** Where it belongs; the largest goes. All places at once: each keeps its own, or takes the key or the one before.
     * One by one it took a twentieth of the CPU time on clutter. */
    void insert(float key)
    {
      const cv::v_float32x4 keys = cv::v_setall_f32(key);
      const cv::v_float32x4 before_low = cv::v_extract<3>(cv::v_setzero_f32(), low_);
      const cv::v_float32x4 before_high = cv::v_extract<3>(low_, high_);
      low_ = cv::v_min(low_, cv::v_max(before_low, keys));
      high_ = cv::v_min(high_, cv::v_max(before_high, keys));
    }

    std::array<float, MAX_NEIGHBOURS> keys() const
    {
      std::array<float, MAX_NEIGHBOURS> keys;
      cv::v_store(keys.data(), low_);
      cv::v_store(keys.data() + MAX_NEIGHBOURS / 2, high_);
      return keys;
    }

   private:
    cv::v_float32x4 low_ = cv::v_setall_f32(NONE);
    cv::v_float32x4 high_ = cv::v_setall_f32(NONE);
  };

  cv::Rect cellsAround(const cv::Point& point, int reach) const
  {
    const cv::Point cell = point / CELL;
    const cv::Point from(std::max(0, cell.x - reach), std::max(0, cell.y - reach));
    return {from, cv::Point(std::min(cols_ - 1, cell.x + reach) + 1, std::min(rows_ - 1, cell.y + reach) + 1)};
  }

  std::size_t countIn(const cv::Rect& cells) const
  {
    int count = 0;
    for (int y = cells.y; y < cells.br().y; ++y)
    {
      count += first_[y * cols_ + cells.br().x] - first_[y * cols_ + cells.x];
    }
    return static_cast<std::size_t>(count);
  }

  int cellOf(const cv::Point& point) const
  {
    return point.y / CELL * cols_ + point.x / CELL;
  }

  int cols_;
  int rows_;
  std::vector<int> first_;         // of the points of each cell, and the end of all
  std::vector<cv::Point> sorted_;  // by cells, row by row
};

}  // namespace omr

#endif
