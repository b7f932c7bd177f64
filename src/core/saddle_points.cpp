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
constexpr int MARGIN = 4;     // px at the border of the image without saddle points
constexpr int MIN_SIDE = 16;  // px of an image that can hold a lattice
constexpr int LANES = 8;
constexpr int STRIPS = 8;  // of the image, shared by the threads; the points do not depend on how many there are

/** What a saddle point must have at least. */
struct Threshold
{
  int response;  // 4 (grey levels / px^2)^2
  int range;     // grey levels around the point
};
constexpr Threshold CLEAR = {32, 14};
constexpr Threshold FAINT = {4, 6};
// Largest difference between opposite pixels of the ring, of their range; stricter loses squares of 3 px.
constexpr float MAX_ASYMMETRY = 0.8F;

/** Of three rows, each in turn the newest, what their saddle response is made of. */
class ResponseRows
{
 public:
  explicit ResponseRows(int width) : width_(width), values_(6 * static_cast<std::size_t>(width))
  {
  }

  /** Takes the row below the last one. */
  void push(const uchar* row)
  {
    newest_ = (newest_ + 1) % 3;
    std::int16_t* values = grey(0);
    std::int16_t* slopes = slope(0);
    forEachBlock(0, width_,
                 [&](int x) { cv::v_store(values + x, cv::v_reinterpret_as_s16(cv::v_load_expand(row + x))); });
    forEachBlock(1, width_ - 1,
                 [&](int x) { cv::v_store(slopes + x, cv::v_load(values + x + 1) - cv::v_load(values + x - 1)); });
  }

  /** 4 (Ixy^2 - Ixx Iyy) of the row in the middle, saturated; positive at saddle points. Eight pixels at a time: the
   * whole image passes through here. */
  void respond(std::int16_t* response) const
  {
    const std::int16_t* above = grey(2);
    const std::int16_t* here = grey(1);
    const std::int16_t* below = grey(0);
    const std::int16_t* slope_above = slope(2);
    const std::int16_t* slope_below = slope(0);
    forEachBlock(1, width_ - 1, [&](int x) {
      const cv::v_int16x8 twice = cv::v_load(here + x) << 1;
      const cv::v_int16x8 xx = cv::v_load(here + x - 1) + cv::v_load(here + x + 1) - twice;
      const cv::v_int16x8 yy = cv::v_load(above + x) + cv::v_load(below + x) - twice;
      const cv::v_int16x8 xy = cv::v_load(slope_below + x) - cv::v_load(slope_above + x);
      // 16 Ixy^2 - 16 Ixx Iyy as one sum of two products.
      const cv::v_int16x8 minus_yy = cv::v_setzero_s16() - (yy << 4);
      cv::v_int16x8 left_low;
      cv::v_int16x8 left_high;
      cv::v_int16x8 right_low;
      cv::v_int16x8 right_high;
      cv::v_zip(xy, xx, left_low, left_high);
      cv::v_zip(xy, minus_yy, right_low, right_high);
      cv::v_store(response + x,
                  cv::v_pack(cv::v_dotprod(left_low, right_low) >> 2, cv::v_dotprod(left_high, right_high) >> 2));
    });
  }

 private:
  /** Calls the action for blocks of LANES; the last one overlaps the one before. */
  template <typename Action>
  static void forEachBlock(int from, int to, const Action& action)
  {
    int x = from;
    for (; x + LANES <= to; x += LANES)
    {
      action(x);
    }
    action(to - LANES);
  }

  std::size_t offset(int age) const
  {
    return static_cast<std::size_t>((newest_ + 3 - age) % 3) * 2 * width_;
  }
  std::int16_t* grey(int age)
  {
    return &values_[offset(age)];
  }
  const std::int16_t* grey(int age) const
  {
    return &values_[offset(age)];
  }
  std::int16_t* slope(int age)
  {
    return &values_[offset(age) + width_];
  }
  const std::int16_t* slope(int age) const
  {
    return &values_[offset(age) + width_];
  }

  int width_;
  int newest_ = 0;
  std::vector<std::int16_t> values_;  // of each row the grey values, and their differences along it
};

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

struct Point
{
  std::int16_t response;
  cv::Point place;
};

/** The saddle points of the rows [from, to). */
void findInRows(const cv::Mat& grey, const Threshold& least, int from, int to, std::vector<Point>& found)
{
  const int width = grey.cols;
  ResponseRows source(width);
  std::vector<std::int16_t> buffer(3 * width, 0);
  std::array<std::int16_t*, 3> rows = {buffer.data(), buffer.data() + width, buffer.data() + 2 * width};
  source.push(grey.ptr<uchar>(from - 2));
  source.push(grey.ptr<uchar>(from - 1));
  for (int y = from - 1; y <= to; ++y)
  {
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    source.push(grey.ptr<uchar>(y + 1));
    source.respond(rows[2]);
    if (y < from + 1)
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
}
}  // namespace

std::vector<cv::Point> findSaddlePoints(const cv::Mat& grey, bool faint, int max_count)
{
  const Threshold& least = faint ? FAINT : CLEAR;
  std::vector<cv::Point> points;
  if (grey.cols < MIN_SIDE || grey.rows < MIN_SIDE)
  {
    return points;
  }
  const int height = grey.rows - 2 * MARGIN;
  std::array<std::vector<Point>, STRIPS> strips;
  cv::parallel_for_(cv::Range(0, STRIPS), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
    {
      findInRows(grey, least, MARGIN + height * i / STRIPS, MARGIN + height * (i + 1) / STRIPS, strips[i]);
    }
  });
  std::vector<Point> found;
  for (const std::vector<Point>& strip : strips)
  {
    found.insert(found.end(), strip.begin(), strip.end());
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

}  // namespace omr
