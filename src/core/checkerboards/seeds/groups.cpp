#include "groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>

#include "checkerboards/corners/corner_ring.h"

namespace omr
{
namespace
{
constexpr double MAX_AREA_SHARE = 1. / 36;  // of the image: the squares of a 5x7 board that fills it
// 12 sqrt(det covariance) / area is 1 for any parallelogram and 0.955 for an ellipse; larger for stringy shapes.
constexpr double MIN_COMPACTNESS = 0.80;
constexpr double MAX_COMPACTNESS = 1.35;
constexpr int SMALL_AREA = 40;  // px; below it the pixel grid shapes the region
constexpr double SMALL_AREA_SLACK = 0.25;
constexpr double MAX_AXIS_RATIO = 6;
constexpr double EDGE_BAND = 2.2;  // px that the edges take from the side of a square
// Distance to the diagonal neighbour in the metric of the square's covariance: sqrt(24) = 4.90.
constexpr float MIN_DISTANCE = 3.6F;
constexpr float MAX_DISTANCE = 6.6F;
constexpr float MAX_SIZE_RATIO = 3;
constexpr int MAX_PAIRS = 11;  // of one region; a square has 4 diagonal neighbours
constexpr float MIN_GAP = 5;   // grey levels between the two regions and the squares beside them

/** A region as the image of a square: centre and covariance with the edge band added. */
struct Square
{
  cv::Point2f center;
  float xx, xy, yy;     // covariance [px^2]
  float ixx, ixy, iyy;  // its inverse
  float size;           // square root of its determinant [px^2]

