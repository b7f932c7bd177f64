#include "ring_boundaries.h"

#include <gtest/gtest.h>

#include "render_target.h"

using omr::Boundary;

namespace
{
/** Boundaries of a scene whose family is known. */
std::vector<Boundary> boundariesOf(const TargetScene& scene, const std::vector<double>& known = {})
{
  const cv::Mat image = renderTarget(scene);
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

TEST(RingBoundaries, whiteOnWhiteIsNone)
{
  TargetScene scene;
  scene.colors = "RPGBW";
  const std::vector<Boundary> boundaries = boundariesOf(scene);
  EXPECT_EQ(4U, boundaries.size());
}

TEST(RingBoundaries, mostDirectionsAgree)
{
  for (const Boundary& boundary : boundariesOf(TargetScene()))
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

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
