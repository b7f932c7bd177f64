#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

using omr::HAAR_FEATURES;

namespace
{
constexpr int SIDE = 16;  // of a window of level 0 [px]
constexpr int CROSSING = omr::HAAR_SHIFTS;
constexpr int CONTRAST = omr::HAAR_SHIFTS + 1;

/** Squares of a size that are turned about the window's centre; averaged from 8 x 8 points a pixel. */
cv::Mat squares(double size, double degrees, double dark = 40, double bright = 200)
{
  cv::Mat image(SIDE, SIDE, CV_8UC3);
  const double c = std::cos(degrees * CV_PI / 180) / size;
  const double s = std::sin(degrees * CV_PI / 180) / size;
  for (int y = 0; y < SIDE; ++y)
  {
    for (int x = 0; x < SIDE; ++x)
    {
      int black = 0;
      for (int i = 0; i < 64; ++i)
      {
        const double px = x + (i % 8 + .5) / 8 - SIDE / 2.;
        const double py = y + (i / 8 + .5) / 8 - SIDE / 2.;
        const int parity = static_cast<int>(std::floor(c * px + s * py) + std::floor(c * py - s * px));
        black += parity & 1;
      }
      image.at<cv::Vec3b>(y, x) = cv::Vec3b::all(cv::saturate_cast<uchar>(bright + (dark - bright) * black / 64));
    }
  }
  return image;
}

/** Squares of any brightness, each its own. */
cv::Mat clutter(int seed)
{
  cv::RNG random(seed);
  cv::Mat small(4, 4, CV_8UC3);
  random.fill(small, cv::RNG::UNIFORM, 20, 220);
  cv::Mat image;
  cv::resize(small, image, {SIDE, SIDE}, 0, 0, cv::INTER_LINEAR);
  return image;
}

/** Features of the first window of an image. */
std::vector<float> featuresOf(const cv::Mat& image, int level = 0)
{
  cv::Mat integral;
  cv::integral(image, integral, CV_32S);
  std::vector<float> features(HAAR_FEATURES);
  EXPECT_TRUE(omr::haarFeatures(omr::haarCells(integral, level), {0, 0}, features.data()));
  return features;
}
}  // namespace

TEST(HaarFeatures, theGridCoversWholeWindowsOnly)
{
  EXPECT_EQ(cv::Size(1, 1), omr::windowGrid({16, 16}, 0));
  EXPECT_EQ(cv::Size(), omr::windowGrid({15, 1000}, 0));
  EXPECT_EQ(cv::Size(2, 1), omr::windowGrid({20, 19}, 0));
  EXPECT_EQ(cv::Size(1, 1), omr::windowGrid({32, 32}, 1));
  EXPECT_EQ(cv::Rect(4, 8, 16, 16), omr::windowRect({1, 2}, 0));
  EXPECT_EQ(cv::Rect(64, 0, 128, 128), omr::windowRect({2, 0}, 3));
  const cv::Size size(1921, 1079);
  for (int level = 0; level < omr::HAAR_LEVELS; ++level)
  {
    const cv::Size grid = omr::windowGrid(size, level);
    const cv::Rect last = omr::windowRect({grid.width - 1, grid.height - 1}, level);
    EXPECT_EQ(last, last & cv::Rect({}, size)) << "level " << level;
  }
}

TEST(HaarFeatures, aCellIsTheLogarithmOfItsMean)
{
  cv::Mat image(4, 4, CV_8UC3);
  cv::randu(image, 0, 256);
  image(cv::Rect(2, 2, 2, 2)) = cv::Scalar(24, 48, 96);  // 1 + mean / 24 is 2, 3 and 5
  cv::Mat integral;
  cv::integral(image, integral, CV_32S);
  const cv::Mat cells = omr::haarCells(integral, 0);
  ASSERT_EQ(cv::Size(2, 2), cells.size());
  const double blue = 256;
  const double green = 256 * std::log2(3);
  const double red = 256 * std::log2(5);
  const auto& cell = cells.at<cv::Vec3s>(1, 1);
  EXPECT_NEAR(blue + green + red, cell[0], 2);
  EXPECT_NEAR(red - green, cell[1], 1);
  EXPECT_NEAR(blue - green, cell[2], 1);
}

TEST(HaarFeatures, aWindowWithAPlainQuarterHasNone)
{
  cv::Mat image = squares(4, 0);
  image(cv::Rect(8, 8, 8, 8)) = cv::Scalar::all(120);
  cv::Mat integral;
  cv::integral(image, integral, CV_32S);
  std::vector<float> features(HAAR_FEATURES, 7);
  EXPECT_FALSE(omr::haarFeatures(omr::haarCells(integral, 0), {0, 0}, features.data()));
  EXPECT_EQ(std::vector<float>(HAAR_FEATURES, 7), features);
}

TEST(HaarFeatures, squaresThatDifferInColorAloneAreLikeOthers)
{
  // The squares do not coincide with blocks, in which colour is compared.
  const auto squares_of = [](const cv::Vec3b& first, const cv::Vec3b& second) {
    cv::Mat image(SIDE, SIDE, CV_8UC3);
    for (int i = 0; i < SIDE * SIDE; ++i)
    {
      image.at<cv::Vec3b>(i / SIDE, i % SIDE) = (i / SIDE + 2) / 4 % 2 == (i % SIDE + 2) / 4 % 2 ? first : second;
    }
    return featuresOf(image);
  };
  const std::vector<float> colored = squares_of({40, 80, 200}, {40, 200, 80});
  const std::vector<float> gray = squares_of({200, 200, 200}, {60, 60, 60});
  for (int i = 0; i < HAAR_FEATURES; ++i)
  {
    EXPECT_TRUE(std::isfinite(colored[i])) << "feature " << i;
  }
  for (int i = 0; i <= CROSSING; ++i)
  {
    EXPECT_NEAR(gray[i], colored[i], .01) << "feature " << i;
  }
}

