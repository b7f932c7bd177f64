#include "outdoor_omr/frame.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace
{
cv::Mat noise(const cv::Size& size)
{
  cv::Mat picture(size, CV_8UC3);
  cv::RNG(7).fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

void expectEqual(const omr::Frame& frame, const omr::Frame& other)
{
  EXPECT_EQ(cv::norm(frame.raw_grey, other.raw_grey, cv::NORM_INF), 0);
  ASSERT_EQ(frame.grey.size(), other.grey.size());
  for (std::size_t level = 0; level < frame.grey.size(); ++level)
  {
    EXPECT_EQ(cv::norm(frame.grey[level], other.grey[level], cv::NORM_INF), 0);
  }
}
}  // namespace

TEST(Frame, hasLevelsOfHalfTheSizeDownToEightyPixels)
{
  const omr::Frame frame = omr::makeFrame(noise({645, 300}));
  ASSERT_EQ(frame.grey.size(), 4U);
  EXPECT_EQ(frame.grey[3].cols, 81);
  EXPECT_EQ(omr::makeFrame(noise({150, 300})).grey.size(), 1U);
  EXPECT_EQ(omr::makeFrame(noise({4000, 16})).grey.size(), 5U);
}

TEST(Frame, nextImageOfTheSameSizeIsMadeInTheSameMemory)
{
  omr::Frame frame = omr::makeFrame(cv::Mat::zeros(480, 640, CV_8UC3));
  const uchar* const raw_grey = frame.raw_grey.data;
  const uchar* const coarsest = frame.grey.back().data;
  const cv::Mat picture = noise({640, 480});
  omr::makeFrame(picture, frame);
  EXPECT_EQ(frame.raw_grey.data, raw_grey);
  EXPECT_EQ(frame.grey.back().data, coarsest);
  expectEqual(frame, omr::makeFrame(picture));
}

TEST(Frame, nextImageMayHaveAnotherSize)
{
  omr::Frame frame = omr::makeFrame(noise({640, 480}));
  for (const cv::Size& size : {cv::Size(150, 90), cv::Size(800, 600)})
  {
    omr::makeFrame(noise(size), frame);
    expectEqual(frame, omr::makeFrame(noise(size)));
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
