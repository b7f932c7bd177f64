#include "targets/seeds/round_spots.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "render_target.h"
#include "targets/small_rings.h"

namespace
{
/** A target of five rings, seen obliquely. @param ring width [px] */
TargetScene smallTarget(double ring, double tilt)
{
  TargetScene scene;
  scene.radii = {ring, 2 * ring, 3 * ring, 4 * ring, 5 * ring};
  scene.sheet_half_side = 6 * ring;
  scene.homography = tiltedView({203.4, 151.7}, tilt, .7, 1, 3000);
  return scene;
}

std::vector<omr::RoundSpot> spotsIn(const cv::Mat& bgr)
{
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return omr::findRoundSpots(grey);
}
}  // namespace

TEST(RoundSpots, narrowRingsMeetInTheirCentre)
{
  for (const double ring : {2., 2.5, 3.5})
  {
    for (const double tilt : {0., .6, .9})
    {
      const TargetScene scene = smallTarget(ring, tilt);
      const std::vector<omr::RoundSpot> spots = spotsIn(renderTarget(scene));
      ASSERT_FALSE(spots.empty()) << ring << " " << tilt;
      EXPECT_LT(cv::norm(spots[0].center - projectedCenter(scene)), .5) << ring << " " << tilt;
      EXPECT_LT(spots[0].deviation, .2);
    }
  }
}

TEST(RoundSpots, theRoundestComesFirst)
{
  cv::Mat image = renderTarget(smallTarget(2.5, 0));
  cv::ellipse(image, cv::RotatedRect({80, 80}, {22, 14}, 30), cv::Scalar::all(250), cv::FILLED, cv::LINE_AA);
  const std::vector<omr::RoundSpot> spots = spotsIn(image);
  ASSERT_EQ(2U, spots.size());
  EXPECT_LT(cv::norm(spots[0].center - cv::Point2d(203.4, 151.7)), .5);
  EXPECT_LT(cv::norm(spots[1].center - cv::Point2d(80, 80)), .5);
  EXPECT_LT(1.5 * spots[0].deviation, spots[1].deviation);
}

TEST(RoundSpots, onlyThoseWithEdgesOfBothKindsMayBeRings)
{
  for (const double ring : {2., 2.5, 3.5})
  {
    for (const double tilt : {0., .6, .9})
    {
      const std::vector<omr::RoundSpot> spots = spotsIn(renderTarget(smallTarget(ring, tilt)));
      ASSERT_FALSE(spots.empty());
      EXPECT_TRUE(omr::mayBeRings(spots[0])) << ring << " " << tilt;
    }
  }
  cv::Mat disk(240, 320, CV_8UC3, cv::Scalar::all(60));
  cv::ellipse(disk, cv::RotatedRect({80, 80}, {18, 14}, 30), cv::Scalar::all(250), cv::FILLED, cv::LINE_AA);
  const std::vector<omr::RoundSpot> spots = spotsIn(disk);
  ASSERT_EQ(1U, spots.size());
  EXPECT_FALSE(omr::mayBeRings(spots[0]));
}

TEST(RoundSpots, aCentreOutsideTheImageIsNone)
{
  // Arcs around points to the left of the image: some say that they belong to rings far outside of it.
  cv::RNG random(532);
  for (int i = 0; i < 1200; ++i)
  {
    cv::Mat image(100, 100, CV_8UC3, cv::Scalar::all(200));
    const float off = random.uniform(25.F, 60.F);
    const cv::Point2f center(-off, random.uniform(30.F, 70.F));
    for (float radius = off - 2; radius < off + 30; radius += 7)
    {
      const cv::Size2f size(2 * radius, 2 * radius * random.uniform(.5F, 1.F));
      cv::ellipse(image, cv::RotatedRect(center, size, 0), cv::Scalar::all(40), 2, cv::LINE_AA);
    }
    const omr::EdgelMap map(image);
    omr::RoundSpot spot;
    spot.center = {random.uniform(4., 14.), random.uniform(20., 80.)};
    omr::RingCandidate candidate;
    EXPECT_FALSE(omr::growSpot(map, image, spot, 3, candidate)) << i;
  }
}

