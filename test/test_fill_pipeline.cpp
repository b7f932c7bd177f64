#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <opencv2/core.hpp>

#include "compare.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/reference_fill.h"
#include "scene.h"

using omr::DeviceError;
using omr::FillMethod;
using omr::FillPipeline;
using omr::RegionMap;
using omr::Settings;
using omr::test::equal;
using omr::test::noiseImage;

namespace
{
std::string messageOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const DeviceError& error)
  {
    return error.what();
  }
  return "";
}

/** FillPipeline with every region reported. */
Settings allRegions()
{
  Settings settings;
  settings.region_min_area = 1;
  settings.region_max_share = 1;
  return settings;
}
}  // namespace

TEST(FillPipeline, agreesWithTheReference)
{
  const cv::Mat scene = omr::drawScene({641, 479});
  FillPipeline device("auto");
  FillPipeline reference("reference");
  for (const FillMethod method : {FillMethod::runs, FillMethod::sweep})
  {
    Settings settings = method == FillMethod::runs ? Settings() : allRegions();
    settings.fill_method = method;
    RegionMap expected;
    RegionMap actual;
    FillPipeline::Outputs both;
    both.edges = both.labels = true;
    reference.run(scene, settings, both, expected);
    device.run(scene, settings, both, actual);
    EXPECT_EQ(expected.size, actual.size);
    EXPECT_EQ(expected.region_count, actual.region_count);
    EXPECT_TRUE(equal(expected.edges, actual.edges));
    EXPECT_TRUE(equal(expected.labels, actual.labels));
    ASSERT_EQ(expected.regions.size(), actual.regions.size());
    ASSERT_GT(expected.regions.size(), 100U);
    for (std::size_t i = 0; i < expected.regions.size(); ++i)
    {
      EXPECT_EQ(expected.regions[i].label, actual.regions[i].label);
      EXPECT_EQ(expected.regions[i].area, actual.regions[i].area);
      EXPECT_EQ(expected.regions[i].color, actual.regions[i].color);
      EXPECT_EQ(expected.regions[i].center, actual.regions[i].center);
      EXPECT_NEAR(expected.regions[i].mean_distance, actual.regions[i].mean_distance,
                  1e-3 * expected.regions[i].mean_distance);
    }
  }
}

TEST(FillPipeline, reportsOnlyTheAreasAskedFor)
{
  const cv::Mat scene = omr::drawScene({640, 480});
  Settings settings;
  settings.region_min_area = 50;
  settings.region_max_share = 0.01;
  for (const char* device : {"auto", "reference"})
  {
    FillPipeline pipeline(device);
    RegionMap map;
    pipeline.run(scene, settings, FillPipeline::Outputs(), map);
    EXPECT_TRUE(map.edges.empty());
    EXPECT_TRUE(map.labels.empty());
    EXPECT_FALSE(map.regions.empty());
    EXPECT_GT(map.region_count, static_cast<int>(map.regions.size()));
    int previous = -1;
    for (const omr::Region& region : map.regions)
    {
      EXPECT_GE(region.area, 50);
      EXPECT_LE(region.area, 3072);
      EXPECT_LT(previous, region.label);
      previous = region.label;
    }
  }
}

TEST(FillPipeline, keepsOutputsThatAPreviousImageLeftInAnotherShape)
{
  FillPipeline pipeline;
  FillPipeline::Outputs both;
  both.edges = both.labels = true;
  RegionMap map;
  cv::Mat larger(300, 300, CV_32SC1, cv::Scalar(7));
  map.labels = larger(cv::Rect(5, 5, 90, 70));  // right size, but rows apart
  const cv::Mat image = noiseImage({90, 70});
  pipeline.run(image, Settings(), both, map);
  const cv::Mat filtered = omr::filterImage(image, Settings().filter, Settings().filter_size);
  EXPECT_TRUE(equal(omr::labelRegions(omr::edgeMask(filtered, omr::edgeThreshold(Settings()))), map.labels));
  EXPECT_EQ(0, cv::norm(larger, cv::Mat(300, 300, CV_32SC1, cv::Scalar(7)), cv::NORM_INF));
}

