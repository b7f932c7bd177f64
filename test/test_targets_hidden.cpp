#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "target_views.h"
#include "targets/candidate/ring_acceptance.h"
#include "targets/candidate/ring_openness.h"

using omr::AngleBins;
using omr::Target;
using omr::test::expectLetters;
using omr::test::findTargetsIn;

/** A bar across the picture, through a point beside the target's centre. */
void drawBar(cv::Mat& image, const cv::Point2d& offset, double degrees, int width, const cv::Scalar& color)
{
  const cv::Point2d along(std::cos(degrees * CV_PI / 180), std::sin(degrees * CV_PI / 180));
  const cv::Point2d point = cv::Point2d(240, 180) + offset;
  cv::line(image, point - 600 * along, point + 600 * along, color, width, cv::LINE_AA);
}

/** A target of which three bars hide half. */
cv::Mat hideHalf(const TargetScene& scene)
{
  cv::Mat image = renderTarget(scene);
  drawBar(image, {-62, 0}, 80, 36, {120, 125, 130});
  drawBar(image, {66, 0}, 100, 30, {60, 130, 70});
  drawBar(image, {0, 10}, -25, 34, {90, 150, 190});
  cv::GaussianBlur(image, image, cv::Size(), .7);
  return image;
}

TEST(HiddenTargets, barsOverHalfOfTheRings)
{
  // The second one's disk is hidden in half of the directions that are looked in, and read in the others.
  // Without the look at the open directions alone neither is found; and where the bars hide an outermost ring more than
  // the others, as that of the second, it is a ring only because its edges lie on a circle.
  TargetScene scene;
  for (const std::string colors : {"RWPGB", "BWRWP"})
  {
    scene.colors = colors;
    const std::vector<Target> targets = findTargetsIn(hideHalf(scene));
    ASSERT_EQ(1U, targets.size()) << colors;
    EXPECT_NEAR(0, cv::norm(cv::Point2d(targets[0].center) - projectedCenter(scene)), .3);
    expectLetters(colors, colors == "RWPGB" ? 1 : 0, targets[0].colors);
  }
}

TEST(HiddenTargets, ringsAreReadWhereAThirdOfAStrongBoundaryShows)
{
  TargetScene scene;
  for (const std::string colors : {"BWRWP", "GWGWP"})
  {
    scene.colors = colors;
    cv::Mat image = renderTarget(scene);
    drawBar(image, {25, 0}, 90, 30, {90, 150, 190});
    drawBar(image, {-40, 0}, 70, 14, {60, 130, 70});
    const std::vector<Target> targets = findTargetsIn(image);
    ASSERT_EQ(1U, targets.size()) << colors;
    EXPECT_EQ(colors, targets[0].colors);
  }
}

TEST(HiddenTargets, noInkExplainsAThingOnTheDiskOfNarrowRings)
{
  TargetScene scene;
  scene.light = .8;
  scene.noise = 1;
  for (const std::string colors : {"GWRWP", "GWRWB", "PWGWR"})
  {
    for (const double scale : {1., 2.})
    {
      for (const double blur : {.8, 1.})
      {
        scene.colors = colors;
        scene.blur = blur;
        scene.cover = 6.4 * scale;
        scene.cover_offset = scale * cv::Point2d(.5, .3);
        scene.sheet_half_side = 40 * scale;
        scene.radii.clear();
        for (int k = 0; k < 5; ++k)
        {
          scene.radii.push_back(scale * (6.7 + 4.3 * k));
        }
        std::vector<uchar> code;
        cv::imencode(".jpg", renderTarget(scene), code, {cv::IMWRITE_JPEG_QUALITY, 92});
        const std::vector<Target> targets = findTargetsIn(cv::imdecode(code, cv::IMREAD_COLOR));
        ASSERT_EQ(1U, targets.size()) << colors << " " << blur;
        EXPECT_EQ("?" + colors.substr(1), targets[0].colors) << blur;
      }
    }
  }
}

TEST(HiddenTargets, aRingFarNarrowerThanTheOthersIsDoubted)
{
  TargetScene scene;
  scene.colors = "RGWPB";
  scene.radii = {20, 40, 60, 66, 86};
  scene.sheet_half_side = 120;
  EXPECT_TRUE(findTargetsIn(renderTarget(scene)).empty());
  scene.radii = {20, 40, 60, 69, 89};
  EXPECT_EQ(1U, findTargetsIn(renderTarget(scene)).size());
}

TEST(HiddenTargets, aHoleInTheDiskIsNoRing)
{
  TargetScene scene;
  for (const double cover : {3., 5., 6.})
  {
    scene.cover = cover;
    const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
    ASSERT_EQ(1U, targets.size()) << cover;
    EXPECT_EQ(scene.colors, targets[0].colors) << cover;
  }
}

TEST(HiddenTargets, theSidesOfASquareAreNoRing)
{
  // The sheet's sides touch a circle that resembles another ring.
  TargetScene scene;
  scene.ground = {.05, .05, .05};
  for (const double half_side : {112., 118.})
  {
    scene.sheet_half_side = half_side;
    const std::vector<Target> targets = findTargetsIn(hideHalf(scene));
    ASSERT_EQ(1U, targets.size());
    EXPECT_EQ(5U, targets[0].colors.size()) << targets[0].colors;
  }
}