TEST(RoundSpots, growAlikeWhateverWasSpentBefore)
{
  int in_the_image = 0;
  for (const double ring : {2.5, 3., 3.5})
  {
    TargetScene scene = smallTarget(ring, .3);
    scene.blur = 1;
    const cv::Mat image = renderTarget(scene);
    omr::RoundSpot spot;
    spot.center = projectedCenter(scene);
    const omr::EdgelMap fresh(image);
    omr::EdgelMap spent(image);
    spent.setMaxLooks(0);
    spent.visit(0, 0, 479, 359, [](const omr::Edgel&) {});
    ASSERT_TRUE(spent.isSpent());
    omr::RingCandidate expected;
    omr::RingCandidate candidate;
    EXPECT_EQ(omr::growSpot(fresh, image, spot, 3, expected), omr::growSpot(spent, image, spot, 3, candidate)) << ring;
    EXPECT_EQ(expected.profile_scale, candidate.profile_scale) << ring;
    EXPECT_EQ(expected.rings.radii, candidate.rings.radii) << ring;
    in_the_image += expected.profile_scale == 1 && !expected.boundaries.empty() ? 1 : 0;
  }
  EXPECT_GT(in_the_image, 0);
}

TEST(RoundSpots, textureCornersAndBarsAreNone)
{
  cv::Mat texture(240, 320, CV_8UC3);
  cv::randn(texture, cv::Scalar::all(120), cv::Scalar::all(40));
  EXPECT_TRUE(spotsIn(texture).empty());

  cv::Mat corner(240, 320, CV_8UC3, cv::Scalar::all(60));  // of two squares that touch
  corner(cv::Rect(0, 0, 160, 120)) = cv::Scalar::all(220);
  corner(cv::Rect(160, 120, 160, 120)) = cv::Scalar::all(220);
  EXPECT_TRUE(spotsIn(corner).empty());

  cv::Mat bars(240, 320, CV_8UC3, cv::Scalar::all(60));
  for (int x = 0; x < 320; x += 8)
  {
    cv::line(bars, {x, 0}, {x, 239}, cv::Scalar::all(200), 3);
  }
  EXPECT_TRUE(spotsIn(bars).empty());
}

TEST(RoundSpots, noneAtTheImagesEdgeNorInAnImageTooSmall)
{
  cv::Mat image(60, 80, CV_8UC3, cv::Scalar::all(60));
  cv::circle(image, {4, 30}, 6, cv::Scalar::all(220), cv::FILLED, cv::LINE_AA);
  EXPECT_TRUE(spotsIn(image).empty());
  EXPECT_TRUE(spotsIn(image(cv::Rect(0, 0, 7, 5))).empty());
}

TEST(RoundSpots, whatLiesBesideAPartOfAnImageDoesNotCount)
{
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar::all(60));
  for (int x = 0; x < 320; x += 8)
  {
    for (int y = 4; y < 240; y += 24)  // some at the edges of the part
    {
      cv::circle(image, {3 * x, y}, 3, cv::Scalar::all(220), 2, cv::LINE_AA);
    }
  }
  const cv::Mat part = image(cv::Rect(37, 21, 168, 152));  // whole cells
  const std::vector<omr::RoundSpot> spots = omr::findRoundSpots(part);
  const std::vector<omr::RoundSpot> expected = omr::findRoundSpots(part.clone());
  ASSERT_LT(4U, expected.size());
  ASSERT_EQ(expected.size(), spots.size());
  for (std::size_t i = 0; i < spots.size(); ++i)
  {
    EXPECT_EQ(expected[i].center, spots[i].center);
    EXPECT_EQ(expected[i].deviation, spots[i].deviation);
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
