#include "grown_squares.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "checkerboards/corners/local_frame.h"
#include "median.h"

namespace omr
{
Frame growDarkSquares(const Frame& frame, const ErodedPart& part, ResizedPart& resized)
{
  constexpr float GROWN_SQUARE = 16;  // px
  // Squares whose corners are round touch where their sides overlap a little.
  constexpr float OVERLAP = 0.04F;  // squares
  const float factor = GROWN_SQUARE / squareHeight({{}, part.u, part.v});
  resized.factor = factor;
  resized.origin = part.area.tl();
  cv::Mat bgr;
  cv::resize(frame.bgr(part.area), bgr, {}, factor, factor, factor < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  // What the light has taken is given back in the shape of a square: a disk would leave corners round.
  const LocalFrame square{{}, factor * part.u, factor * part.v};
  const float reach = std::max(0.F, (1 - part.width) / 2) + OVERLAP;
  const int size = cvCeil(reach * (length(square.u) + length(square.v)));
  cv::Mat shape(2 * size + 1, 2 * size + 1, CV_8UC1);
  for (int y = -size; y <= size; ++y)
  {
    for (int x = -size; x <= size; ++x)
    {
      const cv::Point2f point(static_cast<float>(x), static_cast<float>(y));
      shape.at<uchar>(y + size, x + size) = squaresBetween(square, point) <= reach ? 1 : 0;
    }
  }
  cv::erode(bgr, bgr, shape);
  return makeFrame(bgr);
}

namespace
{
/** The inner corners of a board along one of its sides, and those beside them further in. */
struct Rim
{
  std::vector<cv::Point2f> outer, inner;
};

std::array<Rim, 4> rimsOf(const Checkerboard& board)
{
  const int rows = board.rows - 1;
  const int cols = board.cols - 1;
  const auto line = [&](int first, int step, int count) {
    std::vector<cv::Point2f> corners(count);
    for (int i = 0; i < count; ++i)
    {
      corners[i] = board.inner_corners[first + i * step];
    }
    return corners;
  };
  const auto row = [&](int index) { return line(index * cols, 1, cols); };
  const auto col = [&](int index) { return line(index, cols, rows); };
  return {{{row(0), row(1)}, {row(rows - 1), row(rows - 2)}, {col(0), col(1)}, {col(cols - 1), col(cols - 2)}}};
}

/** Whether it is darker beyond the light squares of a rim, where dark ones may follow, than beyond the dark ones. */
bool leavesRemnants(const cv::Mat& grey, const Rim& rim)
{
  constexpr float MIN_DIFFERENCE = 5;                // grey levels
  std::array<std::vector<float>, 2> darkest_beyond;  // every other square
  std::array<float, 2> inside = {};
  for (std::size_t i = 0; i + 1 < rim.outer.size(); ++i)
  {
    const cv::Point2f last = 0.5F * (rim.outer[i] + rim.outer[i + 1]);
    const cv::Point2f out = last - 0.5F * (rim.inner[i] + rim.inner[i + 1]);
    const auto at = [&](float depth) {
      const cv::Point2f point = last + depth * out;
      return sampleGrey(grey, point.x, point.y);
    };
    darkest_beyond[i % 2].push_back(std::min({at(1.15F), at(1.25F), at(1.35F), at(1.45F)}));
    inside[i % 2] += at(0.5F);
  }
  const auto mean = [&](std::size_t parity) {
    return inside[parity] / static_cast<float>(darkest_beyond[parity].size());
  };
  const std::size_t dark = mean(0) < mean(1) ? 0 : 1;
  return median(std::move(darkest_beyond[dark])) - median(std::move(darkest_beyond[1 - dark])) > MIN_DIFFERENCE;
}
}  // namespace

bool leavesRemnants(const Frame& frame, const Checkerboard& board)
{
  const std::array<Rim, 4> rims = rimsOf(board);
  return std::any_of(rims.begin(), rims.end(), [&](const Rim& rim) { return leavesRemnants(frame.grey.front(), rim); });
}

}  // namespace omr
