#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "part_messages.h"
#include "pose_messages.h"

using outdoor_omr::PartArray;

namespace
{
/** Two copies of a plate. */
PartArray platesAt(double stamp, double a, double b)
{
  PartArray parts;
  parts.header.stamp = ros::Time(stamp);
  parts.header.frame_id = "camera";
  for (const double x : {a, b})
  {
    parts.parts.emplace_back();
    parts.parts.back().name = "plate";
    parts.parts.back().pose = omr::toMessage(
        omr::PoseEstimate{cv::Affine3d(cv::Vec3d(0.1, 0.2, 0.3), cv::Vec3d(x, 0, 1)), cv::Matx66d::eye() * 1e-6});
  }
  return parts;
}

TEST(PartMessages, poseComesBackAsItWent)
{
  const omr::PoseEstimate estimate{cv::Affine3d(cv::Vec3d(-2, 1, 0.5), cv::Vec3d(1, 2, 3)), cv::Matx66d::eye() * 2};
  const omr::PoseEstimate back = omr::fromMessage(omr::toMessage(estimate));
  EXPECT_LT(cv::norm(back.pose.matrix - estimate.pose.matrix), 1e-12);
  EXPECT_EQ(cv::norm(back.covariance - estimate.covariance), 0);
}

TEST(PartMessages, sectionsFollowTheBoards)
{
  outdoor_omr::CheckerboardArray message;
  for (const int cols : {3, 4})
  {
    outdoor_omr::Checkerboard board;
    board.rows = 3;
    board.cols = cols;
    board.inner_corners.resize(2 * (cols - 1));
    board.inner_corners_seen.assign(2 * (cols - 1), 1U);
    (cols == 3 ? message.sections : message.checkerboards).push_back(board);
  }
  const std::vector<omr::Checkerboard> boards = omr::fromMessage(message);
  ASSERT_EQ(boards.size(), 2U);
  EXPECT_EQ(boards[0].cols, 4);
  EXPECT_EQ(boards[1].cols, 3);
}

TEST(PartMessages, pixelsThatAreNoNumbersAreRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  outdoor_omr::CheckerboardArray boards;
  boards.checkerboards.resize(1);
  boards.checkerboards[0].rows = boards.checkerboards[0].cols = 3;
  boards.checkerboards[0].inner_corners.resize(4);
  boards.checkerboards[0].inner_corners_seen.assign(4, 1U);
  EXPECT_EQ(omr::fromMessage(boards).size(), 1U);
  boards.checkerboards[0].inner_corners[2].y = nan;
  EXPECT_THROW(omr::fromMessage(boards), std::invalid_argument);

  outdoor_omr::TargetArray targets;
  targets.targets.resize(1);
  EXPECT_EQ(omr::fromMessage(targets).size(), 1U);
  targets.targets[0].outermost_deviation = 0.25;
  EXPECT_EQ(omr::fromMessage(targets)[0].outermost_deviation, 0.25);
  for (const float deviation : {-0.1F, static_cast<float>(nan), std::numeric_limits<float>::infinity()})
  {
    targets.targets[0].outermost_deviation = deviation;
    EXPECT_THROW(omr::fromMessage(targets), std::invalid_argument) << deviation;
  }
  targets.targets[0].outermost_deviation = 0;
  targets.targets[0].center.x = nan;
  EXPECT_THROW(omr::fromMessage(targets), std::invalid_argument);
}

TEST(PartMessages, copiesAreFollowedAndHaveFramesOfTheirOwn)
{
  omr::PartTracker tracker({});
  PartArray parts = platesAt(10, 0, 0.5);
  omr::track(parts, tracker);
  EXPECT_EQ(parts.parts[0].id, 1U);
  EXPECT_EQ(parts.parts[1].id, 2U);
  parts = platesAt(10.1, 0.5, 0);
  omr::track(parts, tracker);
  EXPECT_EQ(parts.parts[0].id, 2U);
  EXPECT_NEAR(parts.parts[0].pose.pose.position.x, 0.5, 1e-12);

  omr::Part plate;
  plate.name = "plate";
  EXPECT_EQ(omr::frameOf(parts.parts[0], {plate}), "plate");
  plate.copies = 2;
  EXPECT_EQ(omr::frameOf(parts.parts[0], {plate}), "plate_2");
  EXPECT_EQ(omr::toTransform(parts.header, parts.parts[1], {plate}).child_frame_id, "plate_1");
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
