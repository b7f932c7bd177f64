#ifndef OUTDOOR_OMR_CORE_GREY_SAMPLES_H
#define OUTDOOR_OMR_CORE_GREY_SAMPLES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>

#include "local_frame.h"
#include "vectorized.h"

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
OMR_PART_OF_VECTORIZED void sampleGreys(const cv::Mat& grey, const SamplePlaces<SIZE>& places,
                                        std::array<float, SIZE>& values)
{
  const float last_x = lastPlace(grey.cols);
  const float last_y = lastPlace(grey.rows);
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
  // Two bytes at once, of which the lower one is the left.
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "two neighbouring pixels are read as one number");
  std::array<int, SIZE> above;
  std::array<int, SIZE> below;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    std::uint16_t pair;
    std::memcpy(&pair, grey.data + offset[i], sizeof(pair));
    above[i] = pair;
    std::memcpy(&pair, grey.data + offset[i] + step, sizeof(pair));
    below[i] = pair;
  }
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float a = share.x[i];
    const float b = share.y[i];
    values[i] = (static_cast<float>(above[i] & 255) * (1 - a) + static_cast<float>(above[i] >> 8) * a) * (1 - b) +
                (static_cast<float>(below[i] & 255) * (1 - a) + static_cast<float>(below[i] >> 8) * a) * b;
  }
}

/** What greyLogarithm() takes its values from: those of whole grey levels. */
const std::array<float, 257>& greyLogarithmTable();

/** greyLogarithm() of all values; to be called from a function that is OMR_VECTORIZED. */
template <std::size_t SIZE>
OMR_PART_OF_VECTORIZED void greyLogarithms(const std::array<float, 257>& table, const std::array<float, SIZE>& grey,
                                           std::array<float, SIZE>& logarithms)
{
  std::array<int, SIZE> level;
  std::array<float, SIZE> lower;
  std::array<float, SIZE> upper;
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    level[i] = static_cast<int>(grey[i]);
  }
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    lower[i] = table[level[i]];
    upper[i] = table[level[i] + 1];
  }
  for (std::size_t i = 0; i < SIZE; ++i)
  {
    const float rest = grey[i] - static_cast<float>(level[i]);
    logarithms[i] = lower[i] * (1 - rest) + upper[i] * rest;
  }
}

}  // namespace omr

#endif
