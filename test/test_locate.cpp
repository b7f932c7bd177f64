#include <gtest/gtest.h>

#include "outdoor_omr/locate.h"
#include "part_view.h"

using omr::Camera;
using omr::ImageKind;
using omr::locateParts;
using omr::Part;
using omr::PartCheckerboard;
using omr::PartPose;
using omr::PartTarget;
using omr::Sighting;
using omr::test::cameraInfo;
using omr::test::flatBoard;
using omr::test::PartView;
using omr::test::poseAt;

namespace
{
const PartTarget LEFT{"RWPGB", 0.016, {-0.3, 0, 0}};
const PartTarget RIGHT{"GRGPB", 0.016, {0.3, 0, 0}};

/** A board that looks the same after half a turn, and targets that tell. */
Part plate(const std::string& name = "plate")
{
  return {name, {flatBoard()}, {LEFT, RIGHT}};
}

/** Degrees between two attitudes. */
double degreesBetween(const cv::Affine3d& a, const cv::Affine3d& b)
{
  return cv::norm((a.inv() * b).rvec()) * 180 / CV_PI;
}

double millimetresBetween(const cv::Affine3d& a, const cv::Affine3d& b)
{
  return cv::norm(a.translation() - b.translation()) * 1000;
}

class Locate : public ::testing::Test
{
 protected:
  std::vector<Sighting> locate(const PartView& view, const std::vector<Part>& parts) const
  {
    return locateParts(view.checkerboards, view.targets, parts, camera_);
  }

  /** One sighting, certain, at the given place: 1 mm at 2 m, 0.1 degrees. */
  void expectCertain(const std::vector<Sighting>& sightings, const std::string& part, const cv::Affine3d& pose) const
  {
    ASSERT_EQ(sightings.size(), 1U);
    ASSERT_TRUE(sightings[0].certain()) << sightings[0].candidates.size() << " candidates";
    expectAt(sightings[0].candidates[0], part, pose);
  }

  static void expectAt(const PartPose& found, const std::string& part, const cv::Affine3d& pose)
  {
    EXPECT_EQ(found.part, part);
    EXPECT_LT(millimetresBetween(found.pose.camera_part, pose), 1);
    EXPECT_LT(degreesBetween(found.pose.camera_part, pose), 0.1);
  }

  Camera camera_{cameraInfo(), ImageKind::RAW};
  cv::Affine3d pose_ = poseAt(0.1, -0.05, 2, 20, -25, 10);
};

TEST_F(Locate, wholePart)
{
  for (const bool half_turn : {false, true})
  {
    PartView view(camera_);
    view.add(plate(), pose_, half_turn);
    const std::vector<Sighting> sightings = locate(view, {plate()});
    expectCertain(sightings, "plate", pose_);
    EXPECT_EQ(sightings[0].candidates[0].checkerboards, std::vector<int>({0}));
    EXPECT_EQ(sightings[0].candidates[0].targets, std::vector<int>({0, 1}));
    EXPECT_EQ(sightings[0].candidates[0].pose.used.size(), 6U * 8 + 2);
  }
}

TEST_F(Locate, boardAloneIsAmbiguousByHalfATurn)
{
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  const std::vector<Sighting> sightings = locate(view, {plate()});
  ASSERT_EQ(sightings.size(), 1U);
  ASSERT_EQ(sightings[0].candidates.size(), 2U);
  EXPECT_FALSE(sightings[0].certain());
  const cv::Affine3d a = sightings[0].candidates[0].pose.camera_part;
  const cv::Affine3d b = sightings[0].candidates[1].pose.camera_part;
  EXPECT_NEAR(degreesBetween(a, b), 180, 0.001);
  EXPECT_LT(millimetresBetween(a, b), 1e-3);
}

TEST_F(Locate, boardWithOneOrientationNeedsNoTarget)
{
  const Part part{"plate", {flatBoard(7, 10)}, {LEFT}};
  PartView view(camera_);
  view.add(part.checkerboards[0], pose_);
  expectCertain(locate(view, {part}), "plate", pose_);
}

TEST_F(Locate, squareBoardHasFourOrientationsAndOneTargetSettlesThem)
{
  const Part part{"plate", {flatBoard(9, 9)}, {LEFT}};
  PartView view(camera_);
  view.add(part.checkerboards[0], pose_);
  std::vector<Sighting> sightings = locate(view, {part});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 4U);
  view.add(LEFT, pose_);
  expectCertain(locate(view, {part}), "plate", pose_);
}

