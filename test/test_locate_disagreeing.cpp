// Markers far from one plane, and markers that do not lie where the part's description says.

#include <cmath>

#include "locate_fixture.h"

using omr::Part;
using omr::PartPose;
using omr::PartTarget;
using omr::Sighting;
using omr::test::degreesBetween;
using omr::test::flatBoard;
using omr::test::LEFT;
using omr::test::Locate;
using omr::test::millimetresBetween;
using omr::test::PartView;
using omr::test::plate;
using omr::test::poseAt;
using omr::test::RIGHT;

namespace
{
/** Two boards that look the same after half a turn or not, side by side, the first in the origin. */
Part twoBoards(double second_x = 0.27)
{
  Part part{"beam", {flatBoard(5, 7, 0.02), flatBoard(7, 10, 0.02)}, {}};
  part.checkerboards[1].pose = cv::Affine3d(cv::Vec3d(), cv::Vec3d(second_x, 0, 0));
  return part;
}

/** Nothing that is certain is wrong: 3 mm, 1 degree. */
void expectNoneWrong(const std::vector<Sighting>& sightings, const cv::Affine3d& pose)
{
  for (const Sighting& sighting : sightings)
  {
    if (sighting.certain())
    {
      const cv::Affine3d& found = sighting.candidates[0].pose.camera_part;
      EXPECT_LT(millimetresBetween(found, pose), 3);
      EXPECT_LT(degreesBetween(found, pose), 1);
    }
  }
}
}  // namespace

TEST_F(Locate, targetFarInFrontOfTheBoard)
{
  for (const double z : {-0.3, -0.2, -0.1, 0.1, 0.2, 0.3})
  {
    const Part part{"bracket", {flatBoard(5, 7, 0.02)}, {{"RWPGB", 0.01, {0.14, 0, z}}}};
    for (int view_number = 0; view_number < 20; ++view_number)
    {
      const cv::Affine3d pose =
          poseAt(-0.05, 0.02, 1, 15 * std::cos(view_number), -12 + 10 * std::sin(2 * view_number), 17 * view_number);
      PartView view(camera_, 0.03, view_number + 1);
      view.add(part, pose);
      const std::vector<Sighting> sightings = locate(view, {part});
      ASSERT_EQ(sightings.size(), 1U) << z << " " << view_number;
      ASSERT_TRUE(sightings[0].certain()) << z << " " << view_number;
      const PartPose& found = sightings[0].candidates[0];
      EXPECT_LT(degreesBetween(found.pose.camera_part, pose), 1) << z << " " << view_number;
      EXPECT_LT(millimetresBetween(found.pose.camera_part, pose), 3) << z << " " << view_number;
      EXPECT_EQ(found.targets, std::vector<int>({0}));
    }
  }
}

TEST_F(Locate, boardsFarBehindEachOther)
{
  Part part{"frame", {flatBoard(5, 7, 0.02), flatBoard(5, 7, 0.02)}, {}};
  part.checkerboards[1].pose = cv::Affine3d(cv::Vec3d(), cv::Vec3d(0.2, 0, 0.3));
  for (int view_number = 0; view_number < 20; ++view_number)
  {
    const cv::Affine3d pose = poseAt(-0.1, 0.02, 1, 15 * std::cos(view_number), 10 * std::sin(2 * view_number), 10);
    PartView view(camera_, 0.03, view_number + 1);
    view.add(part, pose);
    const std::vector<Sighting> sightings = locate(view, {part});
    ASSERT_EQ(sightings.size(), 1U) << view_number;
    bool has_true = false;
    for (const PartPose& candidate : sightings[0].candidates)
    {
      has_true = has_true || (degreesBetween(candidate.pose.camera_part, pose) < 1 &&
                              millimetresBetween(candidate.pose.camera_part, pose) < 3);
    }
    EXPECT_TRUE(has_true) << view_number;
    expectNoneWrong(sightings, pose);
  }
}

TEST_F(Locate, boardOffItsPlaceMakesNothingCertainThatIsWrong)
{
  for (const double off : {-0.009, -0.006, -0.004, 0.004, 0.006, 0.009})
  {
    for (int view_number = 0; view_number < 10; ++view_number)
    {
      const cv::Affine3d pose = poseAt(-0.1, 0.02, 1, 15 * std::cos(view_number), 10 * std::sin(view_number), 10);
      PartView view(camera_, 0.03, view_number + 1);
      view.add(twoBoards(0.27 + off), pose);
      const std::vector<Sighting> sightings = locate(view, {twoBoards()});
      for (const Sighting& sighting : sightings)
      {
        EXPECT_FALSE(sighting.certain()) << off << " " << view_number;
      }
    }
  }
  PartView view(camera_);
  view.add(twoBoards(), poseAt(-0.1, 0.02, 1, 15, 10, 10));
  expectCertain(locate(view, {twoBoards()}), "beam", poseAt(-0.1, 0.02, 1, 15, 10, 10));
}

TEST_F(Locate, boardOffItsPlaceLeavesTheTargets)
{
  Part part = twoBoards();
  part.targets = {{"RWPGB", 0.01, {-0.14, 0, 0}}};
  Part real = twoBoards(0.278);
  real.targets = part.targets;
  const cv::Affine3d pose = poseAt(-0.1, 0.02, 1, 15, 10, 10);
  PartView view(camera_);
  view.add(real, pose);
  expectNoneWrong(locate(view, {part}), pose);
}

TEST_F(Locate, aTargetThatAgreesOutweighsAMisreadOne)
{
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_);
  view.add(RIGHT, pose_, "GRPPB");
  const std::vector<Sighting> sightings = locate(view, {plate()});
  ASSERT_EQ(sightings.size(), 1U);
  expectCertain(sightings, "plate", pose_);
  EXPECT_EQ(sightings[0].candidates[0].targets, std::vector<int>({0}));
}

TEST_F(Locate, whatTheLensWouldFoldIntoTheImageIsNotLookedForThere)
{
  omr::CameraInfo info = omr::test::cameraInfo();
  info.D = {-0.3, 0, 0, 0, 0};  // r (1 - 0.3 r^2) falls from r = 1.05 on
  const omr::Camera camera(info, omr::ImageKind::raw);
  const PartTarget aside{"RWPGB", 0.016, {2.8, 0, 0}};
  const Part part{"plate", {flatBoard(7, 10)}, {aside}};
  const cv::Affine3d pose = poseAt(0, 0, 2);
  const cv::Point2d folded = camera.project({pose * aside.center}).front();
  ASSERT_LT(folded.x, info.width) << "the picture of this test is not what it was made for";
  PartView view(camera);
  view.add(part.checkerboards[0], pose);
  omr::Target other;
  other.colors = "GRGPB";
  other.center = folded;
  view.targets.push_back(other);
  const std::vector<Sighting> sightings = locateParts(view.checkerboards, view.targets, {part}, camera);
  ASSERT_EQ(sightings.size(), 1U) << "a target that the part cannot show speaks against it";
  EXPECT_TRUE(sightings[0].certain());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
