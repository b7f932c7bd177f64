#include "targets/boundaries/ring_boundaries.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_target.h"
#include "targets/boundaries/ring_roundness.h"
#include "targets/candidate/ring_own_boundary.h"

using omr::Boundary;

namespace
{
/** Boundaries in the image of a scene whose family is known. */
std::vector<Boundary> boundariesIn(const cv::Mat& image, const TargetScene& scene,
                                   const std::vector<double>& known = {})
{
  omr::RingFamily family;
  family.center = projectedCenter(scene);
  const double reach = scene.radii.back() * 1.5;
  omr::RingProfile profile;
  omr::sampleProfile(image, family, reach, profile);
  omr::EdgelMap map(image);
  std::vector<omr::RadialEdgel> edgels;
  omr::collectRadialEdgels(map, family, reach, .9, edgels);
  return omr::findBoundaries(profile, omr::AngularSupport(edgels, reach), known);
}

std::vector<Boundary> boundariesOf(const TargetScene& scene, const std::vector<double>& known = {})
{
  return boundariesIn(renderTarget(scene), scene, known);
}

/** The boundaries where the ground has the colour of the outermost ring in a share of the directions. */
std::size_t countOnAlikeGround(const TargetScene& scene, double share)
{
  cv::Mat image = renderTarget(scene);
  const cv::Point2d center = projectedCenter(scene);
  const double middle = .5 * (scene.radii[scene.radii.size() - 2] + scene.radii.back());
  const cv::Vec3b color = image.at<cv::Vec3b>(cv::Point2d(center.x + middle, center.y));
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      const cv::Point2d q = cv::Point2d(x, y) - center;
      if (cv::norm(q) > middle && std::abs(std::atan2(q.y, q.x)) < CV_PI * share)
      {
        image.at<cv::Vec3b>(y, x) = color;
      }
    }
  }
  return boundariesIn(image, scene).size();
}

/** Three rings without a sheet, the outermost green. */
TargetScene greenOnGround(const std::vector<double>& radii, const cv::Vec3d& ground)
{
  TargetScene scene;
  scene.colors = "RWG";
  scene.radii = radii;
  scene.sheet_half_side = 0;
  scene.ground = ground;
  return scene;
}

void expectRadii(const TargetScene& scene)
{
  const std::vector<Boundary> boundaries = boundariesOf(scene);
  ASSERT_EQ(scene.radii.size(), boundaries.size());
  for (std::size_t k = 0; k < boundaries.size(); ++k)
  {
    EXPECT_NEAR(scene.radii[k], boundaries[k].radius, 1);
    EXPECT_GT(boundaries[k].contrast, .1);
  }
}
}  // namespace

TEST(RingBoundaries, equalWidths)
{
  expectRadii(TargetScene());
}

TEST(RingBoundaries, widthsOfOneToFour)
{
  TargetScene scene;
  scene.radii = {12, 48, 60, 90, 100};
  expectRadii(scene);
}

TEST(RingBoundaries, aShadowsEdgeAndTheSheetsAreNone)
{
  TargetScene scene;
  scene.shadow = .25;
  scene.sheet_half_side = 120;
  expectRadii(scene);
}

TEST(RingBoundaries, theEdgeOfASmallSheetIsNone)
{
  TargetScene scene;
  scene.radii = {7, 14, 21, 28, 35};
  for (const double half_side : {38., 42., 46.})
  {
    scene.sheet_half_side = half_side;
    expectRadii(scene);
  }
}

TEST(RingBoundaries, groundMayResembleTheOutermostRingInPlaces)
{
  EXPECT_EQ(3U, countOnAlikeGround(greenOnGround({10, 20, 30}, {.3, .3, .32}), .45));
  EXPECT_EQ(2U, countOnAlikeGround(greenOnGround({10, 20, 30}, {.3, .3, .32}), .7));
}

TEST(RingBoundaries, aNarrowFaintRingNeedsEdgesInMostDirections)
{
  EXPECT_EQ(3U, countOnAlikeGround(greenOnGround({15, 30, 35}, {.1, .17, .06}), .35));
}

TEST(Roundness, aStepWithoutEdgesIsNoSmallRing)
{
  const auto roundnessAt = [](double scale, omr::AngleBins edges_inside, omr::AngleBins edges_outside) {
    std::vector<Boundary> boundaries(3);
    for (std::size_t k = 0; k < boundaries.size(); ++k)
    {
      boundaries[k].radius = scale * static_cast<double>(k + 1);
      boundaries[k].contrast = 1;
      boundaries[k].seen = boundaries[k].agreeing = ~omr::AngleBins{0};
      boundaries[k].supported = k + 1 < boundaries.size() ? edges_inside : edges_outside;
    }
    return omr::roundness(boundaries, omr::AngularSupport({}, 4 * scale));
  };
  constexpr omr::AngleBins ALL = ~omr::AngleBins{0};
  constexpr omr::AngleBins QUARTER = 0x1111111111111111U;
  EXPECT_LT(roundnessAt(5, ALL, QUARTER), 1) << "a square sheet";
  EXPECT_GE(roundnessAt(5, ALL, ALL), 1);
  EXPECT_GE(roundnessAt(5, QUARTER, QUARTER), 1) << "the rings inside have no more edges";
  EXPECT_GE(roundnessAt(20, ALL, QUARTER), 1) << "no square's sides come so near to a large circle";
}

