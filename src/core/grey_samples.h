#ifndef OUTDOOR_OMR_CORE_GREY_SAMPLES_H
#define OUTDOOR_OMR_CORE_GREY_SAMPLES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>

namespace omr
{
/** Where samples of a level lie [px]. */
template <std::size_t SIZE>
struct SamplePlaces
{
  std::array<float, SIZE> x, y;
};

/** sampleGrey() of all places; to be called from a function that is OMR_VECTORIZED. */
template <std::size_t SIZE>
inline void sampleGreys(const cv::Mat& grey, const SamplePlaces<SIZE>& places, std::array<float, SIZE>& values)
{
  const float last_x = static_cast<float>(grey.cols) - 1.001F;
  const float last_y = static_cast<float>(grey.rows) - 1.001F;
  const auto step = static_cast<int>(grey.step[0]);
  std::array<int, SIZE> offset;
  SamplePlaces<SIZE> share;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float x = std::min(std::max(places.x[i], 0.F), last_x);
    const float y = std::min(std::max(places.y[i], 0.F), last_y);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    share.x[i] = x - static_cast<float>(column);
    share.y[i] = y - static_cast<float>(row);
    offset[i] = row * step + column;
  }
  std::array<std::array<int, SIZE>, 4> pixels;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const uchar* above = grey.data + offset[i];
    const uchar* below = above + step;
    pixels[0][i] = above[0];
    pixels[1][i] = above[1];
    pixels[2][i] = below[0];
    pixels[3][i] = below[1];
  }
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float a = share.x[i];
    const float b = share.y[i];
    values[i] = (static_cast<float>(pixels[0][i]) * (1 - a) + static_cast<float>(pixels[1][i]) * a) * (1 - b) +
                (static_cast<float>(pixels[2][i]) * (1 - a) + static_cast<float>(pixels[3][i]) * a) * b;
  }
}

}  // namespace omr

#endif
