#include "locate_fixture.h"
#include "outdoor_omr/pose_estimate.h"

using omr::Part;
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

// A target is 0.1 px off, too little for an outlier: it turns the plate the less, the less surely it is placed.
TEST_F(Locate, anUnsureTargetPullsLittle)
{
  const auto turned = [&](double deviation) {
    PartView view(camera_);
    view.add(plate(), pose_);
    view.targets[1].outermost_deviation = deviation;
    const std::vector<Sighting> right = locate(view, {plate()});
    view.targets[1].rings.back().center.x += 0.1F;
    const std::vector<Sighting> off = locate(view, {plate()});
    expectCertain(off, "plate", pose_);
    return degreesBetween(off[0].candidates[0].pose.camera_part, right[0].candidates[0].pose.camera_part);
  };
  EXPECT_LT(turned(0.3), turned(0.05) / 10);
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

TEST_F(Locate, theCovarianceIsThatOfThePartsOriginHoweverFarTheBoard)
{
  constexpr int VIEWS = 100;
  std::vector<double> sums;  // of chi square: errors over what is stated
  for (const cv::Vec3d& place : {cv::Vec3d(0, 0, 0), cv::Vec3d(-1, 0.2, 0)})
  {
    omr::PartCheckerboard board = flatBoard(7, 10);
    board.pose = cv::Affine3d::Identity().translate(place);
    const Part part{"plate", {board}, {}};
    const cv::Affine3d pose = pose_ * board.pose.inv();
    double sum = 0;
    for (int seed = 1; seed <= VIEWS; ++seed)
    {
      PartView view(camera_, 0.03, static_cast<std::uint64_t>(seed));
      view.add(part, pose);
      const std::vector<Sighting> sightings = locate(view, {part});
      ASSERT_EQ(sightings.size(), 1U);
      const omr::Pose& found = sightings[0].candidates[0].pose;
      const cv::Vec6d step = omr::stepBetween(pose, found.camera_part);
      sum += step.dot(found.covariance.inv() * step);
    }
    sums.push_back(sum);
  }
  EXPECT_GT(sums[0], 0.1 * VIEWS);
  EXPECT_NEAR(sums[1], sums[0], 0.01 * sums[0]);
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

TEST_F(Locate, targetWhoseOutermostRingIsHiddenDoesNotCount)
{
  // Two targets that speak against it would make the board a foreign one.
  PartView view(camera_);
  view.add(flatBoard(), pose_);
  view.add(LEFT, pose_, "RWPG");
  const std::vector<Sighting> sightings = locate(view, {plate()});
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
  const cv::Point2d off(4, -3);  // 6 mm on the plate
  view.targets[0].center += off;
  view.targets[0].rings.back().center += cv::Point2f(off);
  const std::vector<Sighting> sightings = locate(view, {plate()});
  expectCertain(sightings, "plate", pose_);
  EXPECT_FALSE(sightings[0].candidates[0].pose.used[48]);
  EXPECT_TRUE(sightings[0].candidates[0].pose.used[49]);
}

// The centre is extrapolated from the rings, and at 6 m up to 0.2 px off; the outermost ring is 0.015 px.
TEST_F(Locate, targetIsWhereItsOutermostRingIs)
{
  PartView view(camera_, 0.01);
  view.add(plate(), pose_);
  view.targets[0].center += cv::Point2d(0.4, -0.4);
  const std::vector<Sighting> sightings = locate(view, {plate()});
  expectCertain(sightings, "plate", pose_);
  const std::vector<bool>& used = sightings[0].candidates[0].pose.used;
  EXPECT_EQ(std::count(used.begin(), used.end(), true), 6 * 8 + 2);
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

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
