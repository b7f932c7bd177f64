#include "targets/narrow_rings.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "render_target.h"

namespace
{
/** Rings of equal width as a camera sees them that halves the resolution of hues, and their profile. */
omr::RingProfile profileOf(const std::string& colors, double width)
{
  TargetScene scene;
  scene.size = {80, 80};
  scene.homography = cv::Matx33d(1, 0, 40.3, 0, 1, 39.6, 0, 0, 1);
  scene.colors = colors;
  scene.radii.clear();
  for (std::size_t k = 1; k <= colors.size(); ++k)
  {
    scene.radii.push_back(static_cast<double>(k) * width);
  }
  scene.sheet_half_side = 35;
  std::vector<uchar> code;
  cv::imencode(".jpg", renderTarget(scene), code, {cv::IMWRITE_JPEG_QUALITY, 90});
  omr::RingFamily family;
  family.center = projectedCenter(scene);
  omr::RingProfile profile;
  omr::sampleProfile(cv::imdecode(code, cv::IMREAD_COLOR), family, 30, profile);
  return profile;
}

/** The letters, or what speaks against them. */
std::string read(const omr::RingProfile& profile, const std::vector<double>& found)
{
  omr::NarrowRings rings;
  if (!omr::readNarrowRings(profile, found, 1, rings))
  {
    return "not read";
  }
  EXPECT_EQ(rings.letters.size(), rings.radii.size());
  return rings.letters;
}
}  // namespace

TEST(NarrowRings, ringsOfThreePixelsKeepTheirColours)
{
  for (const std::string colors : {"WGRWR", "RWPGB", "GBGBR", "PGBWG"})
  {
    EXPECT_EQ(colors, read(profileOf(colors, 3), {3, 6, 9, 12, 15}));
  }
}

TEST(NarrowRings, aRingOfDoubleWidthIsTwoWhereNoInkLooksLikeIt)
{
  EXPECT_EQ("GPRGP", read(profileOf("GPRGP", 3), {3, 6, 12, 15}));
  EXPECT_EQ("WBPRP", read(profileOf("WBPRP", 3), {3, 9, 12, 15}));
}

TEST(NarrowRings, theMixtureOfTwoInksIsNoRing)
{
  EXPECT_EQ("GBG", read(profileOf("GBG", 4.7), {2.3, 4.7, 9.4, 14.1}));
}

TEST(NarrowRings, whatNoInksExplainIsNotRead)
{
  // Brighter than what is around them, in colours that no ink has.
  omr::RingProfile profile = profileOf("PRGPB", 3);
  for (cv::Vec3f& grey : profile.grey)
  {
    grey = cv::Vec3f(255, 255, 255) - .8F * grey;
  }
  EXPECT_EQ("not read", read(profile, {3, 6, 9, 12, 15}));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