TEST_F(Locate, evenSquareBoardHasTwoOrientations)
{
  const Part part{"plate", {flatBoard(8, 8)}, {}};
  PartView view(camera_);
  view.add(part.checkerboards[0], pose_);
  const std::vector<Sighting> sightings = locate(view, {part});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 2U);
}

TEST_F(Locate, equalBoardsOfTwoPartsAreToldApartByTargets)
{
  const Part a{"a", {flatBoard(7, 10)}, {LEFT}};
  const Part b{"b", {flatBoard(7, 10)}, {{"PGRPG", 0.016, {-0.3, 0, 0}}}};
  PartView view(camera_);
  view.add(a.checkerboards[0], pose_);
  std::vector<Sighting> sightings = locate(view, {a, b});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 2U);
  view.add(b.targets[0], pose_);
  expectCertain(locate(view, {a, b}), "b", pose_);
}

TEST_F(Locate, otherSquareSizeIsAnotherPart)
{
  const Part small{"small", {flatBoard(7, 10, 0.02)}, {}};
  const Part large{"large", {flatBoard(7, 10, 0.04)}, {}};
  PartView view(camera_);
  view.add(large.checkerboards[0], pose_);
  const std::vector<Sighting> sightings = locate(view, {small, large});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 2U) << "no picture tells a near small board from a far large one";
}

TEST_F(Locate, curvatureTellsPartsApart)
{
  Part pipe{"pipe", {flatBoard(7, 10)}, {}};
  pipe.checkerboards[0].curvature = 1 / 0.3;
  const Part flat{"flat", {flatBoard(7, 10)}, {}};
  PartView view(camera_);
  view.add(pipe.checkerboards[0], pose_);
  expectCertain(locate(view, {flat, pipe}), "pipe", pose_);
}

TEST_F(Locate, unknownColorAgreesWithAll)
{
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_, "RW?GB");
  expectCertain(locate(view, {plate()}), "plate", pose_);
}

TEST_F(Locate, smallTargetWithRingsRunTogetherDoesNotCount)
{
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_, "RPGB");  // RWPGB whose white ring was not resolved
  std::vector<Sighting> sightings = locate(view, {plate()});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 2U);
  view.add(RIGHT, pose_);
  expectCertain(locate(view, {plate()}), "plate", pose_);
}

TEST_F(Locate, targetWithARingTooManyDoesNotCount)
{
  for (const std::string colors : {"?RWPGB", "RWPGBP"})
  {
    PartView view(camera_);
    view.add(flatBoard(), pose_);
    view.add(LEFT, pose_, colors);
    std::vector<Sighting> sightings = locate(view, {plate()});
    ASSERT_EQ(sightings.size(), 1U);
    EXPECT_EQ(sightings[0].candidates.size(), 2U);
    view.add(RIGHT, pose_);
    expectCertain(locate(view, {plate()}), "plate", pose_);
  }
}

TEST_F(Locate, otherColorsRefuteWithoutMakingTheOppositeCertain)
{
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_, "PGRPG");
  const std::vector<Sighting> sightings = locate(view, {{"plate", {flatBoard()}, {LEFT}}});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_FALSE(sightings[0].certain());
  EXPECT_TRUE(locate(view, {plate()}).empty()) << "with a target on either side both ways round are refuted";
}