TEST(HaarFeatures, squaresOfAnyTurnCrossMoreThanClutter)
{
  for (const double size : {3.2, 4., 5.})
  {
    for (const double degrees : {0., 13., 30., 45., 70.})
    {
      EXPECT_GT(featuresOf(squares(size, degrees))[CROSSING], .2) << size << " px, " << degrees << " degrees";
    }
  }
  float sum = 0;
  for (int seed = 1; seed <= 20; ++seed)
  {
    sum += featuresOf(clutter(seed))[CROSSING];
  }
  EXPECT_LT(sum / 20, .15);
}

TEST(HaarFeatures, aQuarterTurnChangesNoDifference)
{
  const cv::Mat image = squares(4.3, 20);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const std::vector<float> expected = featuresOf(image);
  const std::vector<float> actual = featuresOf(turned);
  for (int i = 0; i <= CONTRAST; ++i)
  {
    EXPECT_NEAR(expected[i], actual[i], 1e-4) << "feature " << i;
  }
}

TEST(HaarFeatures, halfTheLightHardlyChangesThem)
{
  const std::vector<float> bright = featuresOf(squares(4, 10, 60, 240));
  const std::vector<float> dark = featuresOf(squares(4, 10, 30, 120));
  for (int i = 0; i < HAAR_FEATURES; ++i)
  {
    EXPECT_NEAR(bright[i], dark[i], .3) << "feature " << i;
  }
}

TEST(HaarFeatures, aLevelSeesWhatTheOneBelowSeesAtHalfTheSize)
{
  const cv::Mat small = squares(4, 25);
  cv::Mat large;
  cv::resize(small, large, {}, 4, 4, cv::INTER_NEAREST);
  EXPECT_EQ(featuresOf(small), featuresOf(large, 2));
}

TEST(HaarGate, itsInputsAreTheBlocksRelativeToTheContrast)
{
  cv::Mat image = squares(4.3, 20);
  cv::Mat integral;
  cv::integral(image, integral, CV_32S);
  const cv::Mat cells = omr::haarCells(integral, 0);
  std::vector<float> inputs(omr::GATE_INPUTS);
  ASSERT_TRUE(omr::gateInputs(cells, {0, 0}, inputs.data()));
  const std::vector<float> features = featuresOf(image);
  const float contrast = features[CONTRAST] * 256;
  double ratio = 0;  // of the two measures of contrast; the same for all inputs
  for (int block = 0; block < omr::HAAR_BLOCKS; ++block)
  {
    const float* feature = features.data() + omr::FIRST_BLOCK_FEATURE + 6 * block;
    const double across = (feature[3] + 1) * 2 * contrast;
    if (across > 100)
    {
      ratio = ratio == 0 ? inputs[6 * block + 3] / across : ratio;
      EXPECT_NEAR(ratio, inputs[6 * block + 3] / across, 1e-3 * ratio);
      EXPECT_NEAR(feature[0] * 4 * contrast * ratio, inputs[6 * block], .03);
    }
  }
  EXPECT_GT(ratio, 0);
}

TEST(HaarGate, whatHasFeaturesHasInputs)
{
  std::vector<float> features(HAAR_FEATURES);
  std::vector<float> inputs(omr::GATE_INPUTS);
  int with_features = 0;
  for (int seed = 1; seed <= 500; ++seed)
  {
    cv::Mat image = clutter(seed);
    image.convertTo(image, -1, .02 + .0008 * seed, 40);  // about the least contrast
    cv::Mat integral;
    cv::integral(image, integral, CV_32S);
    const cv::Mat cells = omr::haarCells(integral, 0);
    if (omr::haarFeatures(cells, {0, 0}, features.data()))
    {
      with_features += 1;
      EXPECT_TRUE(omr::gateInputs(cells, {0, 0}, inputs.data())) << "seed " << seed;
    }
  }
  EXPECT_GT(with_features, 50);
  EXPECT_LT(with_features, 450);
}

TEST(WindowScores, theNeighboursOfALikelyWindowAreLookedAtToo)
{
  cv::Mat image(64, 64, CV_8UC3);
  cv::randu(image, 0, 256);
  omr::MarkerNetwork network;
  network.hidden = 1;
  network.weights.assign(HAAR_FEATURES + 1 + 2 * 2, 0);
  for (const float score : {omr::FOLLOWED_SCORE + .01F, omr::FOLLOWED_SCORE - .01F})
  {
    for (int kind = 0; kind < omr::MARKER_KINDS; ++kind)
    {
      network.weights[HAAR_FEATURES + 1 + 2 * kind] = 2 * std::atanh(score);  // the bias of the output
    }
    const std::vector<omr::MarkerScores> scores = omr::windowScores(image, network);
    const cv::Size grid = omr::windowGrid(image.size(), 0);
    for (int i = 0; i < grid.area(); ++i)
    {
      const bool looked = score > omr::FOLLOWED_SCORE || (i % grid.width % 2 == 0 && i / grid.width % 2 == 0);
      EXPECT_NEAR(looked ? score : -1, scores[i][0], 1e-5) << i;
    }
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
