#include "parts/target_pair.h"

#include <gtest/gtest.h>

#include "part_view.h"
#include "parts/marker_pose.h"
#include "parts/reprojection.h"

using omr::Camera;
using omr::ImageKind;
using omr::Part;
using omr::PartCheckerboard;
using omr::PartTarget;
using omr::PointPair;
using omr::seenPoint;
using omr::Target;
using omr::targetPair;
using omr::test::cameraInfo;
using omr::test::flatBoard;
using omr::test::poseAt;
using omr::test::ringsOf;

namespace
{
const PartTarget TARGET{"RWPGB", 0.016, {-0.3, 0.1, 0}};

/** A near target, tilted and far from the middle of the image: its ellipses lie up to 5 px from its centre. */
const cv::Affine3d POSE = poseAt(0.5, 0.1, 1, 30, -35, 10);

Target seen(const PartTarget& target, const Camera& camera)
{
  const std::vector<cv::RotatedRect> rings = ringsOf(target, POSE, camera);
  Target seen;
  seen.colors = target.colors;
  seen.center = rings.front().center;
  seen.rings = rings;
  seen.outermost_deviation = 0.01;
  return seen;
}

// How the lens bends the ellipse: without straightening it the pixel is 0.9 to 1.6 px off.
TEST(TargetPair, ringsCenterIsWhereTheCircleSaysForEveryLens)
{
  for (const char* model : {"plumb_bob", "rational_polynomial", "equidistant"})
  {
    const Camera camera(cameraInfo(model), ImageKind::raw);
    const PointPair pair = targetPair({"plate", {flatBoard()}, {TARGET}}, TARGET, seen(TARGET, camera), camera);
    EXPECT_EQ(pair.point, TARGET.center);
    EXPECT_DOUBLE_EQ(cv::norm(pair.circle), 5 * 0.016);
    const cv::Point2d expected = camera.project({seenPoint(POSE, pair)}).front();
    EXPECT_LT(cv::norm(pair.pixel - expected), 0.01) << model << pair.pixel << expected;
    EXPECT_GT(cv::norm(pair.pixel - camera.project({POSE * TARGET.center}).front()), 1) << model;
  }
}

TEST(TargetPair, countsAsSurelyAsItsRingsArePlaced)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  const Part plate{"plate", {flatBoard()}, {TARGET}};
  Target target = seen(TARGET, camera);
  EXPECT_DOUBLE_EQ(targetPair(plate, TARGET, target, camera).sigma, omr::RING_SIGMA);
  target.outermost_deviation = 0.3;
  EXPECT_DOUBLE_EQ(targetPair(plate, TARGET, target, camera).sigma, 0.3);
}

TEST(TargetPair, isTheUnsureCenterWhereThePixelsDoNotPlaceTheRings)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  Target target = seen(TARGET, camera);
  target.outermost_deviation = 0;
  const PointPair pair = targetPair({"plate", {flatBoard()}, {TARGET}}, TARGET, target, camera);
  EXPECT_EQ(pair.pixel, target.center);
  EXPECT_EQ(pair.circle, cv::Vec3d(0, 0, 0));
  EXPECT_DOUBLE_EQ(pair.sigma, omr::UNPLACED_SIGMA);
}

TEST(TargetPair, isTheCenterWhereTheRingsDoNotLieAboutIt)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  Target target = seen(TARGET, camera);
  target.rings.back().center.x -= 0.2F * target.rings.back().size.width / 2;
  const PointPair pair = targetPair({"plate", {flatBoard()}, {TARGET}}, TARGET, target, camera);
  EXPECT_EQ(pair.pixel, target.center);
  EXPECT_EQ(pair.circle, cv::Vec3d(0, 0, 0));
}

TEST(TargetPair, isTheCenterWhereNobodyKnowsWhichWayTheTargetFaces)
{
  const Camera camera(cameraInfo(), ImageKind::raw);
  PartCheckerboard pipe = flatBoard();
  pipe.curvature = 4;
  PartTarget raised = TARGET;
  raised.center.z = 0.02;
  for (const auto& [board, target] : {std::pair{pipe, TARGET}, std::pair{flatBoard(), raised}})
  {
    const Target found = seen(target, camera);
    const PointPair pair = targetPair({"part", {board}, {target}}, target, found, camera);
    EXPECT_EQ(pair.pixel, found.center);
    EXPECT_EQ(pair.circle, cv::Vec3d(0, 0, 0));
    EXPECT_EQ(seenPoint(POSE, pair), POSE * target.center);
  }
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
