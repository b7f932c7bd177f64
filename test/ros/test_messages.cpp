#include <gtest/gtest.h>

#include <cmath>

#include "messages.h"

using omr::Checkerboard;
using omr::Target;

namespace
{
std_msgs::Header header()
{
  std_msgs::Header result;
  result.seq = 7;
  result.stamp = ros::Time(12, 34);
  result.frame_id = "camera";
  return result;
}

/** A board of 3 x 4 squares whose numbers are all different. */
Checkerboard board()
{
  Checkerboard result;
  result.rows = 3;
  result.cols = 4;
  for (int i = 0; i < 4; ++i)
  {
    result.corners[i] = cv::Point2f(100.F + i, 200.25F + i);
  }
  for (int i = 0; i < 6; ++i)
  {
    result.inner_corners.emplace_back(10.5F + i, 20.F + i);
    result.inner_corners_seen.push_back(i != 4);
  }
  for (int i = 0; i < 12; ++i)
  {
    result.squares_seen.push_back(i % 3 != 0);
  }
  result.regularity = 0.75;
  result.size_certain = false;
  return result;
}

outdoor_omr::Ellipse ellipse(const cv::RotatedRect& rectangle)
{
  Target target;
  target.colors = "W";
  target.rings = {rectangle};
  return omr::toMessage(header(), cv::Size(640, 480), std::vector<Target>{target}).targets.at(0).rings.at(0);
}

/** Where the end of an ellipse's longer axis lies, from its centre. */
cv::Point2d tip(const outdoor_omr::Ellipse& e)
{
  return cv::Point2d(std::cos(e.angle), std::sin(e.angle)) * (e.major_axis / 2);
}
}  // namespace

TEST(Messages, copiesHeaderAndSizeAlsoWhenThereIsNothing)
{
  const auto boards = omr::toMessage(header(), cv::Size(640, 480), std::vector<Checkerboard>());
  const auto targets = omr::toMessage(header(), cv::Size(640, 480), std::vector<Target>());
  EXPECT_EQ(header(), boards.header);
  EXPECT_EQ(header(), targets.header);
  EXPECT_EQ(640U, boards.width);
  EXPECT_EQ(480U, boards.height);
  EXPECT_EQ(640U, targets.width);
  EXPECT_EQ(480U, targets.height);
  EXPECT_TRUE(boards.checkerboards.empty());
  EXPECT_TRUE(targets.targets.empty());
}

TEST(Messages, copiesEveryFieldOfACheckerboard)
{
  const Checkerboard first = board();
  const auto array = omr::toMessage(header(), cv::Size(640, 480), std::vector<Checkerboard>{first, Checkerboard()});
  ASSERT_EQ(2U, array.checkerboards.size());
  const auto& message = array.checkerboards[0];
  EXPECT_EQ(3U, message.rows);
  EXPECT_EQ(4U, message.cols);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(first.corners[i], cv::Point2f(message.corners[i].x, message.corners[i].y));
  }
  ASSERT_EQ(first.inner_corners.size(), message.inner_corners.size());
  ASSERT_EQ(first.inner_corners.size(), message.inner_corners_seen.size());
  for (std::size_t i = 0; i < first.inner_corners.size(); ++i)
  {
    EXPECT_EQ(first.inner_corners[i], cv::Point2f(message.inner_corners[i].x, message.inner_corners[i].y));
    EXPECT_EQ(first.inner_corners_seen[i], message.inner_corners_seen[i] != 0);
  }
  ASSERT_EQ(first.squares_seen.size(), message.squares_seen.size());
  for (std::size_t i = 0; i < first.squares_seen.size(); ++i)
  {
    EXPECT_EQ(first.squares_seen[i], message.squares_seen[i] != 0);
  }
  EXPECT_EQ(0.75F, message.regularity);
  EXPECT_FALSE(message.size_certain);
  EXPECT_TRUE(array.checkerboards[1].size_certain);
}

TEST(Messages, sectionsAreNotAmongTheBoards)
{
  const auto array = omr::toMessage(header(), cv::Size(640, 480), std::vector<Checkerboard>{Checkerboard()},
                                    std::vector<Checkerboard>{board()});
  EXPECT_EQ(1U, array.checkerboards.size());
  ASSERT_EQ(1U, array.sections.size());
  EXPECT_EQ(4U, array.sections[0].cols);
}

TEST(Messages, copiesEveryFieldOfATarget)
{
  Target target;
  target.colors = "RW?";
  target.center = cv::Point2f(33.5F, 44.25F);
  for (int i = 1; i <= 3; ++i)
  {
    target.rings.emplace_back(cv::Point2f(30.F + i, 40.F), cv::Size2f(20.F * i, 10.F * i), 30.F);
  }
  target.outermost_deviation = 0.0625;
  const auto array = omr::toMessage(header(), cv::Size(640, 480), std::vector<Target>{target});
  ASSERT_EQ(1U, array.targets.size());
  const auto& message = array.targets[0];
  EXPECT_EQ("RW?", message.colors);
  EXPECT_EQ(33.5F, message.center.x);
  EXPECT_EQ(44.25F, message.center.y);
  EXPECT_EQ(0.0625F, message.outermost_deviation);
  ASSERT_EQ(3U, message.rings.size());
  for (int i = 1; i <= 3; ++i)
  {
    EXPECT_EQ(30.F + i, message.rings[i - 1].center.x);
    EXPECT_EQ(20.F * i, message.rings[i - 1].major_axis);
    EXPECT_EQ(10.F * i, message.rings[i - 1].minor_axis);
    EXPECT_NEAR(CV_PI / 6, message.rings[i - 1].angle, 1e-6);
  }
}

TEST(Messages, givesTheAngleOfTheLongerAxisWithinHalfATurn)
{
  for (int degrees = -360; degrees <= 360; degrees += 15)
  {
    for (const bool upright : {false, true})
    {
      const cv::Size2f size = upright ? cv::Size2f(20, 50) : cv::Size2f(50, 20);
      const auto message = ellipse(cv::RotatedRect(cv::Point2f(0, 0), size, static_cast<float>(degrees)));
      EXPECT_EQ(50, message.major_axis);
      EXPECT_EQ(20, message.minor_axis);
      EXPECT_GE(message.angle, 0);
      EXPECT_LT(message.angle, CV_PI);
      const double along = (degrees + (upright ? 90 : 0)) * CV_PI / 180;
      const cv::Point2d expected(25 * std::cos(along), 25 * std::sin(along));
      const double miss = std::min(cv::norm(tip(message) - expected), cv::norm(tip(message) + expected));
      EXPECT_LT(miss, 1e-4) << degrees << " degrees";
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
