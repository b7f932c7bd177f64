#include "checkerboards/corners/grey_samples.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "checkerboards/corners/corner_ring.h"
#include "checkerboards/corners/local_frame.h"

namespace
{
constexpr std::size_t SIZE = 17;

cv::Mat noise()
{
  cv::Mat grey(31, 47, CV_8UC1);
  cv::RNG(3).fill(grey, cv::RNG::UNIFORM, 0, 256);
  return grey;
}

/** An image whose last byte is the last that may be read. */
class GuardedImage
{
 public:
  explicit GuardedImage(const cv::Size& size)
  {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const auto bytes = static_cast<std::size_t>(size.area());
    const std::size_t used = (bytes + page - 1) / page * page;
    size_ = used + page;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ != MAP_FAILED && mprotect(static_cast<uchar*>(memory_) + used, page, PROT_NONE) == 0)
    {
      grey = cv::Mat(size, CV_8UC1, static_cast<uchar*>(memory_) + used - bytes);
    }
  }
  ~GuardedImage()
  {
    munmap(memory_, size_);
  }
  GuardedImage(const GuardedImage&) = delete;
  GuardedImage& operator=(const GuardedImage&) = delete;

  cv::Mat grey;

 private:
  void* memory_;
  std::size_t size_;
};
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

TEST(GreySamples, nothingBeyondALargeImageIsRead)
{
  for (const cv::Size& size : {cv::Size(40000, 2), cv::Size(2, 40000), cv::Size(65535, 2), cv::Size(2, 65535)})
  {
    GuardedImage image(size);
    ASSERT_EQ(size, image.grey.size());
    image.grey = cv::Scalar::all(10);
    image.grey.at<uchar>(size.height - 1, size.width - 1) = 90;
    omr::SamplePlaces<SIZE> places;
    places.x.fill(70000);
    places.y.fill(70000);
    std::array<float, SIZE> values;
    omr::sampleGreys(image.grey, places, values);
    EXPECT_NEAR(90, values.front(), 1) << size;
    EXPECT_NEAR(90, omr::sampleGrey(image.grey, 70000, 70000), 1) << size;
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