TEST_F(Locate, foreignPartWithTheSameBoardIsNotReported)
{
  const Part part{"plate", {flatBoard(7, 10)}, {LEFT}};
  PartView view(camera_);
  view.add(part.checkerboards[0], pose_);
  view.add(LEFT, pose_, "PGRPG");
  EXPECT_TRUE(locate(view, {part}).empty());
}

TEST_F(Locate, oneMisreadTargetOfThreeIsOutvoted)
{
  Part part = plate();
  part.targets.push_back({"PGRPG", 0.016, {0, 0.3, 0}});
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_);
  view.add(RIGHT, pose_);
  view.add(part.targets[2], pose_, "BGRPG");
  expectCertain(locate(view, {part}), "plate", pose_);
}

TEST_F(Locate, targetThatIsOffDoesNotBendThePose)
{
  PartView view(camera_);
  view.add(plate(), pose_);
  view.targets[0].center += cv::Point2d(4, -3);  // 6 mm on the plate
  const std::vector<Sighting> sightings = locate(view, {plate()});
  expectCertain(sightings, "plate", pose_);
  EXPECT_FALSE(sightings[0].candidates[0].pose.used[48]);
  EXPECT_TRUE(sightings[0].candidates[0].pose.used[49]);
}

TEST_F(Locate, sectionNeedsAnotherMarker)
{
  PartView view(camera_);
  view.addSection(flatBoard(), pose_, cv::Rect(3, 1, 6, 5));
  EXPECT_TRUE(locate(view, {plate()}).empty());
  view.add(RIGHT, pose_);
  expectCertain(locate(view, {plate()}), "plate", pose_);
}

TEST_F(Locate, sectionStandingOnEnd)
{
  // Five columns and seven rows are seen: the detector's rows are the board's columns.
  PartView view(camera_);
  view.addSection(flatBoard(), pose_, cv::Rect(2, 0, 5, 7));
  omr::Checkerboard& seen = view.checkerboards[0];
  const std::vector<cv::Point2f> corners = seen.inner_corners;  // 6 rows of 4
  seen.rows = 5;
  seen.cols = 7;
  seen.inner_corners.clear();
  for (int col = 0; col < 4; ++col)
  {
    for (int row = 5; row >= 0; --row)
    {
      seen.inner_corners.push_back(corners[row * 4 + col]);
    }
  }
  view.add(RIGHT, pose_);
  expectCertain(locate(view, {plate()}), "plate", pose_);
}

TEST_F(Locate, twoBoardsOfOnePart)
{
  Part part{"beam", {flatBoard(5, 7), flatBoard(7, 9)}, {}};
  part.checkerboards[1].pose = cv::Affine3d(cv::Vec3d(0, 0, 0.3), cv::Vec3d(0.5, 0.1, 0.05));
  PartView view(camera_);
  view.add(part, pose_);
  const std::vector<Sighting> sightings = locate(view, {part});
  expectCertain(sightings, "beam", pose_);
  EXPECT_EQ(sightings[0].candidates[0].checkerboards, std::vector<int>({0, 1}));
}

TEST_F(Locate, severalPartsEachWithItsOwnMarkers)
{
  const cv::Affine3d elsewhere = poseAt(-0.6, 0.2, 3, -15, 10, 100);
  Part other{"other", {flatBoard(7, 9)}, {{"PGRPG", 0.016, {0.3, 0, 0}}}};
  PartView view(camera_);
  view.add(other, elsewhere);
  view.add(plate(), pose_);
  const std::vector<Sighting> sightings = locate(view, {plate(), other});
  ASSERT_EQ(sightings.size(), 2U);
  ASSERT_TRUE(sightings[0].certain());
  ASSERT_TRUE(sightings[1].certain());
  expectAt(sightings[0].candidates[0], "plate", pose_);
  EXPECT_EQ(sightings[0].candidates[0].targets, std::vector<int>({1, 2}));
  EXPECT_EQ(sightings[1].candidates[0].part, "other");
  EXPECT_LT(millimetresBetween(sightings[1].candidates[0].pose.camera_part, elsewhere), 2);
}

