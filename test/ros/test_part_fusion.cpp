#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "part_fusion.h"
#include "pose_messages.h"

using omr::CameraView;
using omr::FusedViews;
using omr::fuseViews;
using outdoor_omr::Part;

namespace
{
const omr::FusionSettings SETTINGS{{0.001, 0.0005}, 1, {}};
const omr::FusionSettings TWO_PLATES{{0.001, 0.0005}, 1, {{"plate", {2, 0.28}}}};

/** A part 1 m before the camera, a millimetre uncertain. */
Part partAt(const std::string& name, double x)
{
  Part part;
  part.name = name;
  part.pose = omr::toMessage(
      omr::PoseEstimate{cv::Affine3d(cv::Vec3d(0, 0, 0), cv::Vec3d(x, 0, 1)), cv::Matx66d::eye() * 1e-6});
  part.points = 54;
  part.reprojection_error = 0.1F;
  part.checkerboards = {3};
  return part;
}

/** A camera that stands at x and looks along the frame's z. */
CameraView viewFrom(const std::string& camera, double x, const std::vector<Part>& parts)
{
  CameraView view{{}, cv::Affine3d::Identity().translate({x, 0, 0})};
  view.parts.header.frame_id = camera;
  view.parts.parts = parts;
  return view;
}

std_msgs::Header base()
{
  std_msgs::Header header;
  header.stamp = ros::Time(7);
  header.frame_id = "base";
  return header;
}

TEST(PartFusion, placesAndJoinsWhatCamerasSee)
{
  const FusedViews fused = fuseViews({viewFrom("left", -0.2, {partAt("plate", 0.2), partAt("pipe", 0)}),
                                      viewFrom("right", 0.3, {partAt("plate", -0.298)})},
                                     base(), SETTINGS);
  EXPECT_EQ(fused.parts.header.frame_id, "base");
  EXPECT_EQ(fused.parts.header.stamp, ros::Time(7));
  EXPECT_TRUE(fused.parts.ambiguous.empty());
  ASSERT_EQ(fused.parts.parts.size(), 2U);
  const Part& pipe = fused.parts.parts[0];
  EXPECT_EQ(pipe.name, "pipe");
  EXPECT_NEAR(pipe.pose.pose.position.x, -0.2, 1e-9);
  EXPECT_EQ(pipe.points, 54U);
  const Part& plate = fused.parts.parts[1];
  EXPECT_NEAR(plate.pose.pose.position.x, 0.001, 1e-6);  // both are equally sure of 0 and 2 mm
  EXPECT_NEAR(plate.pose.pose.position.z, 1, 1e-4);
  EXPECT_LT(plate.pose.covariance[0], pipe.pose.covariance[0]);
  EXPECT_EQ(plate.points, 108U);
  EXPECT_NEAR(plate.reprojection_error, 0.1, 1e-6);
  EXPECT_TRUE(plate.checkerboards.empty());  // indices of one camera's boards say nothing here

  ASSERT_EQ(fused.report.parts.size(), 2U);
  EXPECT_EQ(fused.report.parts[0].degrees_of_freedom, 0U);
  EXPECT_EQ(fused.report.parts[1].frame_ids, (std::vector<std::string>{"left", "right"}));
  EXPECT_NEAR(fused.report.parts[1].distances_mm[1], 1, 1e-3);
  EXPECT_TRUE(fused.report.parts[1].agree);
}

TEST(PartFusion, ofContradictionsIsNoAverage)
{
  const FusedViews fused = fuseViews(
      {viewFrom("left", 0, {partAt("plate", 0)}), viewFrom("right", 0, {partAt("plate", 0.05)})}, base(), SETTINGS);
  EXPECT_TRUE(fused.parts.parts.empty());
  ASSERT_EQ(fused.parts.ambiguous.size(), 1U);
  ASSERT_EQ(fused.parts.ambiguous[0].candidates.size(), 2U);
  EXPECT_NEAR(fused.parts.ambiguous[0].candidates[0].pose.pose.position.x, 0, 1e-9);
  EXPECT_NEAR(fused.parts.ambiguous[0].candidates[1].pose.pose.position.x, 0.05, 1e-9);
  EXPECT_FALSE(fused.report.parts.at(0).agree);
}

TEST(PartFusion, tellsCopiesApartByTheirPlaces)
{
  // The cameras list them in different orders, and each sees one that the other does not.
  const FusedViews both = fuseViews({viewFrom("left", 0, {partAt("plate", -0.4), partAt("plate", 0.4)}),
                                     viewFrom("right", 0.1, {partAt("plate", 0.301), partAt("plate", -0.501)})},
                                    base(), TWO_PLATES);
  EXPECT_TRUE(both.parts.ambiguous.empty());
  ASSERT_EQ(both.parts.parts.size(), 2U);
  EXPECT_NEAR(both.parts.parts[0].pose.pose.position.x, -0.4005, 1e-6);
  EXPECT_NEAR(both.parts.parts[1].pose.pose.position.x, 0.4005, 1e-6);
  ASSERT_EQ(both.report.parts.size(), 2U);
  EXPECT_EQ(both.report.parts[0].frame_ids.size(), 2U);
  const FusedViews apart = fuseViews(
      {viewFrom("left", 0, {partAt("plate", -0.4)}), viewFrom("right", 0, {partAt("plate", 0.4)})}, base(), TWO_PLATES);
  EXPECT_EQ(apart.parts.parts.size(), 2U);
}

TEST(PartFusion, copiesThatOverlapOrAreTooManyAreAContradiction)
{
  const FusedViews pushed = fuseViews(
      {viewFrom("left", 0, {partAt("plate", 0)}), viewFrom("right", 0, {partAt("plate", 0.05)})}, base(), TWO_PLATES);
  EXPECT_TRUE(pushed.parts.parts.empty());
  EXPECT_EQ(pushed.parts.ambiguous.at(0).candidates.size(), 2U);
  EXPECT_FALSE(pushed.report.parts.at(0).agree);
  const FusedViews three = fuseViews(
      {viewFrom("left", 0, {partAt("plate", 0), partAt("plate", 0.5)}), viewFrom("right", 0, {partAt("plate", 1)})},
      base(), TWO_PLATES);
  EXPECT_TRUE(three.parts.parts.empty());
  EXPECT_EQ(three.parts.ambiguous.at(0).candidates.size(), 3U);
}

TEST(PartFusion, copiesAreThoseOfThePartsFile)
{
  omr::Part part;
  part.name = "plate";
  part.copies = 3;
  part.checkerboards.resize(2);
  part.checkerboards[0].rows = 7;
  part.checkerboards[0].square = 0.04;
  part.checkerboards[1].rows = 5;
  part.checkerboards[1].square = 0.02;
  const omr::Copies copies = omr::copiesOf({part}).at("plate");
  EXPECT_EQ(copies.count, 3);
  EXPECT_NEAR(copies.apart, 0.1, 1e-12);
}

TEST(PartFusion, takesTheCertainCameraWhereAnotherIsNot)
{
  CameraView unsure = viewFrom("right", 0.3, {});
  unsure.parts.ambiguous.resize(2);
  unsure.parts.ambiguous[0].candidates = {partAt("plate", 0), partAt("plate", 0.1)};
  unsure.parts.ambiguous[1].candidates = {partAt("sign", 0), partAt("sign", 0.1)};
  const FusedViews fused = fuseViews({viewFrom("left", 0, {partAt("plate", 0.3)}), unsure}, base(), SETTINGS);
  ASSERT_EQ(fused.parts.parts.size(), 1U);
  EXPECT_NEAR(fused.parts.parts[0].pose.pose.position.x, 0.3, 1e-9);
  ASSERT_EQ(fused.parts.ambiguous.size(), 1U);
  EXPECT_EQ(fused.parts.ambiguous[0].candidates.at(1).name, "sign");
  EXPECT_NEAR(fused.parts.ambiguous[0].candidates.at(1).pose.pose.position.x, 0.4, 1e-9);
}

TEST(PartFusion, publishesNoPartThatTooFewCamerasSee)
{
  omr::FusionSettings two = SETTINGS;
  two.min_cameras = 2;
  const FusedViews fused = fuseViews(
      {viewFrom("left", 0, {partAt("plate", 0), partAt("pipe", 0.5)}), viewFrom("right", 0, {partAt("plate", 0)})},
      base(), two);
  ASSERT_EQ(fused.parts.parts.size(), 1U);
  EXPECT_EQ(fused.parts.parts[0].name, "plate");
  EXPECT_TRUE(fused.parts.ambiguous.empty());
  EXPECT_EQ(fused.report.parts.size(), 2U);
}

TEST(PartFusion, refusesPosesThatAreNone)
{
  Part part = partAt("plate", 0);
  part.pose.pose.orientation.w = 0;  // never filled in
  EXPECT_THROW(fuseViews({viewFrom("left", 0, {part})}, base(), SETTINGS), std::invalid_argument);
  part = partAt("plate", std::nan(""));
  EXPECT_THROW(fuseViews({viewFrom("left", 0, {part})}, base(), SETTINGS), std::invalid_argument);
}

}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
