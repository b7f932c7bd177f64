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

}  // namespace omr
