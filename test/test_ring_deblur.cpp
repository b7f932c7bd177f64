#include "targets/boundaries/ring_deblur.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render_target.h"
#include "targets/boundaries/ring_fit.h"
#include "targets/letters/color_key.h"
#include "targets/letters/hidden_rings.h"
#include "targets/letters/ring_letters.h"

namespace
{
/** Rings of 4 px, as a camera with a colour filter sees them: hues at half the resolution. */
omr::RingProfile profileOf(TargetScene scene)
{
  scene.size = {80, 80};
  scene.homography = cv::Matx33d(1, 0, 40.3, 0, 1, 39.6, 0, 0, 1);
  scene.sheet_half_side = 35;
  const cv::Mat image = renderTarget(scene);
  omr::RingFamily family;
  family.center = projectedCenter(scene);
  omr::RingProfile profile;
  omr::sampleProfile(image, family, 30, profile);
  return profile;
}

std::string letters(const omr::RingProfile& profile, const std::vector<double>& radii)
{
  std::vector<omr::LinearColor> colors;
  for (const cv::Vec3d& color : omr::deblurredColors(profile, radii))
  {
    colors.emplace_back(omr::linearLight(color[2]), omr::linearLight(color[1]), omr::linearLight(color[0]));
  }
  return omr::readColorKey({[&] { return colors; }}, std::vector<bool>(radii.size(), true), true, false).letters;
}

/** Grey rings behind a blur of 1 px. @param brightness of each, and of what is around them [grey levels] */
omr::RingProfile greyRings(const std::vector<double>& radii, const std::vector<double>& brightness)
{
  omr::RingProfile profile;
  profile.step = .5;
  profile.count = 80;
  profile.inside.assign(omr::RingProfile::ANGLES, profile.count);
  profile.grey.create(omr::RingProfile::ANGLES, profile.count);
  profile.color.create(omr::RingProfile::ANGLES, profile.count);
  for (int sample = 0; sample < profile.count; ++sample)
  {
    const double r = profile.step * sample;
    double value = brightness[0];
    for (std::size_t k = 0; k < radii.size(); ++k)
    {
      value += (brightness[k + 1] - brightness[k]) * .5 * std::erfc((radii[k] - r) / std::sqrt(2.));
    }
    profile.grey.col(sample).setTo(cv::Scalar::all(value));
    profile.color.col(sample).setTo(cv::Scalar::all(std::log(value + omr::DARK_LEVEL)));
  }
  return profile;
}

/** Four of which the third and the fourth differ. @param step [grey levels] */
omr::RingProfile fourRings(double step)
{
  return greyRings({24, 28, 32, 36}, {200, 60, 160, 160 - step, 60});
}
}  // namespace

TEST(RingDeblur, narrowRingsKeepTheirColours)
{
  TargetScene scene;
  scene.radii = {4, 8, 12, 16, 20};
  scene.blur = 1;
  for (const std::string colors : {"RWPGB", "PGRPG", "GBWBR", "WBRWP"})
  {
    scene.colors = colors;
    EXPECT_EQ(colors, letters(profileOf(scene), scene.radii));
  }
}

TEST(RingDeblur, aBoundaryThatIsMissingIsFound)
{
  TargetScene scene;
  scene.radii = {4, 8, 12, 16, 20};
  scene.colors = "WBWRP";
  scene.blur = 1;
  const omr::RingProfile profile = profileOf(scene);
  EXPECT_NEAR(16, omr::mergedBoundary(profile, {4, 8, 12, 20}), .8);
  EXPECT_NEAR(8, omr::mergedBoundary(profile, {4, 12, 16, 20}), .8);
}

TEST(RingDeblur, aMissingBoundaryOfASeventhOfTheContrastIsFound)
{
  EXPECT_NEAR(32, omr::mergedBoundary(fourRings(20), {24, 28, 36}), .5);
  EXPECT_EQ(0, omr::mergedBoundary(fourRings(12), {24, 28, 36}));
}

TEST(RingDeblur, completeRingsMissNone)
{
  TargetScene scene;
  scene.radii = {4, 8, 12, 16, 20};
  scene.blur = 1;
  EXPECT_EQ(0, omr::mergedBoundary(profileOf(scene), scene.radii));
  scene.radii = {4, 12, 16, 25};
  scene.colors = "RWGP";
  EXPECT_EQ(0, omr::mergedBoundary(profileOf(scene), scene.radii));
}

TEST(RingDeblur, aBlackSeamBetweenTwoHuesIsARing)
{
  TargetScene scene;
  scene.radii = {5, 10, 15, 20, 25};
  scene.blur = 1.3;
  for (const std::string colors : {"WGPRB", "WBRPB"})
  {
    scene.colors = colors;
    std::vector<double> found = scene.radii;
    const std::size_t ring = colors.find('P');
    const double middle = (found[ring - 1] + found[ring]) / 2;
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(ring));
    found[ring - 1] = middle;
    const omr::RingProfile profile = profileOf(scene);
    const omr::SeamRing seam = omr::seamRing(profile, found, std::vector<bool>(found.size(), true));
    EXPECT_EQ(ring - 1, seam.boundary) << colors;
    EXPECT_NEAR(2.5, seam.half_width, 1) << colors;
    EXPECT_EQ(0, omr::seamRing(profile, found, std::vector<bool>(found.size(), false)).half_width) << colors;
    EXPECT_EQ(0, omr::seamRing(profile, scene.radii, std::vector<bool>(scene.radii.size(), true)).half_width) << colors;
  }
  scene.colors = "GRBG";  // no seam is where two hues meet
  scene.radii = {5, 10, 15, 20};
  EXPECT_EQ(0, omr::seamRing(profileOf(scene), scene.radii, std::vector<bool>(4, true)).half_width);
}

