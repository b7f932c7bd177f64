#ifndef OUTDOOR_OMR_CORE_POINT_GRID_H
#define OUTDOOR_OMR_CORE_POINT_GRID_H

#include <algorithm>
#include <cstddef>
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
    bool operator<(const Neighbour& other) const
    {
      return squared < other.squared;
    }
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
      found.clear();
      int farthest = MAX_SQUARED;  // that is kept
      for (int y = cells.y; y < cells.br().y; ++y)
      {
        const int to = first_[y * cols_ + cells.br().x];
        for (int i = first_[y * cols_ + cells.x]; i < to; ++i)
        {
          const cv::Point offset = sorted_[i] - center;
          const int squared = offset.dot(offset);
          if (squared >= MIN_SQUARED && squared < farthest)
          {
            insert({squared, offset}, found);
            farthest = found.size() == MAX_NEIGHBOURS ? found.back().squared : MAX_SQUARED;
          }
        }
      }
      if (found.size() == MAX_NEIGHBOURS)
      {
        break;
      }
    }
  }

 private:
  static constexpr int CELL = 16;  // px
  static constexpr int MAX_REACH = 3;
  static constexpr int MIN_SQUARED = 2 * 2;    // distance [px^2]
  static constexpr int MAX_SQUARED = 40 * 40;  // [px^2]; larger squares are regions

  /** Where it belongs; the farthest of too many goes. */
  static void insert(const Neighbour& neighbour, std::vector<Neighbour>& sorted)
  {
    if (sorted.size() < MAX_NEIGHBOURS)
    {
      sorted.emplace_back();
    }
    auto place = sorted.end() - 1;
    for (; place != sorted.begin() && neighbour < *(place - 1); --place)
    {
      *place = *(place - 1);
    }
    *place = neighbour;
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
