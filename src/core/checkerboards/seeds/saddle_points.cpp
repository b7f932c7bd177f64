#include "saddle_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>
#include <tuple>

#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int MARGIN = 4;     // px at the border of the image without saddle points
constexpr int MIN_SIDE = 16;  // px of an image that can hold a lattice
constexpr int STRIPS = 8;     // of the image, shared by the threads; the points do not depend on how many there are

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

/** The grey values of a row as they are compared: so each is widened once and not for each of its neighbours. */
OMR_VECTORIZED void widen(const uchar* __restrict grey, int width, std::int16_t* __restrict values)
{
  for (int x = 0; x < width; ++x)
  {
    values[x] = grey[x];
  }
}

/** 4 (Ixy^2 - Ixx Iyy) of a row, saturated; positive at saddle points. The whole image passes through here. */
OMR_VECTORIZED void respond(const std::int16_t* __restrict above, const std::int16_t* __restrict here,
                            const std::int16_t* __restrict below, int width, std::int16_t* __restrict response)
{
  for (int x = 1; x < width - 1; ++x)
  {
    const auto xx = static_cast<std::int16_t>(16 * (here[x - 1] + here[x + 1] - 2 * here[x]));  // 16 Ixx
    const auto yy = static_cast<std::int16_t>(above[x] + below[x] - 2 * here[x]);
    const auto xy = static_cast<std::int16_t>(above[x - 1] - above[x + 1] + below[x + 1] - below[x - 1]);  // 4 Ixy
    const int value = (xy * xy - xx * yy) >> 2;
    response[x] = static_cast<std::int16_t>(std::max(-32768, std::min(32767, value)));
  }
}

constexpr int LANES = 8;
constexpr int BLOCK = 2 * LANES;  // px side by side: of nine in ten none responds enough

bool anyExceeds(const std::int16_t* response, const cv::v_int16x8& least)
{
  return cv::v_check_any((cv::v_load(response) > least) | (cv::v_load(response + LANES) > least));
}

/** Which of the responses exceed the least and are maxima of 3 x 3, a bit each; of two equal neighbours the first one
 * counts. */
unsigned findMaxima(const std::int16_t* above, const std::int16_t* response, const std::int16_t* below,
                    const cv::v_int16x8& least)
{
  const auto largest_of_three = [](const std::int16_t* row) {
    return cv::v_max(cv::v_max(cv::v_load(row - 1), cv::v_load(row + 1)), cv::v_load(row));
  };
  const cv::v_int16x8 here = cv::v_load(response);
  const cv::v_int16x8 before = cv::v_max(cv::v_max(largest_of_three(above), cv::v_load(response - 1)), least);
  const cv::v_int16x8 after = cv::v_max(largest_of_three(below), cv::v_load(response + 1));
  const cv::v_int16x8 maxima = (here > before) & (here >= after);
  return static_cast<unsigned>(cv::v_signmask(cv::v_pack(maxima, maxima))) & 0xffU;
}

/** Values of three rows, from top to bottom. */
using Rows = std::array<std::int16_t*, 3>;

/** Memory for three rows. */
class RowBuffer
{
 public:
  explicit RowBuffer(int width) : width_(width), values_(3 * static_cast<std::size_t>(width), 0)
  {
  }

  Rows rows()
  {
    return {values_.data(), values_.data() + width_, values_.data() + 2 * static_cast<std::ptrdiff_t>(width_)};
  }

 private:
  int width_;
  std::vector<std::int16_t> values_;
};

/** Calls the action for every x with a maximum in the middle row. @param blocks memory for as many as a row has */
template <typename Action>
void forEachMaximum(const Rows& responses, int width, int least, std::vector<int>& blocks, const Action& action)
{
  const auto [above, here, below] = responses;
  const cv::v_int16x8 threshold = cv::v_setall_s16(static_cast<short>(least));
  const int end = width - MARGIN;
  // Without a branch: which blocks have one cannot be foreseen.
  int* next = blocks.data();
  for (int x = MARGIN; x < end; x += BLOCK)
  {
    *next = x;
    next += anyExceeds(here + x, threshold) ? 1 : 0;
  }
  for (const int* block = blocks.data(); block != next; ++block)
  {
    const int x = *block;
    const unsigned left = findMaxima(above + x, here + x, below + x, threshold);
    const unsigned right = findMaxima(above + x + LANES, here + x + LANES, below + x + LANES, threshold);
    const unsigned inside = (1U << std::min(BLOCK, end - x)) - 1;
    for (unsigned maxima = (left | right << LANES) & inside; maxima != 0; maxima &= maxima - 1)
    {
      action(x + __builtin_ctz(maxima));
    }
  }
}

/** Half of the pixels two away from a pixel, as offsets in memory; the others lie opposite. */
using HalfRing = std::array<std::ptrdiff_t, 6>;