TEST(HiddenTargets, aSquareSheetOnAPlateIsNoRing)
{
  // Circles touch the sheet's sides, and farther out the plate's.
  TargetScene scene;
  scene.colors = "BPG";
  scene.radii = {11, 21.6, 32.4};
  scene.ground = {.02, .35, .6};
  scene.homography = tiltedView({240, 180}, .8, .7, 1, 900);
  for (const double sheet : {40., 42., 44.})
  {
    for (const double plate : {sheet + 9, sheet + 12})
    {
      scene.sheet_half_side = sheet;
      cv::Mat image = renderTarget(scene);
      std::vector<cv::Point> outline;
      for (const cv::Vec3d& corner :
           {cv::Vec3d(-plate, -plate, 1), {plate, -plate, 1}, {plate, plate, 1}, {-plate, plate, 1}})
      {
        const cv::Vec3d place = scene.homography * corner;
        outline.emplace_back(cvRound(place[0] / place[2]), cvRound(place[1] / place[2]));
      }
      cv::Mat beside(image.size(), CV_8UC1, cv::Scalar(255));
      cv::fillConvexPoly(beside, outline, cv::Scalar(0));
      image.setTo(cv::Scalar::all(50), beside);
      const std::vector<Target> targets = findTargetsIn(image);
      ASSERT_EQ(1U, targets.size()) << sheet << " " << plate;
      EXPECT_EQ("BPG", targets[0].colors) << sheet << " " << plate;
    }
  }
}

TEST(HiddenTargets, archesWithBarsAreNone)
{
  TargetScene scene;
  scene.colors = "PWPWP";
  for (const double degrees : {80., 100.})
  {
    cv::Mat image = renderTarget(scene);
    cv::rectangle(image, cv::Rect(0, 185, image.cols, image.rows - 185), cv::Scalar::all(200), cv::FILLED);
    drawBar(image, {-30, 0}, degrees, 16, {120, 125, 130});
    drawBar(image, {45, 0}, degrees, 16, {60, 130, 70});
    EXPECT_TRUE(findTargetsIn(image).empty()) << degrees;
  }
}

TEST(HiddenTargets, shadowsOfBarsTiltNoFamilyOfTwoCircles)
{
  TargetScene scene;
  scene.colors = "WRGBG";
  cv::Mat image = renderTarget(scene);
  cv::Mat shadows(image.size(), CV_8U, cv::Scalar(0));
  for (int k = -15; k < 15; ++k)
  {
    drawBar(shadows, {0, 12. * k}, 0, 4, cv::Scalar(255));
  }
  cv::Mat dark;
  image.convertTo(dark, -1, .3);
  dark.copyTo(image, shadows);
  cv::GaussianBlur(image, image, cv::Size(), .7);
  omr::EdgelMap map(image);
  omr::RingFamily family;
  family.center = {243, 184};
  omr::RingCandidate candidate;
  EXPECT_TRUE(omr::growCandidate(map, image, family, {80, 100}, candidate));
  EXPECT_EQ(5U, candidate.rings.radii.size());
  EXPECT_NEAR(0, cv::norm(candidate.rings.family.center - cv::Point2d(240, 180)), .5);
}

TEST(HiddenTargets, openDirectionsAreThoseWithTheEdges)
{
  TargetScene scene;
  cv::Mat image = renderTarget(scene);
  cv::rectangle(image, cv::Rect(0, 0, 238, 178), cv::Scalar::all(120), cv::FILLED);  // a quarter: 180 to 270 degrees
  omr::EdgelMap map(image);
  omr::Rings rings;
  rings.family.center = {240, 180};
  rings.radii = scene.radii;
  const AngleBins open = omr::openDirections(map, rings);
  const AngleBins hidden = AngleBins{0x3FFF} << 33;
  EXPECT_EQ(0U, open & hidden);
  EXPECT_GT(omr::share(open), .7);
}

TEST(HiddenTargets, sidesOfSpreadDirectionsAndOfHalf)
{
  EXPECT_NEAR(0, omr::onesidedness(~AngleBins{0}), 1e-9);
  EXPECT_NEAR(0, omr::onesidedness(0x00FF00FF00FF00FF), 1e-9);
  EXPECT_NEAR(.125, omr::widestGap(0x00FF00FF00FF00FF), 1e-9);
  EXPECT_NEAR(2 / CV_PI, omr::onesidedness(0xFFFFFFFF), .01);
}

TEST(HiddenTargets, tooFewOrOneSidedDirectionsAreGivenUpEarly)
{
  const auto may_suffice = [](AngleBins open, double rms, double evidence) {
    omr::RingCandidate candidate;
    candidate.rings.radii = {20, 40, 60};
    candidate.rings.open = open;
    candidate.rings.rms = rms;
    candidate.evidence = evidence;
    return omr::maySuffice(candidate);
  };
  EXPECT_TRUE(may_suffice(~AngleBins{0}, .1, .7));
  EXPECT_TRUE(may_suffice(0x00FFF00FFF00FFF0, .1, .7));  // 36 of 64, gaps of 8
  EXPECT_FALSE(may_suffice(0x00000000FFFFFFFF, .1, .7)) << "half a turn";
  EXPECT_FALSE(may_suffice(0x1111111111111111, .1, .7)) << "a quarter of them";
  EXPECT_FALSE(may_suffice(~AngleBins{0}, .4, .7)) << "fits badly and is not clear";
  EXPECT_TRUE(may_suffice(~AngleBins{0}, .4, .85)) << "may be bent";
}

TEST(HiddenTargets, ringsThatShowTooLittleAreGivenUpEarly)
{
  omr::RingCandidate candidate;
  omr::Boundary boundary;
  boundary.coherence = .9;
  boundary.agreeing = boundary.supported = 0xFFFFFFFF;  // half a turn
  candidate.boundaries.assign(3, boundary);
  EXPECT_FALSE(omr::showsEnough(candidate));
  candidate.boundaries.assign(4, boundary);
  EXPECT_TRUE(omr::showsEnough(candidate));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
