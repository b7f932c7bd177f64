#include "targets/candidate/ring_places.h"

#include <gtest/gtest.h>

using omr::Checkerboard;
using omr::isOnBoard;

namespace
{
/** 7 x 9 squares of 40 px, its top left corner at (100, 50). */
Checkerboard board()
{
  Checkerboard result;
  result.rows = 7;
  result.cols = 9;
  result.corners = {cv::Point2f(100, 50), cv::Point2f(460, 50), cv::Point2f(460, 330), cv::Point2f(100, 330)};
  for (int row = 1; row < result.rows; ++row)
  {
    for (int col = 1; col < result.cols; ++col)
    {
      result.inner_corners.emplace_back(100.F + 40 * static_cast<float>(col), 50.F + 40 * static_cast<float>(row));
    }
  }
  result.inner_corners_seen.assign(result.inner_corners.size(), true);
  return result;
}
}  // namespace

TEST(RingPlaces, onABoardIsWhereItShows)
{
  for (const cv::Point2d& inside : {cv::Point2d(280, 190), cv::Point2d(299, 211), cv::Point2d(110, 60), {450, 320}})
  {
    EXPECT_TRUE(isOnBoard(inside, {board()})) << inside;
  }
  EXPECT_FALSE(isOnBoard({90, 190}, {board()}));
  EXPECT_FALSE(isOnBoard({280, 190}, {}));
}

TEST(RingPlaces, whatLiesOnABoardIsNotOnIt)
{
  Checkerboard covered = board();
  for (std::size_t i = 0; i < covered.inner_corners.size(); ++i)
  {
    covered.inner_corners_seen[i] = cv::norm(covered.inner_corners[i] - cv::Point2f(280, 190)) > 70;
  }
  EXPECT_FALSE(isOnBoard({280, 190}, {covered}));
  EXPECT_TRUE(isOnBoard({380, 190}, {covered}));
  EXPECT_TRUE(isOnBoard({280, 190}, {covered, board()}));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
