#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "edge_patterns.h"
#include "outdoor_omr/reference_fill.h"

using omr::Filter;
using omr::RegionSums;

namespace
{
cv::Mat noiseImage(const cv::Size& size)
{
  cv::Mat image(size, CV_8UC3);
  cv::RNG random(5);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

/** A channel of the pixel, the nearest one beyond the border. */
int pixel(const cv::Mat& image, int y, int x, int channel)
{
  return image.at<cv::Vec3b>(std::clamp(y, 0, image.rows - 1), std::clamp(x, 0, image.cols - 1))[channel];
}

/** Median of the window by sorting. */
int medianAt(const cv::Mat& image, int y, int x, int channel, int radius)
{
  std::vector<int> values;
  for (int dy = -radius; dy <= radius; ++dy)
  {
    for (int dx = -radius; dx <= radius; ++dx)
    {
      values.push_back(pixel(image, y + dy, x + dx, channel));
    }
  }
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/** Binomial sum of the window, rounded. */
int gaussianAt(const cv::Mat& image, int y, int x, int channel, int radius)
{
  const std::vector<int> weights = radius == 1 ? std::vector<int>{1, 2, 1} : std::vector<int>{1, 4, 6, 4, 1};
  int sum = 0;
  int total = 0;
  for (int dy = -radius; dy <= radius; ++dy)
  {
    for (int dx = -radius; dx <= radius; ++dx)
    {
      const int weight = weights[dy + radius] * weights[dx + radius];
      sum += weight * pixel(image, y + dy, x + dx, channel);
      total += weight;
    }
  }
  return (sum + total / 2) / total;
}

int sobelAt(const cv::Mat& image, int y, int x, int channel)
{
  const auto p = [&](int dy, int dx) { return pixel(image, y + dy, x + dx, channel); };
  const int gx = p(-1, 1) + 2 * p(0, 1) + p(1, 1) - p(-1, -1) - 2 * p(0, -1) - p(1, -1);
  const int gy = p(1, -1) + 2 * p(1, 0) + p(1, 1) - p(-1, -1) - 2 * p(-1, 0) - p(-1, 1);
  return std::abs(gx) + std::abs(gy);
}
}  // namespace

TEST(ReferenceFill, filtersAgreeWithBruteForce)
{
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(7, 1), cv::Size(1, 6), cv::Size(2, 3), cv::Size(23, 17)})
  {
    const cv::Mat image = noiseImage(size);
    for (const int radius : {1, 2})
    {
      const cv::Mat gaussian = omr::filterImage(image, Filter::gaussian, 2 * radius + 1);
      const cv::Mat median = omr::filterImage(image, Filter::median, 2 * radius + 1);
      for (int y = 0; y < size.height; ++y)
      {
        for (int x = 0; x < size.width; ++x)
        {
          for (int c = 0; c < 3; ++c)
          {
            ASSERT_EQ(gaussianAt(image, y, x, c, radius), gaussian.at<cv::Vec3b>(y, x)[c]) << size << radius;
            ASSERT_EQ(medianAt(image, y, x, c, radius), median.at<cv::Vec3b>(y, x)[c]) << size << radius;
          }
        }
      }
    }
  }
}

TEST(ReferenceFill, edgesAgreeWithBruteForceAlsoInARegionOfInterest)
{
  const cv::Mat whole = noiseImage({40, 30});
  const cv::Mat image = whole(cv::Rect(5, 7, 21, 13));
  const cv::Mat edges = omr::edgeMask(image, {600});
  for (int y = 0; y < image.rows; ++y)
  {
    for (int x = 0; x < image.cols; ++x)
    {
      int strongest = 0;
      for (int c = 0; c < 3; ++c)
      {
        strongest = std::max(strongest, sobelAt(image, y, x, c));
      }
      ASSERT_EQ(strongest > 600 ? 255 : 0, edges.at<uchar>(y, x));
    }
  }
}

TEST(ReferenceFill, adaptiveThresholdIsLowerWhereAllIsFaint)
{
  // Steps of 100 grey levels on the left, of 10 far right: responses of 400 and 40.
  cv::Mat image(64, 640, CV_8UC3, cv::Scalar::all(20));
  image.colRange(10, 20) = cv::Scalar::all(120);
  image.colRange(30, 40) = cv::Scalar::all(30);
  image.colRange(600, 610) = cv::Scalar::all(30);
  const auto edges_at = [&](const omr::EdgeThreshold& threshold, int x) {
    return static_cast<int>(omr::edgeMask(image, threshold).at<uchar>(32, x));
  };
  EXPECT_EQ(255, edges_at({100}, 10));
  EXPECT_EQ(0, edges_at({100}, 600));
  EXPECT_EQ(255, edges_at({100, 20}, 10));
  EXPECT_EQ(0, edges_at({100, 20}, 30)) << "beside a strong edge";
  EXPECT_EQ(255, edges_at({100, 20}, 600));
  EXPECT_EQ(0, edges_at({100, 40}, 600)) << "at the floor";
  EXPECT_EQ(255, edges_at({100, 39}, 600));
}

