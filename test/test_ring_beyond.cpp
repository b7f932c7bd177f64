#include "targets/boundaries/ring_beyond.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace
{
const cv::Point CENTER(60, 60);
const cv::Scalar PAPER = cv::Scalar::all(200);
const cv::Scalar PLATE = cv::Scalar::all(120);
const std::vector<double> RADII = {10, 20, 30};

/** Plate of which a part is as bright as paper. */
cv::Mat3b ground(const cv::Rect& bright)
{
  cv::Mat3b image(120, 120);
  image.setTo(PLATE);
  cv::rectangle(image, bright, PAPER, cv::FILLED);
  return image;
}

void drawDisk(cv::Mat3b& image, int radius, const cv::Scalar& color)
{
  cv::circle(image, CENTER, radius, color, cv::FILLED, cv::LINE_AA);
}

/** Whether three rings that were found have an arc beyond. */
bool isArcBeyond(cv::Mat3b image, int scale = 1)
{
  drawDisk(image, 30, {40, 40, 40});
  drawDisk(image, 20, {60, 60, 200});
  drawDisk(image, 10, {220, 220, 220});
  cv::GaussianBlur(image, image, cv::Size(), .7);
  omr::RingFamily family;
  family.center = CENTER;
  omr::RingProfile profile;
  omr::sampleProfile(image, family, 57, profile);
  return omr::showsArcBeyond(profile, RADII, scale);
}
}  // namespace

TEST(RingBeyond, aFurtherRingShowsWhereTheGroundDiffers)
{
  cv::Mat3b image = ground({50, 0, 70, 120});
  EXPECT_FALSE(isArcBeyond(image)) << "the straight edge alone is no ring's";
  drawDisk(image, 40, PAPER);
  EXPECT_TRUE(isArcBeyond(image)) << "it ends on a circle in four of ten directions";
}

TEST(RingBeyond, aSquareSheetIsNoRing)
{
  for (int half_side = 33; half_side < 48; ++half_side)
  {
    const cv::Point corner(half_side, half_side);
    EXPECT_FALSE(isArcBeyond(ground({CENTER - corner, CENTER + corner + cv::Point(1, 1)}))) << half_side;
  }
}

TEST(RingBeyond, anEvenGroundHasNone)
{
  EXPECT_FALSE(isArcBeyond(ground({0, 0, 120, 120})));
  EXPECT_FALSE(isArcBeyond(ground({})));
}

TEST(RingBeyond, aHaloIsNoRing)
{
  cv::Mat3b image = ground({});
  drawDisk(image, 34, PAPER);
  EXPECT_FALSE(isArcBeyond(image)) << "far narrower than the rings";
  EXPECT_FALSE(isArcBeyond(image, 2));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