TEST(FillPipeline, stepTimesAddUpToThePositiveWhole)
{
  for (const char* device : {"auto", "reference"})
  {
    FillPipeline pipeline(device);
    RegionMap map;
    std::vector<omr::StepTime> times;
    pipeline.run(omr::drawScene({640, 480}), Settings(), FillPipeline::Outputs(), map, &times);
    ASSERT_EQ(4U, times.size());
    EXPECT_EQ("filter", times[0].step);
    EXPECT_EQ("edges", times[1].step);
    EXPECT_EQ("labels", times[2].step);
    EXPECT_EQ("region data", times[3].step);
    for (const omr::StepTime& time : times)
    {
      EXPECT_GT(time.milliseconds, 0) << time.step;
    }
  }
}

TEST(FillPipeline, refusesWrongInput)
{
  for (const char* device : {"auto", "reference"})
  {
    FillPipeline pipeline(device);
    RegionMap map;
    const FillPipeline::Outputs none;
    const cv::Mat good(4, 4, CV_8UC3, cv::Scalar::all(9));
    EXPECT_THROW(pipeline.run(cv::Mat(), Settings(), none, map), std::invalid_argument);
    EXPECT_THROW(pipeline.run(cv::Mat(4, 4, CV_8UC1), Settings(), none, map), std::invalid_argument);
    EXPECT_THROW(pipeline.run(cv::Mat(4, 4, CV_16UC3), Settings(), none, map), std::invalid_argument);
    EXPECT_THROW(pipeline.run(cv::Mat(1, 65536, CV_8UC3), Settings(), none, map), std::invalid_argument);
    Settings wrong;
    wrong.filter_size = 4;
    EXPECT_THROW(pipeline.run(good, wrong, none, map), std::invalid_argument);
    EXPECT_NO_THROW(pipeline.run(good, Settings(), none, map));
    EXPECT_EQ(1, map.region_count);
  }
}

TEST(FillPipeline, saysWhichDevicesArePresentWhenTheOneAskedForIsNot)
{
  for (const char* name : {"Voodoo Graphics", ""})
  {
    const std::string message = messageOf([&] { FillPipeline pipeline(name); });
    EXPECT_NE(std::string::npos, message.find("no OpenCL device fits '" + std::string(name) + "'; present: "));
    for (const std::string& device : FillPipeline::devices())
    {
      EXPECT_NE(std::string::npos, message.find(device)) << message;
    }
  }
}

TEST(FillPipeline, findsADeviceByAPartOfItsName)
{
  const std::vector<std::string> devices = FillPipeline::devices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: scripts/setup installs pocl-opencl-icd, which is one";
  std::string part = devices.front().substr(devices.front().find(": ") + 2, 8);
  std::transform(part.begin(), part.end(), part.begin(), [](unsigned char c) { return std::toupper(c); });
  EXPECT_EQ(devices.front(), FillPipeline(part).device().name);
}

TEST(FillPipeline, networksThatAreIncompleteAreRefused)
{
  FillPipeline pipeline;
  RegionMap map;
  std::vector<omr::MarkerScores> scores;
  const auto refusal = [&](const omr::MarkerNetwork& network, std::vector<omr::MarkerScores>* receiver) {
    FillPipeline::Outputs outputs;
    outputs.network = &network;
    outputs.window_scores = receiver;
    try
    {
      pipeline.run(omr::drawScene({320, 240}), Settings(), outputs, map);
    }
    catch (const std::invalid_argument& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const omr::MarkerNetwork& whole = omr::defaultMarkerNetwork();
  EXPECT_EQ("", refusal(whole, &scores));
  EXPECT_EQ("a network is given, but no window_scores that receive what it finds", refusal(whole, nullptr));
  EXPECT_EQ("a network of candidates has 1 to 256 hidden units and all their weights; this one has 0 and 0 weights",
            refusal(omr::MarkerNetwork(), &scores));
  omr::MarkerNetwork large = whole;
  large.hidden = 300;
  EXPECT_NE("", refusal(large, &scores));
  omr::MarkerNetwork truncated = whole;
  truncated.weights.pop_back();
  EXPECT_NE("", refusal(truncated, &scores));
  omr::MarkerNetwork wide_gate = whole;
  wide_gate.gate.hidden = 20;
  EXPECT_EQ(
      "the gate of a network of candidates has up to 16 hidden units and all their weights; this one has 20 and " +
          std::to_string(whole.gate.weights.size()) + " weights",
      refusal(wide_gate, &scores));
}

TEST(FillPipeline, theReferenceNeedsNoDevice)
{
  const FillPipeline pipeline("reference");
  EXPECT_EQ("reference (no OpenCL)", pipeline.device().name);
  EXPECT_EQ("", pipeline.device().fallback_reason);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
