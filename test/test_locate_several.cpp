#include "locate_fixture.h"

using omr::Part;
using omr::PartPose;
using omr::Sighting;
using omr::test::flatBoard;
using omr::test::LEFT;
using omr::test::Locate;
using omr::test::millimetresBetween;
using omr::test::PartView;
using omr::test::plate;
using omr::test::poseAt;
using omr::test::RIGHT;

TEST_F(Locate, sectionNeedsAnotherMarker)
{
  PartView view(camera_);
  view.addSection(flatBoard(), pose_, cv::Rect(3, 1, 6, 5));
  EXPECT_TRUE(locate(view, {plate()}).empty());
  view.add(RIGHT, pose_);
  expectCertain(locate(view, {plate()}), "plate", pose_);
}

TEST_F(Locate, sectionThatIsNoBoardByItself)
{
  PartView view(camera_);
  view.addSection(flatBoard(), pose_, cv::Rect(3, 1, 6, 4));
  view.add(flatBoard(5, 7), poseAt(-0.5, 0, 2));  // of another thing
  omr::Markers markers;
  markers.sections = {view.checkerboards[0]};
  markers.checkerboards = {view.checkerboards[1]};
  EXPECT_TRUE(locateParts(markers, {plate()}, camera_).empty());
  view.add(RIGHT, pose_);
  markers.targets = view.targets;
  const std::vector<Sighting> sightings = locateParts(markers, {plate()}, camera_);
  expectCertain(sightings, "plate", pose_);
  EXPECT_EQ(sightings[0].candidates[0].checkerboards, std::vector<int>({1}));
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

TEST(Misfit, isToldAboveWhatMarkersAreFoundWith)
{
  EXPECT_EQ(omr::misfitOf("plate", 0.18), "");  // boards on paper before real cameras
  EXPECT_EQ(omr::misfitOf("plate", 0.36).find("plate: reprojection error 0.36 px, more than 0.30: "), 0U);  // bent
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
