#include "checkerboards/seeds/saddle_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace
{
constexpr int SQUARE = 9;  // px, odd: the corners fall on every row modulo 8

/** Squares all over the image, with corners on the pixels: they lie where the threads' parts meet, too. */
cv::Mat squares(const cv::Size& size)
{
  cv::Mat grey(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      const int column = x % SQUARE == 0 ? 0 : x / SQUARE % 2 == 0 ? 1 : -1;
      const int row = y % SQUARE == 0 ? 0 : y / SQUARE % 2 == 0 ? 1 : -1;
      grey.at<uchar>(y, x) = static_cast<uchar>(120 + 80 * column * row);
    }
  }
  cv::GaussianBlur(grey, grey, cv::Size(3, 3), 0);
  return grey;
}
}  // namespace

TEST(SaddlePoints, eachCornerOnceWhereverTheThreadsMeet)
{
  for (const int height : {16, 17, 100, 243})
  {
    const cv::Mat grey = squares({157, height});
    const std::vector<cv::Point> points = omr::findSaddlePoints(grey, false, 10000);
    const auto corners = [](int length) {
      constexpr int MARGIN = 4;  // px without saddle points
      int count = 0;
      for (int x = SQUARE; x < length - MARGIN; x += SQUARE)
      {
        ++count;
      }
      return count;
    };
    const int expected = corners(157) * corners(height);
    EXPECT_EQ(expected, static_cast<int>(points.size())) << height;
    for (const cv::Point& point : points)
    {
      EXPECT_EQ(0, point.x % SQUARE) << point;
      EXPECT_EQ(0, point.y % SQUARE) << point;
    }
  }
}

TEST(SaddlePoints, areInOrderOfTheirPixelsForAnyNumberOfThreads)
{
  cv::Mat grey = squares({300, 211});
  cv::Mat noise(grey.size(), CV_8UC1);
  cv::RNG(9).fill(noise, cv::RNG::UNIFORM, 0, 30);
  grey += noise;
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const std::vector<cv::Point> alone = omr::findSaddlePoints(grey, true, 100000);
  cv::setNumThreads(3);
  const std::vector<cv::Point> shared = omr::findSaddlePoints(grey, true, 100000);
  cv::setNumThreads(threads);
  EXPECT_GT(alone.size(), 700U);
  EXPECT_EQ(alone, shared);
  EXPECT_TRUE(std::is_sorted(shared.begin(), shared.end(), [](const cv::Point& a, const cv::Point& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  }));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