HalfRing halfRing(const cv::Mat& grey)
{
  const auto step = static_cast<std::ptrdiff_t>(grey.step[0]);
  return {2, step + 2, 2 * step + 1, 2 * step, 2 * step - 1, step - 2};
}

/** Rings of pixels around as many places, their values side by side: each of the half ring, and opposite. */
struct Rings
{
  static constexpr int SIZE = 32;

  std::array<std::array<std::int16_t, SIZE>, std::tuple_size<HalfRing>::value> here, opposite;
};

/** Which of the rings are symmetric to their centre, and no noise. */
OMR_VECTORIZED void judgeSymmetry(const Rings& rings, int min_range, std::array<int, Rings::SIZE>& is_symmetric)
{
  std::array<std::int16_t, Rings::SIZE> least = rings.here[0];
  std::array<std::int16_t, Rings::SIZE> most = least;
  std::array<std::int16_t, Rings::SIZE> largest{};
  std::array<std::int16_t, Rings::SIZE> sum{};
  for (std::size_t k = 0; k < rings.here.size(); ++k)
  {
    for (int i = 0; i < Rings::SIZE; ++i)
    {
      const std::int16_t a = rings.here[k][i];
      const std::int16_t b = rings.opposite[k][i];
      const std::int16_t low = std::min(a, b);
      const std::int16_t high = std::max(a, b);
      const auto difference = static_cast<std::int16_t>(high - low);
      least[i] = std::min(least[i], low);
      most[i] = std::max(most[i], high);
      largest[i] = std::max(largest[i], difference);
      sum[i] = static_cast<std::int16_t>(sum[i] + difference);
    }
  }
  for (int i = 0; i < Rings::SIZE; ++i)
  {
    const auto range = static_cast<float>(most[i] - least[i]);
    is_symmetric[i] = (range >= static_cast<float>(min_range)) &
                              (static_cast<float>(largest[i]) <= MAX_ASYMMETRY * range) &
                              (static_cast<float>(sum[i]) <= 2.2F * MAX_ASYMMETRY * range)
                          ? 1
                          : 0;
  }
}

struct Point
{
  std::int16_t response;
  cv::Point place;
};

/** Adds the candidates whose surroundings are symmetric, in their order; looks at many at once. */
class Candidates
{
 public:
  Candidates(const cv::Mat& grey, int min_range, std::vector<Point>& found)
      : grey_(grey), ring_(halfRing(grey)), min_range_(min_range), found_(found)
  {
  }

  void add(std::int16_t response, const cv::Point& place)
  {
    const uchar* pixel = grey_.ptr<uchar>(place.y) + place.x;
    for (std::size_t k = 0; k < ring_.size(); ++k)
    {
      rings_.here[k][count_] = pixel[ring_[k]];
      rings_.opposite[k][count_] = pixel[-ring_[k]];
    }
    points_[count_] = {response, place};
    if (++count_ == Rings::SIZE)
    {
      judge();
    }
  }

  /** Adds what waits. */
  void judge()
  {
    std::array<int, Rings::SIZE> is_symmetric;
    judgeSymmetry(rings_, min_range_, is_symmetric);
    for (int i = 0; i < count_; ++i)
    {
      if (is_symmetric[i] != 0)
      {
        found_.push_back(points_[i]);
      }
    }
    count_ = 0;
  }

 private:
  const cv::Mat& grey_;
  HalfRing ring_;
  int min_range_;
  std::vector<Point>& found_;
  Rings rings_{};
  std::array<Point, Rings::SIZE> points_;
  int count_ = 0;
};

/** The saddle points of the rows [from, to). */
void findInRows(const cv::Mat& grey, const Threshold& least, int from, int to, std::vector<Point>& found)
{
  const int width = grey.cols;
  Candidates candidates(grey, least.range, found);
  RowBuffer of_values(width);
  RowBuffer of_responses(width + BLOCK);  // the last block of a row may end beyond it
  Rows values = of_values.rows();
  Rows responses = of_responses.rows();
  std::vector<int> blocks(width / BLOCK + 1);
  for (int y = from - 2; y <= to + 1; ++y)  // the row below that of the newest response
  {
    std::rotate(values.begin(), values.begin() + 1, values.end());
    widen(grey.ptr<uchar>(y), width, values[2]);
    if (y < from)
    {
      continue;
    }
    std::rotate(responses.begin(), responses.begin() + 1, responses.end());
    respond(values[0], values[1], values[2], width, responses[2]);
    if (y > from + 1)
    {
      forEachMaximum(responses, width, least.response, blocks, [&](int x) {
        candidates.add(responses[1][x], {x, y - 2});
      });
    }
  }
  candidates.judge();
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
