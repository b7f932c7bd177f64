#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare.h"
#include "device_fixture.h"
#include "edge_patterns.h"
#include "outdoor_omr/reference_fill.h"
#include "scene.h"

using omr::AreaWindow;
using omr::FillMethod;
using omr::Filter;
using omr::Geometry;
using omr::RegionSums;
using omr::test::equal;
using omr::test::noiseImage;

namespace
{
constexpr int SWEEP_ROUNDS = 100000;

void expectSameSums(const std::vector<RegionSums>& expected, const std::vector<RegionSums>& actual)
{
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const RegionSums& e = expected[i];
    const RegionSums& a = actual[i];
    const auto exact = [](const RegionSums& s) {
      return std::vector<std::uint64_t>{s.x,
                                        s.y,
                                        s.xx,
                                        s.xy,
                                        s.yy,
                                        s.blue,
                                        s.green,
                                        s.red,
                                        s.area,
                                        s.perimeter,
                                        static_cast<std::uint64_t>(s.label),
                                        static_cast<std::uint64_t>(s.min_x),
                                        static_cast<std::uint64_t>(s.min_y),
                                        static_cast<std::uint64_t>(s.max_x),
                                        static_cast<std::uint64_t>(s.max_y)};
    };
    ASSERT_EQ(exact(e), exact(a)) << "region " << i << " with label " << e.label;
    ASSERT_NEAR(static_cast<double>(e.distance), static_cast<double>(a.distance), 1e-3 * e.distance) << e.label;
  }
}

/** The steps on the device against the reference, with every region in the window. */
class DeviceFillTest : public omr::test::DeviceTest
{
 protected:
  /** Labels and sums of an edge mask, by both methods. */
  void checkEdges(const cv::Mat& edges)
  {
    const cv::Mat image = noiseImage(edges.size());
    const cv::Mat expected_labels = omr::labelRegions(edges);
    const std::vector<RegionSums> expected = omr::sumRegions(image, edges, expected_labels);
    for (const FillMethod method : {FillMethod::runs, FillMethod::sweep})
    {
      cv::Mat labels;
      cv::Mat edge_image;
      std::vector<RegionSums> sums;
      fill_->loadImage(image);
      fill_->loadEdges(edges);
      fill_->readEdges(edge_image);
      EXPECT_EQ(method, fill_->labelRegions(method, SWEEP_ROUNDS));
      fill_->readLabels(labels);
      fill_->sumRegions(AreaWindow());
      EXPECT_EQ(static_cast<int>(expected.size()), fill_->readSums(sums));
      fill_->finish();
      EXPECT_TRUE(equal(edges, edge_image));
      EXPECT_TRUE(equal(expected_labels, labels)) << "method " << static_cast<int>(method);
      expectSameSums(expected, sums);
    }
  }

  /** Everything of an image, by runs. */
  void checkImage(const cv::Mat& image, Filter filter, int size, const omr::EdgeThreshold& threshold)
  {
    const cv::Mat filtered = omr::filterImage(image, filter, size);
    const cv::Mat expected_edges = omr::edgeMask(filtered, threshold);
    const cv::Mat expected_labels = omr::labelRegions(expected_edges);
    const std::vector<RegionSums> expected = omr::sumRegions(filtered, expected_edges, expected_labels);
    cv::Mat edges;
    cv::Mat labels;
    std::vector<RegionSums> sums;
    fill_->loadImage(image);
    fill_->filter(filter, size);
    fill_->findEdges(threshold);
    fill_->readEdges(edges);
    fill_->labelRegions(FillMethod::runs, 0);
    fill_->readLabels(labels);
    fill_->sumRegions(AreaWindow());
    EXPECT_EQ(static_cast<int>(expected.size()), fill_->readSums(sums));
    fill_->finish();
    EXPECT_TRUE(equal(expected_edges, edges));
    EXPECT_TRUE(equal(expected_labels, labels));
    expectSameSums(expected, sums);
  }
};
}  // namespace

INSTANTIATE_TEST_SUITE_P(Geometries, DeviceFillTest, testing::Values(Geometry::strips, Geometry::words),
                         omr::test::geometryName);

TEST_P(DeviceFillTest, everyFilterOnAScene)
{
  const cv::Mat scene = omr::drawScene({640, 480});
  checkImage(scene, Filter::none, 3, {100});
  for (const int size : {3, 5})
  {
    checkImage(scene, Filter::gaussian, size, {100});
    checkImage(scene, Filter::median, size, {60});
  }
}

TEST_P(DeviceFillTest, everyFilterOnOddSizes)
{
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(2, 1), cv::Size(1, 2), cv::Size(131, 1), cv::Size(1, 97),
                               cv::Size(3, 5), cv::Size(15, 33), cv::Size(17, 16), cv::Size(63, 31), cv::Size(64, 64),
                               cv::Size(65, 17), cv::Size(127, 101), cv::Size(513, 3), cv::Size(1031, 37)})
  {
    SCOPED_TRACE(testing::Message() << size.width << " x " << size.height);
    const cv::Mat image = noiseImage(size);
    checkImage(image, Filter::none, 3, {700});
    checkImage(image, Filter::gaussian, 3, {200});
    checkImage(image, Filter::gaussian, 5, {100});
    checkImage(image, Filter::median, 3, {250});
    checkImage(image, Filter::median, 5, {120});
  }
}

