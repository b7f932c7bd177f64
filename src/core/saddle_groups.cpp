#include "outdoor_omr/saddle_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "outdoor_omr/saddle_points.h"

namespace omr
{
namespace
{
constexpr int MAX_POINTS = 5000;  // the strongest; three boards of the largest size have 1200
constexpr int MAX_FAINT_POINTS = 2000;
constexpr int PARTS = 8;        // of the points, shared by the threads; the seeds do not depend on how many there are
constexpr float CLEAR_GAP = 5;  // grey levels between light and dark squares
constexpr float FAINT_GAP = 3;

/** Saddle points by cells of the image. */
class PointGrid
{
 public:
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
    float distance;
    cv::Point2f offset;
    bool operator<(const Neighbour& other) const
    {
      return distance < other.distance;
    }
  };

  /** The nearest neighbours, nearest first; at most MAX_NEIGHBOURS. */
  void neighbours(const cv::Point& center, std::vector<Neighbour>& found) const
  {
    const int col = center.x / CELL;
    const int row = center.y / CELL;
    for (int reach = 1; reach <= MAX_REACH; ++reach)
    {
      found.clear();
      for (int y = std::max(0, row - reach); y <= std::min(rows_ - 1, row + reach); ++y)
      {
        const int from = first_[y * cols_ + std::max(0, col - reach)];
        const int to = first_[y * cols_ + std::min(cols_ - 1, col + reach) + 1];
        for (int i = from; i < to; ++i)
        {
          const cv::Point offset = sorted_[i] - center;
          const int squared = offset.dot(offset);
          if (squared >= MIN_SQUARED && squared < MAX_SQUARED)
          {
            found.push_back({std::sqrt(static_cast<float>(squared)), offset});
          }
        }
      }
      if (found.size() >= MAX_NEIGHBOURS)
      {
        break;
      }
    }
    const std::size_t kept = std::min<std::size_t>(found.size(), MAX_NEIGHBOURS);
    std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end());
    found.resize(kept);
  }

 private:
  static constexpr int CELL = 16;  // px
  static constexpr int MAX_REACH = 3;
  static constexpr std::size_t MAX_NEIGHBOURS = 8;
  static constexpr int MIN_SQUARED = 2 * 2;    // distance [px^2]
  static constexpr int MAX_SQUARED = 40 * 40;  // [px^2]; larger squares are regions

  int cellOf(const cv::Point& point) const
  {
    return point.y / CELL * cols_ + point.x / CELL;
  }

  int cols_;
  int rows_;
  std::vector<int> first_;         // of the points of each cell, and the end of all
  std::vector<cv::Point> sorted_;  // by cells, row by row
};

/** Grey levels by which the seven squares around the corner alternate, or 0 if by less than the least gap. */
float alternation(const cv::Mat& grey, const LocalFrame& frame, float least_gap)
{
  struct Square
  {
    float u, v;
    bool is_like_first;
  };
  constexpr std::array<Square, 5> OTHERS = {
      {{-0.5F, -0.5F, true}, {0.5F, -0.5F, false}, {1.5F, 0.5F, false}, {0.5F, 1.5F, false}, {1.5F, 1.5F, true}}};
  const auto sample = [&](float u, float v) {
    const cv::Point2f point = frame.at(u, v);
    return sampleGrey(grey, point.x, point.y);
  };
  const float first = sample(0.5F, 0.5F);
  const float second = sample(-0.5F, 0.5F);
  const float sign = first > second ? 1 : -1;
  float light = sign * first;  // the darkest of the light squares, as seen with that sign
  float dark = sign * second;
  // In texture the first two squares tell already.
  for (auto square = OTHERS.begin(); light - dark >= least_gap; ++square)
  {
    if (square == OTHERS.end())
    {
      return light - dark;
    }
    const float value = sign * sample(square->u, square->v);
    light = square->is_like_first ? std::min(light, value) : light;
    dark = square->is_like_first ? dark : std::max(dark, value);
  }
  return 0;
}

/** The first frame, nearest neighbours first, in which the squares alternate. */
bool frameFromNeighbours(const cv::Mat& grey, const cv::Point& center,
                         const std::vector<PointGrid::Neighbour>& neighbours, float least_gap, Seed& seed)
{
  constexpr float MIN_SINE = 0.4F;
  constexpr float MAX_STEP_RATIO = 2.5F;
  for (std::size_t a = 0; a < neighbours.size(); ++a)
  {
    for (std::size_t b = a + 1; b < neighbours.size(); ++b)
    {
      LocalFrame frame{center, neighbours[a].offset, neighbours[b].offset};
      const float area = cross(frame.u, frame.v);
      if (std::abs(area) < MIN_SINE * neighbours[a].distance * neighbours[b].distance ||
          neighbours[b].distance > MAX_STEP_RATIO * neighbours[a].distance)
      {
        continue;
      }
      if (area < 0)
      {
        std::swap(frame.u, frame.v);
      }
      const float gap = alternation(grey, frame, least_gap);
      if (gap >= least_gap)
      {
        seed = {frame, true, static_cast<int>(gap)};
        return true;
      }
    }
  }
  return false;
}
}  // namespace

std::vector<Seed> groupSaddlePoints(const Frame& frame, int level, bool faint, const SearchMap& open)
{
  const cv::Mat& grey = frame.grey[level];
  const auto scale = static_cast<float>(1 << level);
  const std::vector<cv::Point> points = findSaddlePoints(grey, faint, faint ? MAX_FAINT_POINTS : MAX_POINTS);
  const PointGrid grid(points, grey.size());
  std::array<std::vector<Seed>, PARTS> parts;
  const auto count = static_cast<int>(points.size());
  cv::parallel_for_(cv::Range(0, PARTS), [&](const cv::Range& range) {
    std::vector<PointGrid::Neighbour> neighbours;
    for (int part = range.start; part < range.end; ++part)
    {
      for (int i = count * part / PARTS; i < count * (part + 1) / PARTS; ++i)
      {
        if (!open.isOpen(scale * cv::Point2f(points[i])))
        {
          continue;
        }
        grid.neighbours(points[i], neighbours);
        Seed seed;
        if (frameFromNeighbours(grey, points[i], neighbours, faint ? FAINT_GAP : CLEAR_GAP, seed))
        {
          seed.frame.node *= scale;
          seed.frame.u *= scale;
          seed.frame.v *= scale;
          parts[part].push_back(seed);
        }
      }
    }
  });
  std::vector<Seed> seeds;
  for (const std::vector<Seed>& part : parts)
  {
    seeds.insert(seeds.end(), part.begin(), part.end());
  }
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.rank > b.rank; });
  return seeds;
}

}  // namespace omr