  float distance2(const cv::Point2f& offset) const
  {
    return ixx * offset.x * offset.x + 2 * ixy * offset.x * offset.y + iyy * offset.y * offset.y;
  }
};

bool toSquare(const Region& region, double max_area, Square& square)
{
  const double determinant = region.cxx * region.cyy - region.cxy * region.cxy;
  if (region.area > max_area || determinant <= 0)
  {
    return false;
  }
  const double compactness = 12 * std::sqrt(determinant) / region.area;
  const double slack = region.area < SMALL_AREA ? SMALL_AREA_SLACK : 0;
  const double mean = (region.cxx + region.cyy) / 2;
  const double spread = std::sqrt(std::max(0., mean * mean - determinant));
  const double major = mean + spread;
  const double minor = mean - spread;
  if (compactness < MIN_COMPACTNESS - slack || compactness > MAX_COMPACTNESS + slack || minor <= 0 ||
      major > MAX_AXIS_RATIO * MAX_AXIS_RATIO * minor)
  {
    return false;
  }
  const auto widened = [](double variance) {
    const double side = std::sqrt(12 * variance) + EDGE_BAND;
    return side * side / 12;
  };
  const double a = widened(major);
  const double b = widened(minor);
  const double angle = std::atan2(2 * region.cxy, region.cxx - region.cyy) / 2;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  square.center = region.center;
  square.xx = static_cast<float>(a * c * c + b * s * s);
  square.yy = static_cast<float>(a * s * s + b * c * c);
  square.xy = static_cast<float>((a - b) * c * s);
  square.ixx = static_cast<float>(square.yy / (a * b));
  square.iyy = static_cast<float>(square.xx / (a * b));
  square.ixy = static_cast<float>(-square.xy / (a * b));
  square.size = static_cast<float>(std::sqrt(a * b));
  return true;
}

/** Squares by cells of the image, so that neighbours are found without comparing all pairs. */
class Grid
{
 public:
  Grid(const std::vector<Square>& squares, const cv::Size& size)
      : cols_(size.width / CELL + 1),
        rows_(size.height / CELL + 1),
        first_(cols_ * rows_ + 1, 0),
        index_(squares.size())
  {
    for (const Square& square : squares)
    {
      ++first_[cell(square) + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < squares.size(); ++i)
    {
      index_[next[cell(squares[i])]++] = static_cast<int>(i);
    }
  }

  template <typename Action>
  void forEach(const cv::Point2f& center, float reach_x, float reach_y, const Action& action) const
  {
    const int x0 = std::max(0, static_cast<int>((center.x - reach_x) / CELL));
    const int x1 = std::min(cols_ - 1, static_cast<int>((center.x + reach_x) / CELL));
    const int y0 = std::max(0, static_cast<int>((center.y - reach_y) / CELL));
    const int y1 = std::min(rows_ - 1, static_cast<int>((center.y + reach_y) / CELL));
    for (int y = y0; y <= y1; ++y)
    {
      std::for_each(index_.begin() + first_[y * cols_ + x0], index_.begin() + first_[y * cols_ + x1 + 1], action);
    }
  }

 private:
  static constexpr int CELL = 32;  // px

  int cell(const Square& square) const
  {
    return std::min(rows_ - 1, static_cast<int>(square.center.y) / CELL) * cols_ +
           std::min(cols_ - 1, static_cast<int>(square.center.x) / CELL);
  }

  int cols_;
  int rows_;
  std::vector<int> first_;
  std::vector<int> index_;
};

bool areNeighbours(const Square& a, const Square& b, float& distance)
{
  const cv::Point2f offset = b.center - a.center;
  const float from_a = a.distance2(offset);
  if (from_a < MIN_DISTANCE * MIN_DISTANCE || from_a > MAX_DISTANCE * MAX_DISTANCE ||
      a.size > MAX_SIZE_RATIO * b.size || b.size > MAX_SIZE_RATIO * a.size)
  {
    return false;
  }
  const float from_b = b.distance2(offset);
  distance = std::abs(std::sqrt(from_a) - std::sqrt(24.F));
  return from_b >= 0.8F * MIN_DISTANCE * MIN_DISTANCE && from_b <= 1.25F * MAX_DISTANCE * MAX_DISTANCE;
}

/** The corner between two squares: half way, the other diagonal at a right angle in the mean covariance's metric. */
LocalFrame frameBetween(const Square& a, const Square& b, cv::Point2f& diagonal, cv::Point2f& other)
{
  const float l11 = std::sqrt(a.xx + b.xx);
  const float l21 = (a.xy + b.xy) / l11;
  const float l22 = std::sqrt(std::max(1e-6F, a.yy + b.yy - l21 * l21));
  diagonal = b.center - a.center;
  const float x = diagonal.x / l11;
  const float y = (diagonal.y - l21 * x) / l22;
  other = cv::Point2f(-l11 * y, -l21 * y + l22 * x);
  LocalFrame frame{0.5F * (a.center + b.center), 0.5F * (diagonal + other), 0.5F * (diagonal - other)};
  if (cross(frame.u, frame.v) < 0)
  {
    std::swap(frame.u, frame.v);
  }
  return frame;
}

bool alternates(const Frame& frame, const LocalFrame& corner, const cv::Point2f& diagonal, const cv::Point2f& other)
{
  const PyramidView view(frame, 0.7F * length(diagonal));
  const std::array<float, QUADRANTS> grey = {
      view.sample(corner.node + 0.3F * diagonal), view.sample(corner.node + 0.25F * other),
      view.sample(corner.node - 0.3F * diagonal), view.sample(corner.node - 0.25F * other)};
  return quadrantGap(grey, 1) >= MIN_GAP || quadrantGap(grey, -1) >= MIN_GAP;
}
}  // namespace

std::vector<Seed> pairNeighbours(const Frame& frame, const RegionMap& regions)
{
  std::vector<Square> squares;
  squares.reserve(regions.regions.size());
  const double max_area = MAX_AREA_SHARE * static_cast<double>(frame.raw_grey.total());
  for (const Region& region : regions.regions)
  {
    Square square;
    if (toSquare(region, max_area, square))
    {
      squares.push_back(square);
    }
  }
  struct Pair
  {
    Seed seed;
    int a, b;
  };
  struct Candidate
  {
    float distance;
    int index;
    bool operator<(const Candidate& other) const
    {
      return distance < other.distance;
    }
  };
  const Grid grid(squares, frame.raw_grey.size());
  std::vector<int> links(squares.size(), 0);
  std::vector<Pair> pairs;
  std::vector<Candidate> candidates;
  for (int a = 0; a < static_cast<int>(squares.size()); ++a)
  {
    const Square& square = squares[a];
    candidates.clear();
    grid.forEach(square.center, MAX_DISTANCE * std::sqrt(square.xx), MAX_DISTANCE * std::sqrt(square.yy), [&](int b) {
      float distance = 0;
      if (b > a && areNeighbours(square, squares[b], distance))
      {
        candidates.push_back({distance, b});
      }
    });
    const std::size_t kept = std::min<std::size_t>(candidates.size(), MAX_PAIRS);
    std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(kept), candidates.end());
    for (std::size_t k = 0; k < kept; ++k)
    {
      const int b = candidates[k].index;
      cv::Point2f diagonal;
      cv::Point2f other;
      const LocalFrame corner = frameBetween(square, squares[b], diagonal, other);
      if (alternates(frame, corner, diagonal, other))
      {
        ++links[a];
        ++links[b];
        pairs.push_back({{corner, false, 0}, a, b});
      }
    }
  }
  std::vector<Seed> seeds;
  for (Pair& pair : pairs)
  {
    pair.seed.rank = links[pair.a] + links[pair.b];
    seeds.push_back(pair.seed);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.rank > b.rank; });
  return seeds;
}

}  // namespace omr
