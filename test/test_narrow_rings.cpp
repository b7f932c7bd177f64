#include "targets/letters/narrow_rings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "render_target.h"

namespace
{
/** The picture behind a haze that has the colour of its white. @param share of the haze in the light. */
cv::Mat behindHaze(const cv::Mat& bgr, const cv::Vec3b& white, double share)
{
  constexpr double GAMMA = 2.2;
  cv::Mat levels(1, 256, CV_8UC3);
  for (int level = 0; level < levels.cols; ++level)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double light = share * std::pow(white[c] / 255., GAMMA) + (1 - share) * std::pow(level / 255., GAMMA);
      levels.at<cv::Vec3b>(0, level)[c] = cv::saturate_cast<uchar>(255 * std::pow(light, 1 / GAMMA));
    }
  }
  cv::Mat hazy;
  cv::LUT(bgr, levels, hazy);
  return hazy;
}

/** Rings of equal width as a camera sees them that halves the resolution of hues, and their profile. */
omr::RingProfile profileOf(const std::string& colors, double width, double haze = 0, double half_side = 35)
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
  scene.sheet_half_side = half_side;
  scene.ground = {.1, .12, .1};
  std::vector<uchar> code;
  const cv::Mat clear = renderTarget(scene);
  const cv::Mat seen = behindHaze(clear, clear.at<cv::Vec3b>(10, 40), haze);
  cv::imencode(".jpg", seen, code, {cv::IMWRITE_JPEG_QUALITY, 90});
  omr::RingFamily family;
  family.center = projectedCenter(scene);
  omr::RingProfile profile;
  omr::sampleProfile(cv::imdecode(code, cv::IMREAD_COLOR), family, 30, profile);
  return profile;
}

/** The letters, or what speaks against them. */
std::string read(const omr::RingProfile& profile, const std::vector<double>& found,
                 omr::Ground ground = omr::Ground::white)
{
  omr::NarrowRings rings;
  if (!omr::readNarrowRings(profile, found, 1, ground, rings))
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

TEST(NarrowRings, palenessOfAllRingsIsHazeAndNoWhiteRingsBetweenThem)
{
  const std::vector<double> radii = {3.6, 7.2, 10.8, 14.4, 18, 21.6};
  EXPECT_EQ("RBGPGP", read(profileOf("RBGPGP", 3.6, .25), radii));
  EXPECT_EQ("GPG", read(profileOf("GPG", 3.6, .25), {3.6, 7.2, 10.8}));
  for (const std::string colors : {"RBGPGP", "PRGRGB", "GBGPWB"})
  {
    for (const double haze : {.2, .35, .5})
    {
      const std::string letters = read(profileOf(colors, 3.6, haze), radii);
      EXPECT_TRUE(letters == colors || letters == "not read") << letters << " instead of " << colors << ", " << haze;
    }
  }
}

TEST(NarrowRings, onDarkGroundARingIsWhite)
{
  for (const std::string colors : {"PRGPW", "GBRGW", "RWBRW"})
  {
    const omr::RingProfile profile = profileOf(colors, 3.5, 0, 0);
    const std::vector<double> radii = {3.5, 7, 10.5, 14, 17.5};
    EXPECT_EQ(colors, read(profile, radii, omr::Ground::any));
    EXPECT_EQ("not read", read(profile, radii, omr::Ground::white));
  }
  EXPECT_EQ("PRGPW", read(profileOf("PRGPW", 3.5, 0, 0), {3.5, 7, 14, 17.5}, omr::Ground::any));
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
