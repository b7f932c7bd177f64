#ifndef OUTDOOR_OMR_CORE_POINT_GRID_H
#define OUTDOOR_OMR_CORE_POINT_GRID_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** Saddle points by cells of the image. */
class PointGrid
{
 public:
  static constexpr std::size_t MAX_NEIGHBOURS = 8;

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

  /** The nearest neighbours, nearest first; at most MAX_NEIGHBOURS. */
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
      nearest.fill(NONE);
      for (int y = cells.y; y < cells.br().y; ++y)
      {
        const int to = first_[y * cols_ + cells.br().x];
        for (int i = first_[y * cols_ + cells.x]; i < to; ++i)
        {
          insert(i, sorted_[i] - center, nearest);
        }
      }
      if (nearest.back() < NONE || reach == MAX_REACH)
      {
        found.clear();
        for (auto key = nearest.begin(); key != nearest.end() && *key < NONE; ++key)
        {
          const auto index = static_cast<std::size_t>(*key & INDEX);
          found.push_back({static_cast<int>(*key >> INDEX_BITS), sorted_[index] - center});
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

  // The square of a neighbour's distance and its index: of those equally far the first one comes first.
  using Key = std::int64_t;
  using Nearest = std::array<Key, MAX_NEIGHBOURS>;
  static constexpr int INDEX_BITS = 32;
  static constexpr Key INDEX = (Key{1} << INDEX_BITS) - 1;
  static constexpr Key NONE = Key{MAX_SQUARED} << INDEX_BITS;

  /** Where it belongs; the farthest goes. Without a branch: none could be foreseen. */
  static void insert(int index, const cv::Point& offset, Nearest& sorted)
  {
    const int squared = offset.dot(offset);
    Key key = squared >= MIN_SQUARED ? Key{squared} << INDEX_BITS | index : NONE;
    for (Key& place : sorted)
    {
      const Key nearer = std::min(place, key);
      key = std::max(place, key);
      place = nearer;
    }
  }

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
