#include "image_input.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace omr
{
namespace
{
namespace enc = sensor_msgs::image_encodings;

/** The colour encoding of the same memory layout; OpenCV's own names say nothing of colours, drivers mean these. */
std::string colorEncoding(const std::string& encoding)
{
  if (encoding == enc::TYPE_8UC1)
  {
    return enc::MONO8;
  }
  if (encoding == enc::TYPE_8UC3)
  {
    return enc::BGR8;
  }
  return encoding == enc::TYPE_8UC4 ? enc::BGRA8 : encoding;
}

std::size_t bytesPerPixel(const std::string& encoding)
{
  if (!enc::isColor(encoding) && !enc::isMono(encoding) && !enc::isBayer(encoding) && encoding != enc::YUV422)
  {
    throw std::invalid_argument("the encoding '" + encoding +
                                "' is not supported; use mono, rgb, bgr, rgba, bgra or bayer of 8 or 16 bits, or "
                                "yuv422");
  }
  return static_cast<std::size_t>(enc::numChannels(encoding)) * enc::bitDepth(encoding) / 8;
}

void checkSizes(const sensor_msgs::Image& message, const std::string& encoding)
{
  const std::uint64_t width = message.width;
  const std::uint64_t height = message.height;
  const std::uint64_t row = width * bytesPerPixel(encoding);
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width == 0 || height == 0)
  {
    throw std::invalid_argument("the image is empty: " + size);
  }
  if (width * height > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
  {
    throw std::invalid_argument("the image has more than 2^31 - 1 pixels: " + size);
  }
  if (message.step < row)
  {
    throw std::invalid_argument("step is " + std::to_string(message.step) + " bytes, but a row of " +
                                std::to_string(width) + " pixels of '" + message.encoding + "' takes " +
                                std::to_string(row));
  }
  if (message.data.size() != height * message.step)
  {
    throw std::invalid_argument("data has " + std::to_string(message.data.size()) + " bytes, but height * step is " +
                                std::to_string(height * message.step));
  }
  if (enc::bitDepth(encoding) == 16 && message.step % 2 != 0)
  {
    throw std::invalid_argument("step is " + std::to_string(message.step) + " bytes, which cuts a 16-bit value");
  }
  if (encoding == enc::YUV422 && width % 2 != 0)
  {
    throw std::invalid_argument("yuv422 has pixels in pairs, but the width is " + std::to_string(width));
  }
}

bool nativeIsBigEndian()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const std::uint8_t*>(&one) == 0;
}

/** A copy of the message with the bytes of each 16-bit value swapped. */
sensor_msgs::ImageConstPtr swapBytes(const sensor_msgs::Image& message)
{
  auto swapped = boost::make_shared<sensor_msgs::Image>(message);
  for (std::size_t i = 0; i + 1 < swapped->data.size(); i += 2)
  {
    std::swap(swapped->data[i], swapped->data[i + 1]);
  }
  swapped->is_bigendian = message.is_bigendian == 0 ? 1 : 0;
  return swapped;
}
}  // namespace

cv::Mat toBgr(const sensor_msgs::ImageConstPtr& message)
{
  const std::string encoding = colorEncoding(message->encoding);
  checkSizes(*message, encoding);
  const bool foreign = enc::bitDepth(encoding) == 16 && (message->is_bigendian != 0) != nativeIsBigEndian();
  const cv_bridge::CvImageConstPtr raw = cv_bridge::toCvShare(foreign ? swapBytes(*message) : message);
  if (encoding == enc::BGR8)
  {
    return raw->image;
  }
  const auto named = boost::make_shared<cv_bridge::CvImage>(message->header, encoding, raw->image);
  return cv_bridge::cvtColor(named, enc::BGR8)->image;
}

}  // namespace omr
