#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "image_input.h"

namespace enc = sensor_msgs::image_encodings;
using sensor_msgs::Image;

namespace
{
const std::vector<std::string> ENCODINGS = {
    enc::MONO8,        enc::MONO16,       enc::BGR8,         enc::BGR16,       enc::RGB8,        enc::RGB16,
    enc::BGRA8,        enc::BGRA16,       enc::RGBA8,        enc::RGBA16,      enc::TYPE_8UC1,   enc::TYPE_8UC3,
    enc::TYPE_8UC4,    enc::BAYER_RGGB8,  enc::BAYER_BGGR8,  enc::BAYER_GBRG8, enc::BAYER_GRBG8, enc::BAYER_RGGB16,
    enc::BAYER_BGGR16, enc::BAYER_GBRG16, enc::BAYER_GRBG16, enc::YUV422};

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** Four quarters of different colours, 24 x 16. */
cv::Mat quarters()
{
  cv::Mat image(16, 24, CV_8UC3, cv::Scalar(200, 60, 20));
  image(cv::Rect(12, 0, 12, 8)) = cv::Scalar(10, 220, 90);
  image(cv::Rect(0, 8, 12, 8)) = cv::Scalar(30, 40, 250);
  image(cv::Rect(12, 8, 12, 8)) = cv::Scalar(128, 128, 128);
  return image;
}

cv::Mat grey(const cv::Mat& bgr)
{
  cv::Mat result;
  cv::cvtColor(bgr, result, cv::COLOR_BGR2GRAY);
  return result;
}

cv::Mat converted(const cv::Mat& bgr, int code)
{
  cv::Mat result;
  cv::cvtColor(bgr, result, code);
  return result;
}

/** What a sensor under this colour filter would see. @param pattern colours of the top-left 2 x 2 pixels, row by row.
 */
cv::Mat mosaic(const cv::Mat& bgr, const std::string& pattern)
{
  cv::Mat result(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y)
  {
    for (int x = 0; x < bgr.cols; ++x)
    {
      const auto channel = std::string("bgr").find(pattern[2 * (y % 2) + x % 2]);
      result.at<uchar>(y, x) = bgr.at<cv::Vec3b>(y, x)[static_cast<int>(channel)];
    }
  }
  return result;
}

/** Pairs of pixels as U Y V Y (ITU-R BT.601, video range). */
cv::Mat uyvy(const cv::Mat& bgr)
{
  cv::Mat result(bgr.size(), CV_8UC2);
  for (int y = 0; y < bgr.rows; ++y)
  {
    for (int x = 0; x < bgr.cols; ++x)
    {
      const cv::Vec3b color = bgr.at<cv::Vec3b>(y, x);
      const double b = color[0];
      const double g = color[1];
      const double r = color[2];
      const double chroma =
          x % 2 == 0 ? 128 - 0.148 * r - 0.291 * g + 0.439 * b : 128 + 0.439 * r - 0.368 * g - 0.071 * b;
      result.at<cv::Vec2b>(y, x) =
          cv::Vec2b(cv::saturate_cast<uchar>(chroma), cv::saturate_cast<uchar>(16 + 0.257 * r + 0.504 * g + 0.098 * b));
    }
  }
  return result;
}

/** The image's pixels as a camera of this encoding would give them. */
cv::Mat encode(const cv::Mat& bgr, const std::string& encoding)
{
  if (enc::isBayer(encoding))
  {
    cv::Mat result = mosaic(bgr, encoding.substr(6, 4));
    if (enc::bitDepth(encoding) == 16)
    {
      result.convertTo(result, CV_16U, 257);
    }
    return result;
  }
  if (encoding == enc::YUV422)
  {
    return uyvy(bgr);
  }
  cv::Mat result = bgr.clone();
  if (enc::isMono(encoding) || encoding == enc::TYPE_8UC1)
  {
    result = grey(bgr);
  }
  else if (contains(encoding, "rgba"))
  {
    result = converted(bgr, cv::COLOR_BGR2RGBA);
  }
  else if (contains(encoding, "bgra") || encoding == enc::TYPE_8UC4)
  {
    result = converted(bgr, cv::COLOR_BGR2BGRA);
  }
  else if (contains(encoding, "rgb"))
  {
    result = converted(bgr, cv::COLOR_BGR2RGB);
  }
  if (contains(encoding, "16"))
  {
    result.convertTo(result, CV_16U, 257);
  }
  return result;
}

/** @param padding bytes at the end of each row. */
sensor_msgs::ImagePtr message(const cv::Mat& pixels, const std::string& encoding, int padding = 0)
{
  auto result = boost::make_shared<Image>();
  result->width = pixels.cols;
  result->height = pixels.rows;
  result->encoding = encoding;
  const std::size_t row = pixels.cols * pixels.elemSize();
  result->step = row + padding;
  for (int y = 0; y < pixels.rows; ++y)
  {
    result->data.insert(result->data.end(), pixels.ptr(y), pixels.ptr(y) + row);
    result->data.insert(result->data.end(), padding, 77);
  }
  return result;
}

sensor_msgs::ImagePtr quartersMessage(const std::string& encoding)
{
  return message(encode(quarters(), encoding), encoding);
}

/** Largest difference in the inside of the four quarters, 3 px from their borders. */
double difference(const cv::Mat& a, const cv::Mat& b)
{
  double worst = 0;
  for (const cv::Rect& inside :
       {cv::Rect(3, 3, 6, 2), cv::Rect(15, 3, 6, 2), cv::Rect(3, 11, 6, 2), cv::Rect(15, 11, 6, 2)})
  {
    worst = std::max(worst, cv::norm(a(inside), b(inside), cv::NORM_INF));
  }
  return worst;
}

/** The text of the refusal, empty if the image was taken. */
std::string refusal(const sensor_msgs::ImageConstPtr& image)
{
  try
  {
    omr::toBgr(image);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}
}  // namespace

TEST(ImageInput, convertsEveryEncoding)
{
  for (const std::string& encoding : ENCODINGS)
  {
    const bool is_grey = enc::isMono(encoding) || encoding == enc::TYPE_8UC1;
    const cv::Mat expected = is_grey ? converted(grey(quarters()), cv::COLOR_GRAY2BGR) : quarters();
    const auto image = quartersMessage(encoding);
    const cv::Mat bgr = omr::toBgr(image);
    ASSERT_EQ(CV_8UC3, bgr.type()) << encoding;
    ASSERT_EQ(expected.size(), bgr.size()) << encoding;
    // yuv422 rounds to integers twice, in another colour space.
    EXPECT_LE(difference(expected, bgr), encoding == enc::YUV422 ? 3 : 0) << encoding;
  }
}

TEST(ImageInput, readsBothByteOrders)
{
  for (const std::string& encoding : ENCODINGS)
  {
    const auto little = quartersMessage(encoding);
    const auto big = boost::make_shared<Image>(*little);
    big->is_bigendian = 1;
    if (contains(encoding, "16"))
    {
      for (std::size_t i = 0; i < big->data.size(); i += 2)
      {
        big->data[i] ^= 0x5a;  // makes the two bytes of a value differ
        little->data[i] ^= 0x5a;
        std::swap(big->data[i], big->data[i + 1]);
      }
    }
    EXPECT_EQ(0, cv::norm(omr::toBgr(little), omr::toBgr(big), cv::NORM_INF)) << encoding;
  }
}

TEST(ImageInput, skipsThePaddingOfRows)
{
  for (const std::string& encoding : ENCODINGS)
  {
    const cv::Mat pixels = encode(quarters(), encoding);
    const auto plain = message(pixels, encoding);
    const auto padded = message(pixels, encoding, 6);
    EXPECT_EQ(0, cv::norm(omr::toBgr(plain), omr::toBgr(padded), cv::NORM_INF)) << encoding;
  }
}

TEST(ImageInput, copiesNothingThatIsBgrAlready)
{
  for (const std::string& encoding : {enc::BGR8, enc::TYPE_8UC3})
  {
    const auto image = quartersMessage(encoding);
    EXPECT_EQ(image->data.data(), omr::toBgr(image).data) << encoding;
  }
}

TEST(ImageInput, namesWhatItRefuses)
{
  const std::vector<std::pair<std::string, std::function<void(Image&)>>> faults = {
      {"the encoding 'nonsense' is not supported", [](Image& image) { image.encoding = "nonsense"; }},
      {"the encoding '' is not supported", [](Image& image) { image.encoding = ""; }},
      {"the encoding '32FC1' is not supported", [](Image& image) { image.encoding = enc::TYPE_32FC1; }},
      {"the encoding '16UC1' is not supported", [](Image& image) { image.encoding = enc::TYPE_16UC1; }},
      {"the encoding '8UC2' is not supported", [](Image& image) { image.encoding = enc::TYPE_8UC2; }},
      {"the encoding 'bayer_xyzw8' is not supported", [](Image& image) { image.encoding = "bayer_xyzw8"; }},
      {"the image is empty: 0 x 16", [](Image& image) { image.width = 0; }},
      {"the image is empty: 24 x 0", [](Image& image) { image.height = 0; }},
      {"the image is empty: 0 x 0",
       [](Image& image) {
         image = Image();
         image.encoding = enc::BGR8;
       }},
      {"step is 0 bytes, but a row of 24 pixels of 'bgr8' takes 72", [](Image& image) { image.step = 0; }},
      {"step is 71 bytes, but a row", [](Image& image) { image.step = 71; }},
      {"data has 1152 bytes, but height * step is 1168", [](Image& image) { image.step = 73; }},
      {"data has 1151 bytes, but height * step is 1152", [](Image& image) { image.data.pop_back(); }},
      {"data has 0 bytes, but", [](Image& image) { image.data.clear(); }},
      {"data has 1153 bytes, but", [](Image& image) { image.data.push_back(0); }},
      {"step is 72 bytes, but a row of 24 pixels of 'bgr16' takes 144",
       [](Image& image) { image.encoding = enc::BGR16; }},
      {"the image has more than 2^31 - 1 pixels", [](Image& image) { image.width = image.height = 0xffffffff; }},
      {"the image has more than 2^31 - 1 pixels", [](Image& image) { image.height = 0xffffffff; }},
      // 65536 * 65536 is 0 in 32 bits.
      {"data has 0 bytes, but height * step is 4294967296",
       [](Image& image) {
         image.width = 1;
         image.height = image.step = 65536;
         image.data.clear();
       }},
  };
  for (const auto& fault : faults)
  {
    const auto image = quartersMessage(enc::BGR8);
    fault.second(*image);
    const std::string text = refusal(image);
    EXPECT_TRUE(contains(text, fault.first)) << "expected: " << fault.first << "\nsaid: " << text;
  }
}

TEST(ImageInput, refusesRowsThatCutAValueOrAPair)
{
  const cv::Mat pixels(4, 4, CV_16UC1, cv::Scalar(0));
  EXPECT_TRUE(contains(refusal(message(pixels, enc::MONO16, 1)), "cuts a 16-bit value"));
  EXPECT_TRUE(contains(refusal(message(cv::Mat(4, 5, CV_8UC2, cv::Scalar(0)), enc::YUV422)), "in pairs"));
}

TEST(ImageInput, takesOrRefusesTheSmallestImages)
{
  for (const std::string& encoding : ENCODINGS)
  {
    for (int size = 0; size < 16; ++size)
    {
      const cv::Size shape(1 + size % 4, 1 + size / 4);
      const cv::Mat pixels = encode(cv::Mat(shape, CV_8UC3, cv::Scalar(9, 99, 199)), encoding);
      const auto image = message(pixels, encoding);
      if (refusal(image).empty())
      {
        EXPECT_EQ(shape, omr::toBgr(image).size()) << encoding;
      }
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
