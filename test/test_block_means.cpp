#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "targets/block_means.h"

namespace
{
cv::Mat randomImage(const cv::Size& size, int side)
{
  cv::RNG random(side);
  cv::Mat image(size, CV_8UC3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

// Blocks of an even number of pixels have means that lie in the middle between two grey levels.
TEST(BlockMeans, AreThoseOfTheLibrary)
{
  for (int side = 2; side <= 12; ++side)
  {
    const cv::Size size(53, 37);
    const cv::Mat image = randomImage(cv::Size(size.width * side + 1, size.height * side + side - 1), side);
    cv::Mat expected;
    cv::resize(image(cv::Rect(cv::Point(), size * side)), expected, size, 0, 0, cv::INTER_AREA);
    EXPECT_EQ(0, cv::norm(expected, omr::blockMeans(image, side, size), cv::NORM_INF)) << side;
  }
}

TEST(BlockMeans, HoldTheLargestSums)
{
  constexpr int SIDE = 257;
  const cv::Mat white(2 * SIDE, SIDE, CV_8UC3, cv::Scalar::all(255));
  const cv::Mat means = omr::blockMeans(white, SIDE, cv::Size(1, 2));
  EXPECT_EQ(0, cv::norm(means, cv::Mat(2, 1, CV_8UC3, cv::Scalar::all(255)), cv::NORM_INF));
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
