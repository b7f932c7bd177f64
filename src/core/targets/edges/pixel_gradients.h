#ifndef OUTDOOR_OMR_CORE_PIXEL_GRADIENTS_H
#define OUTDOOR_OMR_CORE_PIXEL_GRADIENTS_H

#include <cstddef>
#include <cstdint>
#include <opencv2/core/hal/intrin.hpp>

namespace omr
{
/** Gradients of eight pixels side by side: differences of what lies at both sides of each [grey levels]. */
struct PixelGradients
{
  static constexpr int COUNT = 8;

  /**
   * @param first the leftmost pixel, CV_8UC1, of no outermost row.
   * @param step  from a row to the next [byte].
   */
  PixelGradients(const std::uint8_t* first, std::size_t step)
      : x(load(first + 1) - load(first - 1)), y(load(first + step) - load(first - step))
  {
  }

  static cv::v_int16x8 load(const std::uint8_t* bytes)
  {
    return cv::v_reinterpret_as_s16(cv::v_load_expand(bytes));
  }

  cv::v_int16x8 x, y;
};

}  // namespace omr

#endif
