// A device that fails on an image. What makes it fail is an image whose rows lie so far apart that no device takes a
// buffer from the first to the last, while only the rows are ever touched; plain C++ reads them where they are.

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <opencv2/core.hpp>

#include "outdoor_omr/fill_pipeline.h"

using omr::DeviceError;
using omr::DeviceState;
using omr::FillPipeline;
using omr::RegionMap;
using omr::Settings;

namespace
{
constexpr std::size_t STEP = std::size_t(1) << 34;  // bytes from row to row
const cv::Size SIZE(64, 32);

/** Two squares, in rows that no device takes. */
class WideImage
{
 public:
  WideImage()
  {
    memory_ =
        mmap(nullptr, STEP * SIZE.height, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory_ != MAP_FAILED)
    {
      image_ = cv::Mat(SIZE, CV_8UC3, memory_, STEP);
      usualImage().copyTo(image_);
    }
  }

  ~WideImage()
  {
    munmap(memory_, STEP * SIZE.height);
  }

  const cv::Mat& operator*() const
  {
    return image_;
  }

  static cv::Mat usualImage()
  {
    cv::Mat image(SIZE, CV_8UC3, cv::Scalar::all(30));
    image(cv::Rect(8, 8, 16, 16)).setTo(cv::Scalar::all(220));
    image(cv::Rect(40, 8, 16, 16)).setTo(cv::Scalar::all(220));
    return image;
  }

 private:
  void* memory_;
  cv::Mat image_;
};
}  // namespace

TEST(DeviceFailure, autoGoesOnWithoutTheDeviceAndSaysWhy)
{
  const WideImage wide;
  ASSERT_FALSE((*wide).empty());
  FillPipeline pipeline("auto");
  const std::string name = pipeline.device().name;
  ASSERT_NE("reference (no OpenCL)", name);
  RegionMap map;
  pipeline.run(*wide, Settings(), FillPipeline::Outputs(), map);
  EXPECT_EQ(SIZE, map.size);
  EXPECT_EQ(3, map.region_count);
  const DeviceState& device = pipeline.device();
  EXPECT_EQ("reference (no OpenCL)", device.name);
  EXPECT_GE(device.failures, 2) << "it is opened anew once";
  EXPECT_NE(std::string::npos, device.last_failure.find("failed on ")) << device.last_failure;
  EXPECT_NE(std::string::npos, device.fallback_reason.find("failed on " + name)) << device.fallback_reason;
  pipeline.run(WideImage::usualImage(), Settings(), FillPipeline::Outputs(), map);
  EXPECT_EQ(3, map.region_count);
}

TEST(DeviceFailure, aDeviceAskedForIsAnErrorAndWorksOnTheNextImage)
{
  const WideImage wide;
  ASSERT_FALSE((*wide).empty());
  const std::string name = FillPipeline::devices().front();
  FillPipeline pipeline(name);
  RegionMap map;
  pipeline.run(WideImage::usualImage(), Settings(), FillPipeline::Outputs(), map);
  ASSERT_EQ(3, map.region_count);
  for (int attempt = 0; attempt < 2; ++attempt)
  {
    try
    {
      pipeline.run(*wide, Settings(), FillPipeline::Outputs(), map);
      FAIL();
    }
    catch (const DeviceError& error)
    {
      EXPECT_NE(std::string::npos, std::string(error.what()).find("failed on " + name)) << error.what();
    }
    EXPECT_EQ(cv::Size(), map.size);
    EXPECT_TRUE(map.regions.empty());
    EXPECT_EQ(0, map.region_count);
  }
  pipeline.run(WideImage::usualImage(), Settings(), FillPipeline::Outputs(), map);
  EXPECT_EQ(3, map.region_count);
  EXPECT_EQ(name, pipeline.device().name);
  EXPECT_EQ("", pipeline.device().fallback_reason);
  EXPECT_EQ(4, pipeline.device().failures);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