TEST(RingBoundaries, whiteOnWhiteIsNone)
{
  TargetScene scene;
  scene.colors = "RPGBW";
  const std::vector<Boundary> boundaries = boundariesOf(scene);
  EXPECT_EQ(4U, boundaries.size());
}

TEST(RingBoundaries, mostDirectionsAgree)
{
  const std::vector<Boundary> boundaries = boundariesOf(TargetScene());
  ASSERT_EQ(5U, boundaries.size());
  for (const Boundary& boundary : boundaries)
  {
    EXPECT_GT(boundary.agreement, .95);
    EXPECT_GT(boundary.coherence, .95);
    EXPECT_GT(omr::share(boundary.supported), .95);
  }
}

TEST(RingBoundaries, aKnownRadiusNeedsEvidenceToo)
{
  TargetScene scene;
  scene.colors = "RP";
  scene.radii = {50, 100};
  EXPECT_EQ(2U, boundariesOf(scene, {25, 75}).size());
}

TEST(RingBoundaries, noneInNoise)
{
  cv::Mat image(200, 200, CV_8UC3);
  cv::RNG random(11);
  random.fill(image, cv::RNG::NORMAL, 120, 30);
  omr::RingFamily family;
  family.center = {100, 100};
  omr::RingProfile profile;
  omr::sampleProfile(image, family, 80, profile);
  EXPECT_TRUE(omr::findBoundaries(profile, omr::AngularSupport({}, 80), {}).empty());
}

TEST(RingProfile, interpolatesUpToTheLastPixel)
{
  cv::Mat image(17, 20, CV_8UC3);
  cv::RNG(3).fill(image, cv::RNG::UNIFORM, 0, 256);
  omr::RingFamily family;
  family.center = {15.3, 12.6};
  omr::RingProfile profile;
  omr::sampleProfile(image, family, 8, profile);
  int near_the_end = 0;
  for (int angle = 0; angle < omr::RingProfile::ANGLES; ++angle)
  {
    const double phi = 2 * CV_PI * (angle + .5) / omr::RingProfile::ANGLES;
    for (int i = 0; i < profile.inside[angle]; ++i)
    {
      const cv::Point2d point = family.center + i * profile.step * cv::Point2d(std::cos(phi), std::sin(phi));
      const cv::Point pixel(static_cast<int>(point.x), static_cast<int>(point.y));
      const cv::Point2d part = point - cv::Point2d(pixel);
      near_the_end += pixel == cv::Point(18, 15) ? 1 : 0;
      for (int c = 0; c < 3; ++c)
      {
        const auto at = [&](int x, int y) { return image.at<cv::Vec3b>(pixel.y + y, pixel.x + x)[c]; };
        const double above = at(0, 0) * (1 - part.x) + at(1, 0) * part.x;
        const double below = at(0, 1) * (1 - part.x) + at(1, 1) * part.x;
        const double expected = above * (1 - part.y) + below * part.y;
        EXPECT_NEAR(expected, profile.greyRay(angle)[i][c], .01);
        EXPECT_NEAR(expected, omr::greyLevel(profile.ray(angle)[i][c]), .15);
      }
    }
  }
  EXPECT_GT(near_the_end, 0);
}

TEST(RingBoundaries, edgesOfEitherSignSupportAChangeOfHue)
{
  // Red falls as blue rises: which of them is the stronger edge may differ from place to place.
  TargetScene scene;
  scene.colors = "RBRBR";
  const cv::Mat image = renderTarget(scene);
  omr::RingFamily family;
  family.center = projectedCenter(scene);
  constexpr double REACH = 120;
  omr::RingProfile profile;
  omr::sampleProfile(image, family, REACH, profile);
  omr::EdgelMap map(image);
  std::vector<omr::RadialEdgel> edgels;
  omr::collectRadialEdgels(map, family, REACH, .9, edgels);
  for (omr::RadialEdgel& edgel : edgels)
  {
    edgel.brighter_outside = edgel.brighter_outside != (edgel.position.x > family.center.x);
  }
  const std::vector<Boundary> boundaries = omr::findBoundaries(profile, omr::AngularSupport(edgels, REACH), {});
  ASSERT_EQ(5U, boundaries.size());
  for (const Boundary& boundary : boundaries)
  {
    EXPECT_GT(omr::share(boundary.supported), .9) << boundary.radius;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
