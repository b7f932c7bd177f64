#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "target_views.h"

using omr::Settings;
using omr::Target;
using omr::test::expectFound;
using omr::test::findTargetsIn;

namespace
{
/** Adds a share of another colour's light to the ring between two radii around (240, 180) [px]. */
void mixInto(cv::Mat& image, double inner, double outer, const cv::Vec3b& other, double share)
{
  const auto light = [](double grey) { return std::pow(grey / 255, 2.2); };
  image.forEach<cv::Vec3b>([&](cv::Vec3b& pixel, const int* place) {
    const double radius = std::hypot(place[1] - 240, place[0] - 180);
    for (int c = 0; c < 3 && radius > inner && radius < outer; ++c)
    {
      const double mixture = share * light(other[c]) + (1 - share) * light(pixel[c]);
      pixel[c] = cv::saturate_cast<uchar>(255 * std::pow(mixture, 1 / 2.2));
    }
  });
}
}  // namespace

TEST(Targets, readsEveryColourOnPaper)
{
  for (const std::string colors : {"RWPGB", "WPWPB", "PBGRP", "BGWRG"})
  {
    TargetScene scene;
    scene.colors = colors;
    expectFound(scene, colors);
  }
}

TEST(Targets, centreIsTheImageOfTheCirclesCentreUnderPerspective)
{
  TargetScene scene;
  for (const double direction : {0., 1., 2.5})
  {
    scene.homography = tiltedView({250, 170}, .8, direction, 1, 500);
    expectFound(scene, "RWPGB");
  }
}

TEST(Targets, ringsAreTheEllipsesOfTheCircles)
{
  TargetScene scene;
  scene.homography = tiltedView({240, 180}, .7, .5, 1, 600);
  const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
  ASSERT_EQ(1U, targets.size());
  ASSERT_EQ(5U, targets[0].rings.size());
  for (std::size_t k = 0; k < 5; ++k)
  {
    std::vector<cv::Point2f> outline;
    for (int i = 0; i < 90; ++i)
    {
      const double phi = 2 * CV_PI * i / 90;
      const cv::Vec3d p =
          scene.homography * cv::Vec3d(scene.radii[k] * std::cos(phi), scene.radii[k] * std::sin(phi), 1);
      outline.emplace_back(static_cast<float>(p[0] / p[2]), static_cast<float>(p[1] / p[2]));
    }
    const cv::RotatedRect expected = cv::fitEllipse(outline);
    const cv::RotatedRect& ring = targets[0].rings[k];
    EXPECT_NEAR(expected.center.x, ring.center.x, .2);
    EXPECT_NEAR(expected.center.y, ring.center.y, .2);
    EXPECT_NEAR(std::max(expected.size.width, expected.size.height), std::max(ring.size.width, ring.size.height), 1);
    EXPECT_NEAR(std::min(expected.size.width, expected.size.height), std::min(ring.size.width, ring.size.height), 1);
  }
}

TEST(Targets, narrowRingsAreReadEnlarged)
{
  // Rings of 2.5 px leave neither regions nor edges apart: only a twofold enlargement of the round spot shows five.
  TargetScene scene;
  scene.radii = {2.5, 5, 7.5, 10, 12.5};
  scene.sheet_half_side = 15;
  scene.blur = .5;
  for (const std::string colors : {"RWPGB", "BWRWP", "PWPWR"})
  {
    scene.colors = colors;
    scene.homography = tiltedView({240.3, 180.6}, .5, 1, 1, 2000);
    const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
    ASSERT_EQ(1U, targets.size()) << colors;
    EXPECT_EQ(colors, targets[0].colors);
    EXPECT_LT(cv::norm(targets[0].center - projectedCenter(scene)), .15);
    ASSERT_EQ(5U, targets[0].rings.size());
    EXPECT_NEAR(25, std::max(targets[0].rings[4].size.width, targets[0].rings[4].size.height), .7);
  }
}