TEST(RingDeblur, whatTheBlurHidesIsLeftUnexplained)
{
  TargetScene scene;
  scene.radii = {4, 8, 12, 16, 20};
  scene.colors = "WBWRP";
  const omr::RingProfile profile = profileOf(scene);
  EXPECT_LT(omr::unexplained(profile, scene.radii), .057);
  EXPECT_GT(omr::unexplained(profile, {4, 8, 12, 20}), .08);
}

TEST(RingFit, theBlurMayBeSharperOrWiderThanUsual)
{
  const std::vector<double> radii = {30, 33, 36};
  const std::vector<double> brightness = {200, 60, 180, 80};
  for (const double deviation : {.6, 1., 1.4})
  {
    std::vector<cv::Vec3d> samples;
    for (int i = 0; i < 80; ++i)
    {
      double value = brightness[0];
      for (std::size_t k = 0; k < radii.size(); ++k)
      {
        value +=
            (brightness[k + 1] - brightness[k]) * .5 * std::erfc((radii[k] - .5 * i) / (deviation * std::sqrt(2.)));
      }
      samples.emplace_back(value, 0, 0);
    }
    const omr::RingFit::Result fit = omr::RingFit(samples, .5, radii).fit();
    for (std::size_t k = 0; k < brightness.size(); ++k)
    {
      EXPECT_NEAR(brightness[k], fit.colors[k][0], 3);
    }
  }
}

TEST(RingFit, aRadiusThatCameAndWentLeavesNoTrace)
{
  std::vector<cv::Vec3d> samples;
  for (int i = 0; i < 60; ++i)
  {
    samples.push_back(i < 10 || i > 30 ? cv::Vec3d(200, 5, -5) : cv::Vec3d(60, 40, 10));
  }
  omr::RingFit fit(samples, .5, {5, 15.5});
  const omr::RingFit::Result two = fit.fit();
  fit.insert(1, 9);
  const omr::RingFit::Result three = fit.fit();
  fit.erase(1);
  const omr::RingFit::Result again = fit.fit();
  ASSERT_EQ(3U, two.colors.size());
  EXPECT_NEAR(60, two.colors[1][0], 6);
  EXPECT_NEAR(40, two.colors[1][1], 6);
  EXPECT_EQ(4U, three.colors.size());
  EXPECT_LT(three.rms, two.rms);
  EXPECT_EQ(two.rms, again.rms);
  EXPECT_EQ(two.colors, again.colors);
}

TEST(RingDeblur, inksThatExplainNarrowRingsHideNone)
{
  omr::RingCandidate candidate;
  candidate.rings.radii = {24, 28, 36};
  candidate.boundaries.resize(3);
  candidate.profile = std::make_shared<omr::RingProfile>(fourRings(100));
  EXPECT_TRUE(omr::hidesRings(candidate, std::string(candidate.rings.radii.size(), 'W'))) << "two rings are one";
  candidate.is_explained = true;
  EXPECT_FALSE(omr::hidesRings(candidate, std::string(candidate.rings.radii.size(), 'W')));
}

TEST(RingDeblur, whatHasNoLetterAndIsAsWideAsTwoIsTwo)
{
  omr::RingCandidate candidate;
  candidate.rings.radii = {10, 20, 38};
  candidate.boundaries.resize(3);
  candidate.profile = std::make_shared<omr::RingProfile>(greyRings({10, 20, 38}, {200, 60, 200, 60}));
  EXPECT_FALSE(omr::hidesRings(candidate, "WPW"));
  EXPECT_FALSE(omr::hidesRings(candidate, "?PW"));
  EXPECT_TRUE(omr::hidesRings(candidate, "WP?"));
  EXPECT_FALSE(omr::hidesRings(candidate, "???")) << "their centre is all that is told";
}

TEST(RingDeblur, evenRingsThatAreReadHideNoneForLittleThatIsUnexplained)
{
  omr::RingCandidate candidate;
  candidate.visible = 1;
  candidate.evidence = 1;
  const auto hides = [&](double ripple, const std::vector<double>& radii, const std::string& letters) {
    omr::RingProfile profile = greyRings(radii, {200, 60, 200, 60, 200});
    for (int sample = 0; sample < profile.count; ++sample)
    {
      profile.grey.col(sample) += cv::Scalar::all(sample % 4 < 2 ? ripple : -ripple);
    }
    candidate.rings.radii = radii;
    candidate.boundaries.resize(radii.size());
    candidate.profile = std::make_shared<omr::RingProfile>(profile);
    return omr::hidesRings(candidate, letters);
  };
  const std::vector<double> even = {4, 8, 12, 16};
  EXPECT_FALSE(hides(0, even, "WPW?"));
  EXPECT_TRUE(hides(10, even, "WPW?"));
  EXPECT_FALSE(hides(10, even, "WPWP"));
  EXPECT_TRUE(hides(10, {4, 8, 15, 19}, "WPWP")) << "a ring that is wider may be two";
  EXPECT_TRUE(hides(20, even, "WPWP"));
  EXPECT_TRUE(hides(5, {3, 6, 12, 15}, "WPWP")) << "one may be two";
  EXPECT_FALSE(hides(5, {3, 6, 9, 12}, "WPWP"));
  candidate.visible = .8;
  EXPECT_TRUE(hides(10, even, "WPWP")) << "something may hide them";
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
