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

/** The means of blocks whose columns are summed up. */
void meansOf(const std::uint16_t* sums, int side, int width, uchar* means)
{
  const float scale = 1.F / static_cast<float>(side * side);
  for (int x = 0; x < width; ++x, sums += CHANNELS * side)
  {
    for (int c = 0; c < CHANNELS; ++c)
    {
      std::int32_t sum = 0;
      for (int j = 0; j < side; ++j)
      {
        sum += sums[CHANNELS * j + c];
      }
      *means++ = cv::saturate_cast<uchar>(static_cast<float>(sum) * scale);
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
  cv::parallel_for_(cv::Range(0, size.height), [&](const cv::Range& range) {
    std::vector<std::uint16_t> sums(static_cast<std::size_t>(size.width) * side * CHANNELS);
    for (int y = range.start; y < range.end; ++y)
    {
      std::fill(sums.begin(), sums.end(), std::uint16_t{0});
      for (int i = 0; i < side; ++i)
      {
        addRow(bgr.ptr<uchar>(y * side + i), static_cast<int>(sums.size()), sums.data());
      }
      meansOf(sums.data(), side, size.width, means.ptr<uchar>(y));
    }
  });
  return means;
}

}  // namespace omr