TEST(Targets, aRingThatTheBlurHidesIsToldByInks)
{
  // Two boundaries show of these. Of 180 targets of three rings of 2.4 to 3.8 px, drawn so, 133 are read, none wrong;
  // without the inks 111.
  struct Blurred
  {
    std::string colors;
    double width;
    double blur;
  };
  for (const Blurred& blurred : {Blurred{"RPG", 3.4, 1.2}, Blurred{"BPR", 3.4, 1.2}, Blurred{"PGP", 2.7, .9},
                                 Blurred{"GPG", 2.4, .9}, Blurred{"BRP", 2.4, .6}})
  {
    TargetScene scene;
    scene.colors = blurred.colors;
    scene.radii = {blurred.width, 2 * blurred.width, 3 * blurred.width};
    scene.blur = blurred.blur;
    scene.sheet_half_side = 20;
    scene.homography = tiltedView({240.3, 180.6}, .5, 1, 1, 2000);
    const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
    ASSERT_EQ(1U, targets.size()) << blurred.colors;
    EXPECT_EQ(blurred.colors, targets[0].colors);
  }
}

TEST(Targets, twoNarrowRingsAreNone)
{
  for (const std::string colors : {"GR", "RB", "PR"})
  {
    TargetScene scene;
    scene.colors = colors;
    scene.radii = {4.5, 9};
    scene.sheet_half_side = 20;
    EXPECT_TRUE(findTargetsIn(renderTarget(scene)).empty()) << colors;
  }
}

TEST(Targets, ringsOfUnequalWidth)
{
  TargetScene scene;
  scene.radii = {30, 40, 70, 82, 100};
  expectFound(scene, "RWPGB");
  scene.radii = {12, 42, 54, 90, 100};
  expectFound(scene, "RWPGB");
}

TEST(Targets, haloOfAnEdgeIsNoRing)
{
  // Beside red, part of the blue ring has some of red's light, as compression leaves it: a third, and more than half.
  TargetScene scene;
  scene.colors = "RBWGB";
  const cv::Mat image = renderTarget(scene);
  for (const auto& [outer, share] : {std::pair(26., .15), std::pair(31., .5)})
  {
    cv::Mat stained = image.clone();
    mixInto(stained, 20, outer, image.at<cv::Vec3b>(180, 250), share);
    const std::vector<Target> targets = findTargetsIn(stained);
    ASSERT_EQ(1U, targets.size());
    EXPECT_EQ("RBWGB", targets[0].colors) << outer;
  }
}

TEST(Targets, halosMakeNoNarrowRings)
{
  // Two halos among rings of 8.5 px: of their width in the mean as narrow as those that inks read.
  TargetScene scene;
  scene.colors = "BGBRG";
  scene.radii = {8.5, 17, 25.5, 34, 42.5};
  scene.sheet_half_side = 55;
  cv::Mat image = renderTarget(scene);
  const auto color_at = [&](int radius) { return image.at<cv::Vec3b>(180, 240 + radius); };
  const cv::Vec3b green = color_at(13);
  const cv::Vec3b blue = color_at(21);
  mixInto(image, 4.2, 8.5, green, .25);
  mixInto(image, 25.5, 30, blue, .4);
  const std::vector<Target> targets = findTargetsIn(image);
  ASSERT_EQ(1U, targets.size());
  EXPECT_EQ("BGBRG", targets[0].colors);
}

TEST(Targets, threeRingsToNine)
{
  TargetScene scene;
  scene.colors = "BWR";
  scene.radii = {33, 66, 100};
  expectFound(scene, "BWR");
  scene.colors = "RWPWGWBWP";
  scene.radii = {11, 22, 33, 44, 55, 66, 77, 88, 99};
  expectFound(scene, "RWPWGWBWP");
}

TEST(Targets, whiteOutermostRingOnDarkGround)
{
  TargetScene scene;
  scene.sheet_half_side = 0;
  scene.ground = {.05, .05, .05};
  scene.colors = "RPGW";
  scene.radii = {25, 50, 75, 100};
  expectFound(scene, "RPGW");
}

TEST(Targets, colouredAndTexturedGround)
{
  TargetScene scene;
  scene.sheet_half_side = 0;
  scene.colors = "BWPWR";
  scene.ground = {.05, .4, .6};
  expectFound(scene, "BWPWR");
  scene.ground = {.3, .3, .3};
  scene.texture = .6;
  expectFound(scene, "BWPWR");
}

TEST(Targets, smallRings)
{
  TargetScene scene;
  scene.colors = "WPWP";
  scene.radii = {5, 10, 15, 20};
  expectFound(scene, "WPWP");
}

