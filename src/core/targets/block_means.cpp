#include "block_means.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vectorized.h"

namespace omr
{
namespace
{
constexpr int CHANNELS = 3;

/** Adds a row of values to the sums of those above. */
OMR_VECTORIZED void addRow(const uchar* __restrict row, int count, std::uint16_t* __restrict sums)
{
  for (int i = 0; i < count; ++i)
  {
    sums[i] = static_cast<std::uint16_t>(sums[i] + row[i]);
  }
}

/** Adds the sums of the columns to the right of each: of all columns, so that they are added side by side. */
OMR_VECTORIZED void addColumns(const std::uint16_t* __restrict sums, int side, int count,
                               std::int32_t* __restrict totals)
{
  for (int j = 0; j < side; ++j)
  {
    const std::uint16_t* __restrict right = sums + CHANNELS * j;
    for (int i = 0; i < count; ++i)
    {
      totals[i] = (j > 0 ? totals[i] : 0) + right[i];
    }
  }
}
}  // namespace

cv::Mat blockMeans(const cv::Mat& bgr, int side, const cv::Size& size)
{
  cv::Mat means;
  if (side == 2)  // what the library takes side by side
  {
    cv::resize(bgr(cv::Rect(cv::Point(), size * side)), means, size, 0, 0, cv::INTER_AREA);
    return means;
  }
  means.create(size, CV_8UC3);
  const float scale = 1.F / static_cast<float>(side * side);
  const int count = size.width * side * CHANNELS;
  cv::parallel_for_(cv::Range(0, size.height), [&](const cv::Range& range) {
    std::vector<std::uint16_t> sums(count);
    std::vector<std::int32_t> totals(count);
    for (int y = range.start; y < range.end; ++y)
    {
      std::fill(sums.begin(), sums.end(), std::uint16_t{0});
      for (int i = 0; i < side; ++i)
      {
        addRow(bgr.ptr<uchar>(y * side + i), count, sums.data());
      }
      addColumns(sums.data(), side, count - CHANNELS * (side - 1), totals.data());
      auto* mean = means.ptr<uchar>(y);
      for (int x = 0; x < count; x += CHANNELS * side)
      {
        for (int c = 0; c < CHANNELS; ++c)
        {
          *mean++ = static_cast<uchar>(cvRound(static_cast<float>(totals[x + c]) * scale));
        }
      }
    }
  });
  return means;
}

}  // namespace omr
