#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "compare.h"
#include "device_fixture.h"
#include "outdoor_omr/window_scores.h"
#include "scene.h"

using omr::Geometry;
using omr::MarkerScores;

namespace
{
/** A network that depends on every feature: the default one may have learned to ignore some. */
omr::MarkerNetwork anyNetwork(int hidden)
{
  omr::MarkerNetwork network;
  network.hidden = hidden;
  network.weights.resize(hidden * (omr::HAAR_FEATURES + 1) + omr::MARKER_KINDS * (hidden + 1));
  cv::RNG random(3);
  for (float& weight : network.weights)
  {
    weight = static_cast<float>(random.gaussian(.3));
  }
  return network;
}

/** Preliminary detection on the device against the plain one. */
class DeviceWindowsTest : public omr::test::DeviceTest
{
 protected:
  std::vector<MarkerScores> scores(const cv::Mat& image, const omr::MarkerNetwork& network)
  {
    std::vector<MarkerScores> scores;
    fill_->loadImage(image);
    fill_->scoreWindows(network, scores);
    fill_->finish();
    return scores;
  }

  void expectSameScores(const cv::Mat& image, const omr::MarkerNetwork& network)
  {
    const std::vector<MarkerScores> expected = omr::windowScores(image, network);
    const std::vector<MarkerScores> actual = scores(image, network);
    ASSERT_EQ(expected.size(), actual.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      ASSERT_NEAR(expected[i][0], actual[i][0], 1e-5) << "window " << i;
      ASSERT_NEAR(expected[i][1], actual[i][1], 1e-5) << "window " << i;
    }
  }
};
}  // namespace

TEST_P(DeviceWindowsTest, theScoresAreThoseOfPlainCpp)
{
  for (const int hidden : {1, 7, 8, 33})
  {
    expectSameScores(omr::drawScene({337, 251}), anyNetwork(hidden));
  }
  expectSameScores(omr::drawScene({640, 480}), omr::defaultMarkerNetwork());
  expectSameScores(omr::test::noiseImage({301, 203}), omr::defaultMarkerNetwork());
}

TEST_P(DeviceWindowsTest, theCellsOfAllLevelsAreThoseOfAnIntegralImage)
{
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(1, 97), cv::Size(97, 1), cv::Size(17, 16), cv::Size(131, 127),
                               cv::Size(194, 200), cv::Size(515, 517), cv::Size(1291, 519)})
  {
    expectSameScores(omr::test::noiseImage(size), anyNetwork(5));
    expectSameScores(omr::drawScene(size), anyNetwork(5));
    expectSameScores(omr::drawScene(size), omr::defaultMarkerNetwork());  // whose gate sees blocks of cells
  }
}

TEST_P(DeviceWindowsTest, theRowStepMayBeAny)
{
  const cv::Mat large = omr::drawScene({400, 300});
  expectSameScores(large(cv::Rect(13, 7, 301, 211)), omr::defaultMarkerNetwork());
}

TEST_P(DeviceWindowsTest, anImageSmallerThanAWindowHasNone)
{
  EXPECT_TRUE(scores(omr::test::noiseImage({15, 40}), omr::defaultMarkerNetwork()).empty());
  EXPECT_EQ(1U, scores(omr::test::noiseImage({16, 16}), omr::defaultMarkerNetwork()).size());
}

TEST_P(DeviceWindowsTest, squaresThatCoincideWithCellsHaveAScore)
{
  cv::Mat image(64, 64, CV_8UC3);
  for (int i = 0; i < 64 * 64; ++i)
  {
    image.at<cv::Vec3b>(i / 64, i % 64) = cv::Vec3b::all((i / 64 / 4 + i % 64 / 4) % 2 == 0 ? 30 : 220);
  }
  expectSameScores(image, anyNetwork(8));
  EXPECT_NE(-1, scores(image, anyNetwork(8)).front()[0]);
}

TEST_P(DeviceWindowsTest, windowsOfOneBrightnessAreScoredByTheirColors)
{
  cv::RNG random(9);
  cv::Mat image(96, 132, CV_8UC3);
  for (int y = 0; y < image.rows; y += 6)
  {
    for (int x = 0; x < image.cols; x += 6)
    {
      const int hue = random.uniform(0, 3);
      image(cv::Rect(x, y, 6, 6)) = hue == 0   ? cv::Scalar(40, 80, 200)
                                    : hue == 1 ? cv::Scalar(80, 200, 40)
                                               : cv::Scalar(200, 40, 80);
    }
  }
  expectSameScores(image, anyNetwork(8));
  const std::vector<MarkerScores> all = scores(image, anyNetwork(8));
  const auto scored = std::count_if(all.begin(), all.end(), [](const MarkerScores& window) { return window[0] != -1; });
  EXPECT_GT(scored, 20);
}

TEST_P(DeviceWindowsTest, aPlainWindowHasNoScore)
{
  for (const MarkerScores& score : scores(cv::Mat(64, 64, CV_8UC3, cv::Scalar(90, 120, 80)), anyNetwork(8)))
  {
    EXPECT_EQ(-1, score[0]);
    EXPECT_EQ(-1, score[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(Geometries, DeviceWindowsTest, testing::Values(Geometry::strips, Geometry::words),
                         omr::test::geometryName);

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