TEST(Targets, narrowRingsWithHuesAtHalfTheResolution)
{
  TargetScene scene;
  scene.colors = "PGRPG";
  scene.radii = {4.1, 8.2, 12.3, 16.4, 20.5};
  scene.blur = .9;
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", renderTarget(scene), jpeg, {cv::IMWRITE_JPEG_QUALITY, 85});
  const std::vector<Target> targets = findTargetsIn(cv::imdecode(jpeg, cv::IMREAD_COLOR));
  ASSERT_EQ(1U, targets.size());
  EXPECT_EQ("PGRPG", targets[0].colors);
}

TEST(Targets, noneWhereTheBlurHidesRings)
{
  for (const std::string colors : {"GPWPRB", "BPWPRP"})
  {
    TargetScene scene;
    scene.colors = colors;
    scene.radii = {2, 4.7, 8.1, 10.1, 12.8, 16.2};
    scene.sheet_half_side = 30;
    EXPECT_TRUE(findTargetsIn(renderTarget(scene)).empty());
  }
}

TEST(Targets, minRingsDecidesAboutTwoRings)
{
  TargetScene scene;
  scene.colors = "RP";
  scene.radii = {45, 90};
  const cv::Mat image = renderTarget(scene);
  EXPECT_TRUE(findTargetsIn(image).empty());
  Settings settings;
  settings.target_min_rings = 2;
  const std::vector<Target> targets = findTargetsIn(image, settings);
  ASSERT_EQ(1U, targets.size());
  EXPECT_EQ("RP", targets[0].colors);
}

TEST(Targets, noneInSquaresCheckerboardsAndNoise)
{
  cv::Mat image(400, 600, CV_8UC3, cv::Scalar::all(230));
  for (int k = 5; k > 0; --k)
  {
    const cv::Rect square(150 - 25 * k, 150 - 25 * k, 50 * k, 50 * k);
    cv::rectangle(image, square, k % 2 ? cv::Scalar(40, 40, 200) : cv::Scalar(230, 230, 230), cv::FILLED);
  }
  for (int row = 0; row < 8; ++row)
  {
    for (int col = 0; col < 6; ++col)
    {
      cv::rectangle(image, cv::Rect(330 + 40 * col, 40 + 40 * row, 40, 40), cv::Scalar::all((row + col) % 2 ? 20 : 220),
                    cv::FILLED);
    }
  }
  EXPECT_TRUE(findTargetsIn(image).empty());
  cv::RNG random(7);
  random.fill(image, cv::RNG::NORMAL, 128, 60);
  EXPECT_TRUE(findTargetsIn(image).empty());
}

TEST(Targets, noneInCirclesThatAreNotConcentric)
{
  cv::Mat image(400, 400, CV_8UC3, cv::Scalar::all(230));
  cv::circle(image, {200, 200}, 150, cv::Scalar::all(30), cv::FILLED, cv::LINE_AA);
  cv::circle(image, {240, 180}, 90, cv::Scalar::all(230), cv::FILLED, cv::LINE_AA);
  cv::circle(image, {200, 200}, 40, cv::Scalar(30, 30, 200), cv::FILLED, cv::LINE_AA);
  EXPECT_TRUE(findTargetsIn(image).empty());
}

TEST(Targets, survivesTinyImages)
{
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 1), cv::Size(2, 200), cv::Size(33, 33)})
  {
    EXPECT_TRUE(findTargetsIn(cv::Mat(size, CV_8UC3, cv::Scalar::all(90))).empty());
  }
  omr::Frame frame;
  EXPECT_TRUE(omr::findTargets(frame, {}, {}, Settings()).empty());
}

TEST(Targets, ofMoreThanNineRingsAreReadAsTheyAre)
{
  TargetScene scene;
  scene.colors = "PWPWPWPWPWP";
  scene.radii.clear();
  for (std::size_t k = 1; k <= scene.colors.size(); ++k)
  {
    scene.radii.push_back(9. * static_cast<double>(k));
  }
  const std::vector<Target> targets = findTargetsIn(renderTarget(scene));
  ASSERT_EQ(1U, targets.size());
  EXPECT_EQ(scene.colors, targets[0].colors);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
