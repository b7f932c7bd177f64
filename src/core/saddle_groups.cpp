#include "outdoor_omr/saddle_groups.h"

#include <algorithm>
#include <array>
#include <cmath>

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
      : points_(points),
        cols_(size.width / CELL + 1),
        rows_(size.height / CELL + 1),
        first_(cols_ * rows_, -1),
        next_(points.size())
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      int& first = first_[points[i].y / CELL * cols_ + points[i].x / CELL];
      next_[i] = first;
      first = static_cast<int>(i);
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
        for (int x = std::max(0, col - reach); x <= std::min(cols_ - 1, col + reach); ++x)
        {
          for (int i = first_[y * cols_ + x]; i >= 0; i = next_[i])
          {
            const cv::Point offset = points_[i] - center;
            const int squared = offset.dot(offset);
            if (squared >= MIN_SQUARED && squared < MAX_SQUARED)
            {
              found.push_back({std::sqrt(static_cast<float>(squared)), offset});
            }
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

  const std::vector<cv::Point>& points_;
  int cols_;
  int rows_;
  std::vector<int> first_;
  std::vector<int> next_;
};

/** Grey levels by which the seven squares around the corner alternate. */
float alternation(const cv::Mat& grey, const LocalFrame& frame)
{
  const auto sample = [&](float u, float v) {
    const cv::Point2f point = frame.at(u, v);
    return sampleGrey(grey, point.x, point.y);
  };
  const float q1 = sample(0.5F, 0.5F);
  const float q2 = sample(-0.5F, 0.5F);
  const float q3 = sample(-0.5F, -0.5F);
  const float q4 = sample(0.5F, -0.5F);
  const float inner = std::max(std::min(q1, q3) - std::max(q2, q4), std::min(q2, q4) - std::max(q1, q3));
  if (inner <= 0)
  {
    return 0;
  }
  const float n1 = sample(1.5F, 0.5F);
  const float n2 = sample(0.5F, 1.5F);
  const float n3 = sample(1.5F, 1.5F);
  return std::max(std::min({q1, q3, n3}) - std::max({q2, q4, n1, n2}),
                  std::min({q2, q4, n1, n2}) - std::max({q1, q3, n3}));
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
      const float gap = alternation(grey, frame);
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
