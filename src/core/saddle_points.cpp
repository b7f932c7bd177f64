#include "outdoor_omr/saddle_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace omr
{
namespace
{
constexpr int MAX_POINTS = 5000;  // the strongest; three boards of the largest size have 1200
constexpr int MAX_FAINT_POINTS = 2000;
constexpr int MARGIN = 4;     // px at the border of the image without saddle points
constexpr int MIN_SIDE = 16;  // px of an image that can hold a lattice
constexpr int LANES = 8;

/** What a saddle point must have at least. */
struct Threshold
{
  int response;   // 4 (grey levels / px^2)^2
  int range;      // grey levels around the point
  float between;  // grey levels between light and dark squares
};
constexpr Threshold CLEAR = {32, 14, 5};
constexpr Threshold FAINT = {4, 6, 3};
// Largest difference between opposite pixels of the ring, of their range; stricter loses squares of 3 px.
constexpr float MAX_ASYMMETRY = 0.8F;

/** 4 (Ixy^2 - Ixx Iyy) of one row, saturated; positive at saddle points. Eight pixels at a time: the whole image passes
 * through here. */
void saddleResponse(const uchar* above, const uchar* here, const uchar* below, int width, std::int16_t* response)
{
  const auto load = [](const uchar* pixels) { return cv::v_reinterpret_as_s16(cv::v_load_expand(pixels)); };
  const auto respond = [&](int x) {
    const cv::v_int16x8 twice = load(here + x) << 1;
    const cv::v_int16x8 xx = load(here + x - 1) + load(here + x + 1) - twice;
    const cv::v_int16x8 yy = load(above + x) + load(below + x) - twice;
    const cv::v_int16x8 xy = load(above + x - 1) + load(below + x + 1) - load(above + x + 1) - load(below + x - 1);
    cv::v_int32x4 xy2_low;
    cv::v_int32x4 xy2_high;
    cv::v_int32x4 product_low;
    cv::v_int32x4 product_high;
    cv::v_mul_expand(xy, xy, xy2_low, xy2_high);
    cv::v_mul_expand(xx, yy, product_low, product_high);
    cv::v_store(response + x, cv::v_pack((xy2_low >> 2) - (product_low << 2), (xy2_high >> 2) - (product_high << 2)));
  };
  int x = 1;
  for (; x + LANES <= width - 1; x += LANES)
  {
    respond(x);
  }
  respond(width - 1 - LANES);
}

using Rows = std::array<const std::int16_t*, 3>;  // responses of three rows, from top to bottom

/** Of eight neighbouring pixels one bit each: whether the response exceeds the least and is a maximum of 3 x 3. */
int maxima(const Rows& rows, int x, const cv::v_int16x8& least)
{
  const auto at = [&](int row, int offset) { return cv::v_load(rows[row] + x + offset); };
  const cv::v_int16x8 value = at(1, 0);
  const cv::v_int16x8 strong = value > least;
  if (!cv::v_check_any(strong))
  {
    return 0;
  }
  // Of two equal neighbours the first one counts.
  const cv::v_int16x8 before = cv::v_max(cv::v_max(at(0, -1), at(0, 0)), cv::v_max(at(0, 1), at(1, -1)));
  const cv::v_int16x8 after = cv::v_max(cv::v_max(at(2, -1), at(2, 0)), cv::v_max(at(2, 1), at(1, 1)));
  return cv::v_signmask(strong & (value > before) & (value >= after));
}

/** Calls the action for every x with a response that exceeds the least and is a maximum of 3 x 3. */
template <typename Action>
void forEachMaximum(const Rows& rows, int width, int least, const Action& action)
{
  const cv::v_int16x8 threshold = cv::v_setall_s16(static_cast<short>(least));
  const int end = width - MARGIN;
  for (int x = MARGIN; x < end; x += LANES)
  {
    const int first = std::min(x, end - LANES);  // the last eight overlap those before
    const int found = maxima(rows, first, threshold);
    for (int i = x - first; found >> i != 0; ++i)
    {
      if ((found >> i & 1) != 0)
      {
        action(first + i);
      }
    }
  }
}

bool isPointSymmetric(const cv::Mat& grey, int x, int y, int min_range)
{
  constexpr std::array<int, 6> RING_X = {2, 2, 1, 0, -1, -2};
  constexpr std::array<int, 6> RING_Y = {0, 1, 2, 2, 2, 1};
  int least = 255;
  int most = 0;
  int largest = 0;
  int sum = 0;
  for (std::size_t i = 0; i < RING_X.size(); ++i)
  {
    const int a = grey.at<uchar>(y + RING_Y[i], x + RING_X[i]);
    const int b = grey.at<uchar>(y - RING_Y[i], x - RING_X[i]);
    least = std::min({least, a, b});
    most = std::max({most, a, b});
    largest = std::max(largest, std::abs(a - b));
    sum += std::abs(a - b);
  }
  const auto range = static_cast<float>(most - least);
  return range >= static_cast<float>(min_range) && static_cast<float>(largest) <= MAX_ASYMMETRY * range &&
         static_cast<float>(sum) <= 2.2F * MAX_ASYMMETRY * range;
}

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
            const cv::Point2f offset = points_[i] - center;
            const float distance = length(offset);
            if (distance > MIN_DISTANCE && distance < MAX_DISTANCE)
            {
              found.push_back({distance, offset});
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
  static constexpr float MIN_DISTANCE = 1.8F;  // px
  static constexpr float MAX_DISTANCE = 40;    // px; larger squares are regions

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

std::vector<cv::Point> findSaddlePoints(const cv::Mat& grey, bool faint, int max_count)
{
  struct Point
  {
    std::int16_t response;
    cv::Point place;
  };
  const Threshold& least = faint ? FAINT : CLEAR;
  std::vector<cv::Point> points;
  std::vector<Point> found;
  if (grey.cols < MIN_SIDE || grey.rows < MIN_SIDE)
  {
    return points;
  }
  const int width = grey.cols;
  std::vector<std::int16_t> buffer(3 * width, 0);
  std::array<std::int16_t*, 3> rows = {buffer.data(), buffer.data() + width, buffer.data() + 2 * width};
  for (int y = MARGIN - 1; y <= grey.rows - MARGIN; ++y)
  {
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    saddleResponse(grey.ptr<uchar>(y - 1), grey.ptr<uchar>(y), grey.ptr<uchar>(y + 1), width, rows[2]);
    if (y < MARGIN + 1)
    {
      continue;
    }
    forEachMaximum({rows[0], rows[1], rows[2]}, width, least.response, [&](int x) {
      if (isPointSymmetric(grey, x, y - 1, least.range))
      {
        found.push_back({rows[1][x], {x, y - 1}});
      }
    });
  }
  if (static_cast<int>(found.size()) > max_count)
  {
    std::nth_element(found.begin(), found.begin() + max_count, found.end(), [](const Point& a, const Point& b) {
      return std::make_tuple(-a.response, a.place.y, a.place.x) < std::make_tuple(-b.response, b.place.y, b.place.x);
    });
    found.resize(max_count);
  }
  points.reserve(found.size());
  for (const Point& point : found)
  {
    points.push_back(point.place);
  }
  return points;
}

std::vector<Seed> groupSaddlePoints(const Frame& frame, int level, bool faint, const SearchMap& open)
{
  const cv::Mat& grey = frame.grey[level];
  const auto scale = static_cast<float>(1 << level);
  const std::vector<cv::Point> points = findSaddlePoints(grey, faint, faint ? MAX_FAINT_POINTS : MAX_POINTS);
  const PointGrid grid(points, grey.size());
  std::vector<Seed> seeds;
  std::vector<PointGrid::Neighbour> neighbours;
  for (const cv::Point& point : points)
  {
    if (!open.isOpen(scale * cv::Point2f(point)))
    {
      continue;
    }
    grid.neighbours(point, neighbours);
    Seed seed;
    if (frameFromNeighbours(grey, point, neighbours, (faint ? FAINT : CLEAR).between, seed))
    {
      seed.frame.node *= scale;
      seed.frame.u *= scale;
      seed.frame.v *= scale;
      seeds.push_back(seed);
    }
  }
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.rank > b.rank; });
  return seeds;
}

}  // namespace omr
