#include "checkerboards/grey_samples.h"

#include <gtest/gtest.h>

#include "checkerboards/corner_ring.h"
#include "checkerboards/local_frame.h"

namespace
{
constexpr std::size_t SIZE = 17;

cv::Mat noise()
{
  cv::Mat grey(31, 47, CV_8UC1);
  cv::RNG(3).fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey;
}
}  // namespace

TEST(GreySamples, areThoseOfOnePlaceAfterTheOther)
{
  const cv::Mat grey = noise();
  cv::RNG random(4);
  for (int round = 0; round < 100; ++round)
  {
    omr::SamplePlaces<SIZE> places;
    for (std::size_t i = 0; i < SIZE; ++i)
    {
      // Beyond the border as well.
      places.x[i] = random.uniform(-3.F, 50.F);
      places.y[i] = random.uniform(-3.F, 34.F);
    }
    std::array<float, SIZE> values;
    std::array<float, SIZE> logarithms;
    omr::sampleGreys(grey, places, values);
    omr::greyLogarithms(omr::greyLogarithmTable(), values, logarithms);
    for (std::size_t i = 0; i < SIZE; ++i)
    {
      EXPECT_EQ(omr::sampleGrey(grey, places.x[i], places.y[i]), values[i]);
      EXPECT_EQ(omr::greyLogarithm(values[i]), logarithms[i]);
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