TEST(ReferenceFill, labelsAreTheComponentsOfOpenCVNamedByTheirFirstPixel)
{
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(9, 1), cv::Size(64, 33), cv::Size(101, 67)})
  {
    for (const auto& pattern : omr::edgePatterns(size))
    {
      const cv::Mat labels = omr::labelRegions(pattern.edges);
      cv::Mat components;
      cv::connectedComponents(pattern.edges == 0, components, 4, CV_32S);
      std::map<int, int> first_pixel;
      for (int index = 0; index < size.area(); ++index)
      {
        const int component = components.at<int>(index / size.width, index % size.width);
        const int expected = component == 0 ? index : first_pixel.emplace(component, index).first->second;
        ASSERT_EQ(expected, labels.at<int>(index / size.width, index % size.width)) << pattern.name << size;
      }
    }
  }
}

TEST(ReferenceFill, sumsAgreeWithOpenCVAndWithEachPixel)
{
  const cv::Mat edges = omr::noiseEdges({97, 61}, 0.4);
  const cv::Mat image = noiseImage(edges.size());
  const cv::Mat labels = omr::labelRegions(edges);
  const std::vector<RegionSums> sums = omr::sumRegions(image, edges, labels);
  cv::Mat components;
  cv::Mat stats;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(edges == 0, components, stats, centers, 4, CV_32S);
  ASSERT_EQ(static_cast<std::size_t>(count - 1), sums.size());
  for (const RegionSums& region : sums)
  {
    const cv::Mat inside = labels == region.label;
    const int component = components.at<int>(region.label / edges.cols, region.label % edges.cols);
    const omr::Region data = omr::toRegion(region);
    EXPECT_EQ(stats.at<int>(component, cv::CC_STAT_AREA), data.area);
    EXPECT_EQ(cv::Rect(stats.at<int>(component, cv::CC_STAT_LEFT), stats.at<int>(component, cv::CC_STAT_TOP),
                       stats.at<int>(component, cv::CC_STAT_WIDTH), stats.at<int>(component, cv::CC_STAT_HEIGHT)),
              data.box);
    EXPECT_NEAR(centers.at<double>(component, 0), data.center.x, 1e-9);
    EXPECT_NEAR(centers.at<double>(component, 1), data.center.y, 1e-9);
    const cv::Scalar color = cv::mean(image, inside);
    cv::Mat grown;
    cv::dilate(edges, grown, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
    EXPECT_EQ(cv::countNonZero(inside & grown), data.perimeter);
    std::vector<cv::Point> pixels;
    cv::findNonZero(inside, pixels);
    double distance = 0;
    double squared = 0;
    for (const cv::Point& p : pixels)
    {
      distance += std::hypot(p.x - data.center.x, p.y - data.center.y) / data.area;
      squared += (std::pow(p.x - data.center.x, 2) + std::pow(p.y - data.center.y, 2)) / data.area;
    }
    EXPECT_NEAR(distance, data.mean_distance, 1e-3);
    EXPECT_NEAR(std::sqrt(std::max(0., squared - distance * distance)), data.distance_deviation, 0.05);
    EXPECT_NEAR(squared + 1. / 6, data.cxx + data.cyy, 1e-6);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(color[c], data.color[c], 1e-3);
    }
  }
}

TEST(ReferenceFill, refusesWrongInput)
{
  const cv::Mat image(4, 5, CV_8UC3, cv::Scalar::all(0));
  const cv::Mat edges(4, 5, CV_8UC1, cv::Scalar::all(0));
  const cv::Mat labels(4, 5, CV_32SC1, cv::Scalar::all(0));
  EXPECT_THROW(omr::filterImage(cv::Mat(), Filter::none, 3), std::invalid_argument);
  EXPECT_THROW(omr::filterImage(edges, Filter::none, 3), std::invalid_argument);
  EXPECT_THROW(omr::filterImage(image, Filter::gaussian, 4), std::invalid_argument);
  EXPECT_THROW(omr::edgeMask(edges, {10}), std::invalid_argument);
  EXPECT_THROW(omr::labelRegions(image), std::invalid_argument);
  EXPECT_THROW(omr::labelRegions(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(omr::sumRegions(image, edges, edges), std::invalid_argument);
  EXPECT_THROW(omr::sumRegions(image, edges(cv::Rect(0, 0, 4, 4)), labels), std::invalid_argument);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