TEST_P(DeviceFillTest, extremeThresholds)
{
  const cv::Mat image = noiseImage({150, 70});
  checkImage(image, Filter::none, 3, {1});
  checkImage(image, Filter::none, 3, {2039});
  checkImage(image, Filter::none, 3, {2040});
}

TEST_P(DeviceFillTest, adaptiveThreshold)
{
  for (const cv::Size& size : {cv::Size(640, 480), cv::Size(65, 17), cv::Size(63, 33), cv::Size(1, 1)})
  {
    cv::Mat scene;
    cv::resize(omr::drawScene({640, 480}), scene, size);
    scene.colRange(size.width / 2, size.width) *= .15;  // deep shadow on the right
    checkImage(scene, Filter::none, 3, {100, 20});
    checkImage(scene, Filter::gaussian, 3, {2040, 1});
    checkImage(noiseImage(size) / 16, Filter::none, 3, {60, 10});
  }
}

TEST_P(DeviceFillTest, regionOfInterestEndsAtItsBorder)
{
  const cv::Mat scene = omr::drawScene({640, 480});
  const cv::Mat part = scene(cv::Rect(33, 21, 401, 253));
  ASSERT_FALSE(part.isContinuous());
  for (const Filter filter : {Filter::none, Filter::gaussian, Filter::median})
  {
    checkImage(part, filter, 5, {80});
  }
}

TEST_P(DeviceFillTest, readsNothingOutsideTheImage)
{
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const cv::Size size(131, 41);
  const std::size_t bytes = static_cast<std::size_t>(size.area()) * 3;
  const std::size_t pages = (bytes + page - 1) / page;
  void* memory = mmap(nullptr, (pages + 2) * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(MAP_FAILED, memory);
  auto* first = static_cast<uchar*>(memory) + page;
  ASSERT_EQ(0, mprotect(memory, page, PROT_NONE));
  ASSERT_EQ(0, mprotect(first + pages * page, page, PROT_NONE));
  for (uchar* data : {first, first + pages * page - bytes})
  {
    cv::Mat image(size, CV_8UC3, data);
    noiseImage(size).copyTo(image);
    checkImage(image, Filter::none, 3, {400});
    for (const int window : {3, 5})
    {
      checkImage(image, Filter::gaussian, window, {100});
      checkImage(image, Filter::median, window, {100});
    }
  }
  munmap(memory, (pages + 2) * page);
}

TEST_P(DeviceFillTest, edgePatterns)
{
  for (const auto& pattern : omr::edgePatterns({190, 130}))
  {
    SCOPED_TRACE(pattern.name);
    checkEdges(pattern.edges);
  }
}

TEST_P(DeviceFillTest, edgePatternsOfChangingSize)
{
  for (const cv::Size& size : {cv::Size(67, 41), cv::Size(1, 1), cv::Size(64, 70), cv::Size(200, 1), cv::Size(1, 200),
                               cv::Size(128, 16), cv::Size(129, 33), cv::Size(191, 65)})
  {
    for (const auto& pattern : omr::edgePatterns(size))
    {
      SCOPED_TRACE(testing::Message() << pattern.name << " " << size.width << " x " << size.height);
      checkEdges(pattern.edges);
    }
  }
}

TEST_P(DeviceFillTest, runsAndChannelSumsOfAVeryWideImage)
{
  const cv::Mat white(3, 65535, CV_8UC3, cv::Scalar(255, 254, 253));
  checkImage(white, Filter::none, 3, {100});
}

TEST_P(DeviceFillTest, withoutMeasuresPlaceAndShapeAreTheSame)
{
  const cv::Mat image = omr::drawScene({640, 480});
  const cv::Mat edges = omr::edgeMask(image, {100});
  std::vector<RegionSums> expected = omr::sumRegions(image, edges, omr::labelRegions(edges));
  for (RegionSums& region : expected)
  {
    region.blue = region.green = region.red = region.distance = region.perimeter = 0;
  }
  std::vector<RegionSums> sums;
  fill_->loadImage(image);
  fill_->findEdges({100});
  fill_->labelRegions(FillMethod::runs, 0);
  fill_->sumRegions(AreaWindow(), false);
  fill_->readSums(sums);
  fill_->finish();
  expectSameSums(expected, sums);
}

TEST_P(DeviceFillTest, moreRegionsThanTheBuffersHold)
{
  cv::Mat edges(1000, 1000, CV_8UC1);
  for (int y = 0; y < edges.rows; ++y)
  {
    for (int x = 0; x < edges.cols; ++x)
    {
      edges.at<uchar>(y, x) = (x + y) % 2 ? 255 : 0;
    }
  }
  checkEdges(edges);
  checkImage(omr::drawScene({320, 200}), Filter::gaussian, 3, {100});
}

TEST_P(DeviceFillTest, sweepThatDoesNotSettleLeavesTheLabelsToTheRuns)
{
  const cv::Mat edges = omr::serpentine({100, 60});
  cv::Mat labels;
  fill_->loadImage(noiseImage(edges.size()));
  fill_->loadEdges(edges);
  EXPECT_EQ(FillMethod::runs, fill_->labelRegions(FillMethod::sweep, 3));
  fill_->readLabels(labels);
  fill_->finish();
  EXPECT_TRUE(equal(omr::labelRegions(edges), labels));
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
