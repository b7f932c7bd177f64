#ifndef OUTDOOR_OMR_CORE_PIXEL_SET_H
#define OUTDOOR_OMR_CORE_PIXEL_SET_H

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** A bit for each pixel of an image and of a border: so small that it stays in the processor's nearest cache. */
class PixelSet
{
 public:
  static constexpr int REACH = 2;  ///< width of the border, and how far around() looks [px]
  static constexpr int SIDE = 2 * REACH + 1;
  static constexpr std::uint32_t NEAREST = 0x729C0;  ///< of around(): the eight pixels that touch this one

  /** @param size of the image; the set is empty. */
  explicit PixelSet(const cv::Size& size)
      : stride_((size.width + 2 * REACH) / 8 + 4), bytes_(static_cast<std::size_t>(stride_) * (size.height + 2 * REACH))
  {
  }

  void set(const cv::Point& pixel)
  {
    bytes_[at(pixel)] |= 1U << ((pixel.x + REACH) % 8);
  }

  void reset(const cv::Point& pixel)
  {
    bytes_[at(pixel)] &= ~(1U << ((pixel.x + REACH) % 8));
  }

  /** The pixels up to REACH away, row by row from the top left, SIDE bits each. */
  std::uint32_t around(const cv::Point& pixel) const
  {
    std::uint32_t bits = 0;
    const std::uint8_t* row = &bytes_[static_cast<std::size_t>(pixel.y) * stride_ + pixel.x / 8];
    for (int i = 0; i < SIDE; ++i, row += stride_)
    {
      const std::uint32_t word = row[0] | static_cast<std::uint32_t>(row[1]) << 8;
      bits |= (word >> (pixel.x % 8) & ((1U << SIDE) - 1)) << (SIDE * i);
    }
    return bits;
  }

 private:
  std::size_t at(const cv::Point& pixel) const
  {
    return static_cast<std::size_t>(pixel.y + REACH) * stride_ + (pixel.x + REACH) / 8;
  }

  int stride_;  // [bytes]
  std::vector<std::uint8_t> bytes_;
};

}  // namespace omr

#endif
