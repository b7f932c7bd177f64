// A machine without OpenCL: the loader of this process is told to look for drivers where there are none.

#include <gtest/gtest.h>

#include <cstdlib>

#include "outdoor_omr/fill_pipeline.h"

using omr::DeviceError;
using omr::FillPipeline;

TEST(WithoutOpenCL, autoFallsBackToTheReferenceAndSaysWhy)
{
  FillPipeline pipeline("auto");
  EXPECT_EQ("reference (no OpenCL)", pipeline.device().name);
  EXPECT_EQ("no OpenCL device is present", pipeline.device().fallback_reason);
  EXPECT_TRUE(FillPipeline::devices().empty());
  omr::RegionMap map;
  pipeline.run(cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(80)), omr::Settings(), FillPipeline::Outputs(), map);
  EXPECT_EQ(1, map.region_count);
}

TEST(WithoutOpenCL, aDeviceAskedForIsAnErrorThatSaysSo)
{
  for (const std::string name : {"gpu", "cpu", "pthread"})
  {
    try
    {
      FillPipeline pipeline(name);
      FAIL() << name;
    }
    catch (const DeviceError& error)
    {
      EXPECT_EQ("no OpenCL device fits '" + name + "'; present: none", std::string(error.what()));
    }
  }
}

int main(int argc, char** argv)
{
  setenv("OCL_ICD_VENDORS", "/nonexistent", 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
