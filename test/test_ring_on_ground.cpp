#include "targets/boundaries/ring_on_ground.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace
{
const cv::Point CENTER(60, 60);
const std::vector<double> RADII = {10, 20, 30};
constexpr double GROUND = 60;
constexpr double CONTRAST = .3;  // of the outermost boundary

void drawDisk(cv::Mat3b& image, int radius, const cv::Scalar& color)
{
  cv::circle(image, CENTER, radius, color, cv::FILLED, cv::LINE_AA);
}

/** Whether there seems to be a ring more than the three that are drawn on the image. */
bool isRingBeyond(cv::Mat3b image)
{
  drawDisk(image, 30, {60, 60, 180});
  drawDisk(image, 20, {220, 220, 220});
  drawDisk(image, 10, {40, 130, 60});
  cv::Mat noise(image.size(), CV_8UC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::NORMAL, cv::Scalar::all(10), cv::Scalar::all(2));
  cv::add(image, noise, image);
  cv::GaussianBlur(image, image, cv::Size(), .7);
  omr::RingFamily family;
  family.center = CENTER;
  omr::RingProfile profile;
  omr::sampleProfile(image, family, 57, profile);
  return omr::resemblesGround(profile, RADII, CONTRAST, 1);
}

cv::Mat3b ground(double level)
{
  cv::Mat3b image(120, 120);
  image.setTo(cv::Scalar::all(level));
  return image;
}
}  // namespace

TEST(RingOnGround, aRingIsSeenThatIsNearlyAsDarkAsTheGround)
{
  EXPECT_FALSE(isRingBeyond(ground(GROUND)));
  for (const int radius : {38, 40, 44})
  {
    cv::Mat3b image = ground(GROUND);
    drawDisk(image, radius, cv::Scalar::all(GROUND - 8));
    EXPECT_TRUE(isRingBeyond(image)) << radius;
  }
}

TEST(RingOnGround, aRingIsSeenInPart)
{
  cv::Mat3b image = ground(GROUND);
  drawDisk(image, 40, cv::Scalar::all(GROUND - 8));
  cv::rectangle(image, {0, 0, 50, 120}, cv::Scalar::all(GROUND - 8), cv::FILLED);
  EXPECT_TRUE(isRingBeyond(image)) << "it differs from the ground in two thirds of the directions";
}

TEST(RingOnGround, aSquareSheetIsNoRing)
{
  for (int half_side = 34; half_side < 48; ++half_side)
  {
    cv::Mat3b image = ground(GROUND);
    const cv::Point corner(half_side, half_side);
    image({CENTER - corner, CENTER + corner + cv::Point(1, 1)}).setTo(cv::Scalar::all(GROUND + 30));
    EXPECT_FALSE(isRingBeyond(image)) << half_side;
  }
}

TEST(RingOnGround, whatIsAsBrightAsTheRingsIsASheet)
{
  cv::Mat3b image = ground(GROUND);
  drawDisk(image, 40, cv::Scalar::all(220));
  EXPECT_FALSE(isRingBeyond(image));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
