#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <opencv2/core.hpp>

#include "outdoor_omr/fill_pipeline.h"
#include "scene.h"

namespace
{
std::atomic<std::size_t> allocated{0};  // bytes ever taken by operator new, in this and all libraries
}

void* operator new(std::size_t size)
{
  allocated += size;
  void* memory = std::malloc(size);
  if (memory == nullptr)
  {
    throw std::bad_alloc();
  }
  return memory;
}

// Not inlined: GCC would see a free() of what it believes to come from its own operator new.
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept
{
  std::free(memory);
}

using omr::FillPipeline;
using omr::RegionMap;
using omr::Settings;

namespace
{
/** Every pixel of a region a region of its own, reported: the largest number of records. */
cv::Mat worstImage(const cv::Size& size)
{
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      // Blocks of 1 px behind edges of 2 px: a Sobel edge is at least that wide.
      const bool bright = (x / 3 + y / 3) % 2 != 0;
      image.at<cv::Vec3b>(y, x) = bright ? cv::Vec3b(255, 255, 255) : cv::Vec3b(0, 0, 0);
    }
  }
  return image;
}

Settings allRegions()
{
  Settings settings;
  settings.filter = omr::Filter::none;
  settings.region_min_area = 1;
  settings.region_max_share = 1;
  return settings;
}
}  // namespace

TEST(FillMemory, anImageLikeTheLastAllocatesNextToNothing)
{
  const cv::Mat scene = omr::drawScene({1280, 720});
  FillPipeline pipeline;
  RegionMap map;
  const FillPipeline::Outputs none;
  pipeline.run(scene, Settings(), none, map);
  pipeline.run(scene, Settings(), none, map);
  const std::size_t bytes = pipeline.bufferBytes();
  const std::size_t before = allocated;
  pipeline.run(scene, Settings(), none, map);
  EXPECT_LT(allocated - before, 4096U);  // the check of the settings takes 1 kB, regions and buffers none
  EXPECT_EQ(bytes, pipeline.bufferBytes());
}

TEST(FillMemory, theBuffersFollowTheFormula)
{
  for (const cv::Size& size : {cv::Size(640, 480), cv::Size(1920, 1080), cv::Size(3840, 2160)})
  {
    FillPipeline pipeline;
    RegionMap map;
    pipeline.run(omr::drawScene(size), Settings(), FillPipeline::Outputs(), map);
    const double formula = 13.2 * size.area() + 10e6;  // docs/performance.md
    const auto bytes = static_cast<double>(pipeline.bufferBytes());
    EXPECT_LT(bytes, formula) << size;
    EXPECT_GT(bytes, 0.9 * formula - 1e6) << size << ": the formula says too much";
  }
}

TEST(FillMemory, growthIsBoundedAndGivenBack)
{
  const cv::Size size(1920, 1080);
  const cv::Mat scene = omr::drawScene(size);
  const cv::Mat worst = worstImage(size);
  FillPipeline pipeline;
  RegionMap map;
  const FillPipeline::Outputs none;
  pipeline.run(scene, Settings(), none, map);
  const std::size_t usual = pipeline.bufferBytes();
  pipeline.run(worst, allRegions(), none, map);
  const std::size_t most = pipeline.bufferBytes();
  ASSERT_GT(most, usual + 5000000) << "the worst image is not bad: " << map.region_count << " regions";
  // One pixel of nine is a region: a record, once more when it is reported, a quarter of margin.
  EXPECT_LT(most, usual + static_cast<std::size_t>(size.area()) / 9 * 2 * 104 * 5 / 4 * 11 / 10);
  for (int image = 0; image < 105; ++image)
  {
    pipeline.run(scene, Settings(), none, map);
  }
  EXPECT_EQ(usual, pipeline.bufferBytes());
  EXPECT_LT(map.regions.capacity(), 20000U);
}

TEST(FillMemory, whatOnlySomeImagesNeedIsGivenBack)
{
  const cv::Mat scene = omr::drawScene({320, 240});
  FillPipeline pipeline;
  RegionMap map;
  const FillPipeline::Outputs none;
  pipeline.run(scene, Settings(), none, map);
  const std::size_t usual = pipeline.bufferBytes();
  Settings sweep;
  sweep.fill_method = omr::FillMethod::sweep;
  pipeline.run(scene, sweep, none, map);
  EXPECT_EQ(usual + scene.total() * sizeof(int), pipeline.bufferBytes());
  for (int image = 0; image < 105; ++image)
  {
    pipeline.run(scene, Settings(), none, map);
  }
  EXPECT_EQ(usual, pipeline.bufferBytes());
}

TEST(FillMemory, manyEnlargementsOfAnImageLeaveItsBuffers)
{
  FillPipeline pipeline;
  RegionMap map;
  FillPipeline::Outputs outputs;
  pipeline.run(omr::drawScene({1280, 720}), Settings(), outputs, map);
  const std::size_t usual = pipeline.bufferBytes();
  outputs.is_enlargement = true;
  const cv::Mat enlargement = omr::drawScene({160, 120});
  for (int look = 0; look < 105; ++look)
  {
    pipeline.run(enlargement, Settings(), outputs, map);
  }
  EXPECT_EQ(usual, pipeline.bufferBytes());
  outputs.is_enlargement = false;
  for (int image = 0; image < 105; ++image)
  {
    pipeline.run(enlargement, Settings(), outputs, map);
  }
  EXPECT_LT(pipeline.bufferBytes(), usual);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
