#include "saddle_points.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <opencv2/imgproc.hpp>
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

/** 2 Ix of a row. */
OMR_VECTORIZED void findSlopes(const uchar* __restrict row, int width, std::int16_t* __restrict slope)
{
  for (int x = 1; x < width - 1; ++x)
  {
    slope[x] = static_cast<std::int16_t>(row[x + 1] - row[x - 1]);
  }
}

/** The rows around a row: grey values, and 2 Ix of those above and below. */
struct Surroundings
{
  const uchar *above, *here, *below;
  const std::int16_t *slope_above, *slope_below;
};

/** 4 (Ixy^2 - Ixx Iyy) of a row, saturated; positive at saddle points. The whole image passes through here. */
OMR_VECTORIZED void respond(const Surroundings& rows, int width, std::int16_t* __restrict response)
{
  const uchar* __restrict above = rows.above;
  const uchar* __restrict here = rows.here;
  const uchar* __restrict below = rows.below;
  const std::int16_t* __restrict slope_above = rows.slope_above;
  const std::int16_t* __restrict slope_below = rows.slope_below;
  for (int x = 1; x < width - 1; ++x)
  {
    const auto xx = static_cast<std::int16_t>(here[x - 1] + here[x + 1] - 2 * here[x]);
    const auto yy = static_cast<std::int16_t>(above[x] + below[x] - 2 * here[x]);
    const auto xy = static_cast<std::int16_t>(slope_below[x] - slope_above[x]);  // 4 Ixy
    const int value = (xy * xy - 16 * (xx * yy)) >> 2;
    response[x] = static_cast<std::int16_t>(std::max(-32768, std::min(32767, value)));
  }
}

/** The largest of each response and its two neighbours in the row. */
OMR_VECTORIZED void largestOfThree(const std::int16_t* __restrict response, int width, std::int16_t* __restrict largest)
{
  for (int x = 1; x < width - 1; ++x)
  {
    largest[x] = std::max(std::max(response[x - 1], response[x + 1]), response[x]);
  }
}

/**
 * Which responses exceed the least and are maxima of 3 x 3; of two equal neighbours the first one counts.
 *
 * @param above, below largestOfThree() of those rows.
 */
OMR_VECTORIZED void markMaxima(const std::int16_t* __restrict response, const std::int16_t* __restrict above,
                               const std::int16_t* __restrict below, int width, int least, uchar* __restrict marks)
{
  const auto threshold = static_cast<std::int16_t>(least);
  for (int x = MARGIN; x < width - MARGIN; ++x)
  {
    const std::int16_t before = std::max(std::max(above[x], response[x - 1]), threshold);
    const std::int16_t after = std::max(below[x], response[x + 1]);
    marks[x] = static_cast<uchar>((response[x] > before) & (response[x] >= after));
  }
}

/** Calls the action for every x with a mark, on little-endian machines. @param marks 0 or 1, in whole words */
template <typename Action>
void forEachMark(const std::vector<uchar>& marks, const Action& action)
{
  constexpr std::size_t WORD = sizeof(std::uint64_t);
  for (std::size_t first = 0; first < marks.size(); first += WORD)
  {
    std::uint64_t word;
    std::memcpy(&word, &marks[first], WORD);
    for (; word != 0; word &= word - 1)
    {
      action(static_cast<int>(first) + __builtin_ctzll(word) / 8);
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
  std::vector<std::int16_t> buffer(8 * static_cast<std::size_t>(width), 0);
  const auto row_of_buffer = [&](int i) { return &buffer[static_cast<std::size_t>(i) * width]; };
  std::array<std::int16_t*, 3> slopes = {row_of_buffer(0), row_of_buffer(1), row_of_buffer(2)};
  std::array<std::int16_t*, 2> responses = {row_of_buffer(3), row_of_buffer(4)};
  std::array<std::int16_t*, 3> largest = {row_of_buffer(5), row_of_buffer(6), row_of_buffer(7)};
  std::vector<uchar> marks((static_cast<std::size_t>(width) + 7) / 8 * 8, 0);
  findSlopes(grey.ptr<uchar>(from - 2), width, slopes[1]);
  findSlopes(grey.ptr<uchar>(from - 1), width, slopes[2]);
  for (int y = from - 1; y <= to; ++y)
  {
    std::swap(responses[0], responses[1]);
    std::rotate(slopes.begin(), slopes.begin() + 1, slopes.end());
    std::rotate(largest.begin(), largest.begin() + 1, largest.end());
    findSlopes(grey.ptr<uchar>(y + 1), width, slopes[2]);
    respond({grey.ptr<uchar>(y - 1), grey.ptr<uchar>(y), grey.ptr<uchar>(y + 1), slopes[0], slopes[2]}, width,
            responses[1]);
    largestOfThree(responses[1], width, largest[2]);
    if (y < from + 1)
    {
      continue;
    }
    markMaxima(responses[0], largest[0], largest[2], width, least.response, marks.data());
    forEachMark(marks, [&](int x) { candidates.add(responses[0][x], {x, y - 1}); });
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