TEST_F(Locate, twoCopiesAreCandidatesOfOneSighting)
{
  const cv::Affine3d elsewhere = poseAt(-0.6, 0.2, 2.5, -15, 10, 100);
  PartView view(camera_);
  view.add(plate(), pose_);
  view.add(plate(), elsewhere);
  const std::vector<Sighting> sightings = locate(view, {plate()});
  ASSERT_EQ(sightings.size(), 1U);
  EXPECT_EQ(sightings[0].candidates.size(), 2U);
}

TEST_F(Locate, asManyCopiesAsThePartHasAreCertain)
{
  Part two = plate();
  two.copies = 2;
  const cv::Affine3d left = poseAt(-0.5, 0, 2, 20, 0, 0);
  const cv::Affine3d right = poseAt(0.5, 0, 2.2, 0, 20, 30);
  PartView view(camera_);
  view.add(two, left);
  view.add(two, right);
  const std::vector<Sighting> sightings = locate(view, {two});
  ASSERT_EQ(sightings.size(), 2U);
  for (const Sighting& sighting : sightings)
  {
    ASSERT_TRUE(sighting.certain());
    const PartPose& found = sighting.candidates[0];
    expectAt(found, "plate", found.pose.camera_part.translation()[0] < 0 ? left : right);
  }

  // One more than there should be: which of the three is none?
  view.add(two, poseAt(0, 0.5, 2.5));
  const std::vector<Sighting> too_many = locate(view, {two});
  ASSERT_EQ(too_many.size(), 1U);
  EXPECT_EQ(too_many[0].candidates.size(), 3U);
}

TEST_F(Locate, copyWithFewerMarkersGivesWay)
{
  Part part{"plate", {flatBoard(7, 10)}, {LEFT}};
  PartView view(camera_);
  view.add(part.checkerboards[0], poseAt(-0.6, 0.2, 2.5, -15, 10, 100));
  view.add(part, pose_);
  expectCertain(locate(view, {part}), "plate", pose_);
}

TEST_F(Locate, otherBoardsAreNothing)
{
  PartView view(camera_);
  view.add(flatBoard(8, 11), pose_);
  EXPECT_TRUE(locate(view, {plate()}).empty());
  EXPECT_TRUE(locate(PartView(camera_), {plate()}).empty());
  EXPECT_TRUE(locate(view, {}).empty());
}

TEST_F(Locate, boardWithThreeCornersSeenIsNothing)
{
  PartView view(camera_);
  view.add(plate(), pose_);
  std::vector<bool>& seen = view.checkerboards[0].inner_corners_seen;
  seen.assign(seen.size(), false);
  seen[0] = seen[10] = seen[30] = true;
  EXPECT_TRUE(locate(view, {plate()}).empty());
}

TEST_F(Locate, flipOfASmallFarBoardIsReported)
{
  // 7 x 10 squares of 10 mm at 6 m are 27 px long: a tilt of 12 degrees cannot be told from its mirror image.
  const Part part{"plate", {flatBoard(7, 10, 0.01)}, {}};
  PartView view(camera_);
  const cv::Affine3d pose = poseAt(0, 0, 6, 12, 0, 0);
  view.add(part.checkerboards[0], pose);
  const std::vector<Sighting> sightings = locate(view, {part});
  ASSERT_EQ(sightings.size(), 1U);
  ASSERT_EQ(sightings[0].candidates.size(), 2U);
  const double a = degreesBetween(sightings[0].candidates[0].pose.camera_part, pose);
  const double b = degreesBetween(sightings[0].candidates[1].pose.camera_part, pose);
  EXPECT_LT(std::min(a, b), 8);
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
