#include "targets/letters/ring_colors.h"

#include <gtest/gtest.h>

#include "render_target.h"

using omr::LinearColor;

namespace
{
/** A scene's profile and boundaries, its family being known. */
struct Look
{
  explicit Look(const TargetScene& scene)
  {
    const cv::Mat image = renderTarget(scene);
    omr::RingFamily family;
    family.center = projectedCenter(scene);
    const double reach = scene.radii.back() * 1.3;
    omr::sampleProfile(image, family, reach, profile);
    omr::EdgelMap map(image);
    std::vector<omr::RadialEdgel> edgels;
    omr::collectRadialEdgels(map, family, reach, .9, edgels);
    boundaries = omr::findBoundaries(profile, omr::AngularSupport(edgels, reach), scene.radii);
  }

  omr::RingProfile profile;
  std::vector<omr::Boundary> boundaries;
};

/** Brightness of a ring relative to what is around the target. */
double brightness(const std::vector<LinearColor>& colors, std::size_t ring)
{
  return colors[ring][1] / colors.back()[1];
}
}  // namespace

TEST(RingColors, aDiskInTheShadeIsChainedToTheSunnyRings)
{
  // A bar's shadow covers the disk and crosses the rings, most of which are in the sun.
  TargetScene scene;
  scene.colors = "WPGBG";
  scene.shadow = .08;
  scene.shadow_offset = -23;
  scene.shadow_width = 46;
  const Look look(scene);
  ASSERT_EQ(5U, look.boundaries.size());
  const std::vector<LinearColor> colors = omr::measureRingColors(look.profile, look.boundaries, scene.radii);
  EXPECT_GT(brightness(colors, 0), .5);
  EXPECT_NEAR(.07, brightness(colors, 1), .04);
}

TEST(RingColors, theBrightestDirectionsAreThoseInTheSun)
{
  TargetScene scene;
  scene.colors = "WPGBG";
  scene.shadow = .1;
  scene.shadow_offset = -40;  // two thirds are in the shade, the disk altogether
  const Look look(scene);
  const std::vector<LinearColor> bright = omr::measureColorsIn(omr::Light::brightest, look.profile, scene.radii);
  EXPECT_NEAR(.3, brightness(bright, 2), .07);
  EXPECT_NEAR(.1, bright[0][1] / bright.back()[1], .05);
}

TEST(RingColors, theDarkestDirectionsAreThoseWithoutGloss)
{
  TargetScene scene;
  scene.gloss = 2;
  scene.gloss_offset = {60, 20};
  const Look look(scene);
  const std::vector<LinearColor> dark = omr::measureColorsIn(omr::Light::darkest, look.profile, scene.radii);
  EXPECT_NEAR(.07, brightness(dark, 2), .03);
  const std::vector<LinearColor> bright = omr::measureColorsIn(omr::Light::brightest, look.profile, scene.radii);
  EXPECT_GT(brightness(bright, 2), .3);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
