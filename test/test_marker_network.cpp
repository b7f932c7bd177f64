#include "outdoor_omr/marker_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/ml.hpp>
#include <sstream>

#include "network_training.h"
#include "own_folder.h"

using omr::FeedForward;
using omr::HAAR_FEATURES;
using omr::MarkerNetwork;
using omr::WindowLabel;
using omr::test::writeFile;

namespace
{
/** Windows in which two features tell the kind. */
omr::WindowSet windowsToLearn()
{
  omr::WindowSet windows;
  cv::RNG random(5);
  for (int i = 0; i < 3000; ++i)
  {
    std::vector<float> features(HAAR_FEATURES);  // those of the gate are the first of them
    for (float& feature : features)
    {
      feature = static_cast<float>(random.gaussian(1) + .5);
    }
    const WindowLabel label = static_cast<WindowLabel>(i % 3);
    features[7] += label == WindowLabel::checkerboard ? 8.F : 0.F;
    features[90] -= label == WindowLabel::target ? 8.F : 0.F;
    windows.append(features.data(), features.data(), label);
  }
  return windows;
}

FeedForward learned(const omr::WindowSet& windows, const cv::Mat& inputs, int hidden, int epochs, bool varied = false)
{
  const std::vector<float> weights(windows.labels.size(), 1);
  return omr::trainNetwork({inputs, windows.labels, weights}, hidden, epochs, varied);
}

/** OpenCV's network, trained a little. */
cv::Ptr<cv::ml::ANN_MLP> networkOfOpenCv(const omr::WindowSet& windows, int hidden)
{
  cv::Mat answers(windows.features.rows, omr::MARKER_KINDS, CV_32FC1, cv::Scalar(-1));
  for (int i = 0; i < answers.rows; ++i)
  {
    if (windows.labels[i] != WindowLabel::clutter)
    {
      answers.at<float>(i, static_cast<int>(windows.labels[i])) = 1;
    }
  }
  const cv::Ptr<cv::ml::ANN_MLP> network = cv::ml::ANN_MLP::create();
  network->setLayerSizes(cv::Mat(cv::Vec3i(windows.features.cols, hidden, omr::MARKER_KINDS)));
  network->setActivationFunction(cv::ml::ANN_MLP::SIGMOID_SYM, 1, 1);
  network->setTermCriteria({cv::TermCriteria::COUNT, 1, 0});
  network->setTrainMethod(cv::ml::ANN_MLP::BACKPROP, .01, .5);
  network->train(cv::ml::TrainData::create(windows.features, cv::ml::ROW_SAMPLE, answers),
                 cv::ml::ANN_MLP::NO_OUTPUT_SCALE | cv::ml::ANN_MLP::NO_INPUT_SCALE);
  return network;
}

/** OpenCV has the weights of layers 1 and 2 with the bias in the last row. */
FeedForward toFeedForward(const cv::ml::ANN_MLP& network)
{
  FeedForward copy;
  for (const int layer : {1, 2})
  {
    const cv::Mat weights = network.getWeights(layer);
    for (int unit = 0; unit < weights.cols; ++unit)
    {
      copy.weights.push_back(static_cast<float>(weights.at<double>(weights.rows - 1, unit)));
      for (int i = 0; i + 1 < weights.rows; ++i)
      {
        copy.weights.push_back(static_cast<float>(weights.at<double>(i, unit)));
      }
    }
    copy.hidden = layer == 1 ? weights.cols : copy.hidden;
  }
  return copy;
}

/** A window whose one block is lighter, or darker, than the others. */
std::vector<float> windowWithBlock(int block, float light, cv::RNG& random)
{
  std::vector<float> features(HAAR_FEATURES);
  for (float& feature : features)
  {
    feature = static_cast<float>(random.gaussian(1));
  }
  features[omr::FIRST_BLOCK_FEATURE + omr::BLOCK_FEATURES * block] = light;
  return features;
}

std::string textOf(const MarkerNetwork& network)
{
  std::ostringstream text;
  omr::writeMarkerNetwork(text, network);
  return text.str();
}

/** A network of two units. */
std::string smallNetwork()
{
  MarkerNetwork network;
  network.hidden = 2;
  network.thresholds = {.25F, -.5F};
  network.weights.assign(2 * (HAAR_FEATURES + 1) + 2 * 3, .5F);
  return textOf(network);
}

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  return text.replace(text.find(what), what.size(), by);
}

void expectAlike(const FeedForward& expected, const FeedForward& actual)
{
  EXPECT_EQ(expected.hidden, actual.hidden);
  EXPECT_EQ(expected.thresholds, actual.thresholds);
  ASSERT_EQ(expected.weights.size(), actual.weights.size());
  for (std::size_t i = 0; i < expected.weights.size(); ++i)
  {
    EXPECT_NEAR(expected.weights[i], actual.weights[i], 1e-4 * std::abs(expected.weights[i]));
  }
}

void expectRefused(const std::string& text, const std::string& words)
{
  try
  {
    omr::loadMarkerNetwork(writeFile("marker_network.yaml", text));
    FAIL() << "accepted, expected: " << words;
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_NE(std::string::npos, std::string(error.what()).find(words)) << error.what();
    EXPECT_NE(std::string::npos, std::string(error.what()).find("marker_network.yaml:")) << error.what();
  }
}
}  // namespace

TEST(MarkerNetwork, givesWhatTheNetworkOfOpenCvGives)
{
  const omr::WindowSet windows = windowsToLearn();
  const cv::Ptr<cv::ml::ANN_MLP> opencv = networkOfOpenCv(windows, 9);
  const FeedForward network = toFeedForward(*opencv);
  cv::Mat expected;
  opencv->predict(windows.features, expected);
  for (int i = 0; i < windows.features.rows; ++i)
  {
    const omr::MarkerScores scores = omr::markerScores(network, HAAR_FEATURES, windows.features.ptr<float>(i));
    ASSERT_NEAR(expected.at<float>(i, 0), scores[0], 1e-5);
    ASSERT_NEAR(expected.at<float>(i, 1), scores[1], 1e-5);
  }
}

TEST(MarkerNetwork, learnsWhatTellsTheKinds)
{
  const omr::WindowSet windows = windowsToLearn();
  const FeedForward network = learned(windows, windows.features, 9, 60);
  int right = 0;
  for (int i = 0; i < windows.features.rows; ++i)
  {
    const omr::MarkerScores scores = omr::markerScores(network, HAAR_FEATURES, windows.features.ptr<float>(i));
    right += static_cast<int>((scores[0] > 0) == (windows.labels[i] == WindowLabel::checkerboard) &&
                              (scores[1] > 0) == (windows.labels[i] == WindowLabel::target));
  }
  EXPECT_GT(right, 2950) << "of 3000";
}

TEST(MarkerNetwork, learnsAWindowTurnedMirroredAndInverted)
{
  cv::RNG random(3);
  omr::WindowSet windows;
  for (int i = 0; i < 6000; ++i)
  {
    const bool marker = i % 2 == 0;
    const std::vector<float> window = windowWithBlock(marker ? 1 : 5, 8, random);
    windows.append(window.data(), window.data(), marker ? WindowLabel::checkerboard : WindowLabel::clutter);
  }
  const auto share_found = [&](const FeedForward& network, const std::vector<int>& blocks) {
    int found = 0;
    for (int i = 0; i < 1000; ++i)
    {
      const std::vector<float> window = windowWithBlock(blocks[i % blocks.size()], i % 3 == 0 ? 8.F : -8.F, random);
      found += static_cast<int>(omr::markerScores(network, HAAR_FEATURES, window.data())[0] > 0);
    }
    return found / 1000.;
  };
  const FeedForward varied = learned(windows, windows.features, 16, 60, true);
  EXPECT_GT(share_found(varied, {1, 2, 4, 7, 8, 11, 13, 14}), .9);
  EXPECT_LT(share_found(varied, {5, 6, 9, 10}), .1) << "clutter";
  EXPECT_LT(share_found(learned(windows, windows.features, 16, 60), {2, 4, 7, 8, 11, 13, 14}), .7) << "as they are";
}

TEST(MarkerNetwork, learnsWhatCountsMore)
{
  const omr::WindowSet windows = windowsToLearn();
  std::vector<WindowLabel> labels(windows.labels.size());
  std::vector<float> weights(labels.size());
  for (const WindowLabel heavy : {WindowLabel::checkerboard, WindowLabel::target})
  {
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      labels[i] = i % 2 == 0 ? WindowLabel::checkerboard : WindowLabel::target;
      weights[i] = labels[i] == heavy ? 10 : 1;
    }
    const FeedForward network = omr::trainNetwork({windows.features, labels, weights}, 2, 30, false);
    double mean = 0;
    for (int i = 0; i < windows.features.rows; ++i)
    {
      mean += omr::markerScores(network, HAAR_FEATURES, windows.features.ptr<float>(i))[static_cast<int>(heavy)];
    }
    EXPECT_GT(mean / windows.features.rows, .4);
  }
}

TEST(MarkerNetwork, equalWindowsGiveEqualNetworks)
{
  const omr::WindowSet windows = windowsToLearn();
  const auto trained = [&] { return learned(windows, windows.features, 4, 1, true).weights; };
  EXPECT_EQ(trained(), trained());
}

TEST(MarkerNetwork, readsWhatIsWritten)
{
  const omr::WindowSet windows = windowsToLearn();
  MarkerNetwork network;
  static_cast<FeedForward&>(network) = learned(windows, windows.features, 5, 1);
  network.thresholds = {.75F, .125F};
  network.gate = learned(windows, windows.gate, 3, 1);
  network.gate.thresholds = {-.5F, -.25F};
  network.boxes[0] = {{1, 2, 3, 4}, -1.5F, 2.5F};
  network.boxes[1] = {{5, 6, 7, 8}, .5F, 3.5F};
  const MarkerNetwork read =
      omr::loadMarkerNetwork(writeFile("marker_network.yaml", "# a comment\n" + textOf(network)));
  expectAlike(network, read);
  expectAlike(network.gate, read.gate);
  for (int kind = 0; kind < omr::MARKER_KINDS; ++kind)
  {
    EXPECT_EQ(network.boxes[kind].weights, read.boxes[kind].weights);
    EXPECT_EQ(network.boxes[kind].enlarged, read.boxes[kind].enlarged);
    EXPECT_EQ(network.boxes[kind].shown, read.boxes[kind].shown);
  }
}

TEST(MarkerNetwork, aFileWithoutAGateLetsAllWindowsPass)
{
  EXPECT_EQ(0, omr::loadMarkerNetwork(writeFile("marker_network.yaml", smallNetwork())).gate.hidden);
}

TEST(MarkerNetwork, aFileWithoutBoxesShowsThemAll)
{
  const std::string text = smallNetwork();
  const MarkerNetwork network =
      omr::loadMarkerNetwork(writeFile("marker_network.yaml", text.substr(0, text.find("boxes:"))));
  EXPECT_EQ((std::array<float, omr::BOX_FEATURES + 1>{}), network.boxes[0].weights);
  EXPECT_EQ(0, network.boxes[0].shown);
}

TEST(MarkerNetwork, refusesWhatIsNone)
{
  EXPECT_THROW(omr::loadMarkerNetwork("/nonexistent/network.yaml"), std::runtime_error);
  expectRefused("", "expected a map");
  expectRefused("[1, 2]", "expected a map");
  expectRefused("thresholds: [", "not valid yaml");
  expectRefused(replaced(smallNetwork(), "target: -0.5", "target: 2"), "thresholds.target");
  expectRefused(replaced(smallNetwork(), "target: -0.5", "target: high"), "thresholds.target");
  expectRefused(replaced(smallNetwork(), "weights: [0, ", "weights: ["), "boxes.checkerboard.weights");
  expectRefused(replaced(smallNetwork(), "shown", "seen"), "boxes.checkerboard");
  expectRefused(replaced(smallNetwork(), "hidden_units", "hidden"), "there is no key 'hidden'");
  expectRefused(replaced(smallNetwork(), "0.5, 0.5", "0.5"), "hidden_units[0]");
  expectRefused(replaced(smallNetwork(), "0.5, 0.5", "0.5, .nan"), "hidden_units[0]");
  expectRefused(smallNetwork() + "gate: {thresholds: {checkerboard: 0, target: 0}, hidden_units: [[1]]}\n",
                "gate.hidden_units[0]");
  std::string units = "[1]";
  for (int unit = 1; unit <= omr::MAX_GATE_UNITS; ++unit)
  {
    units += ", [1]";
  }
  expectRefused(smallNetwork() + "gate: {thresholds: {checkerboard: 0, target: 0}, hidden_units: [" + units + "]}\n",
                "there are 17 units, expected 1 to 16");
  expectRefused("thresholds: {checkerboard: 0, target: 0}\nhidden_units: []\noutput_units: []\n", "hidden_units");
}

TEST(MarkerNetwork, theDefaultOneFits)
{
  const MarkerNetwork& network = omr::defaultMarkerNetwork();
  EXPECT_EQ(static_cast<std::size_t>(network.hidden * (HAAR_FEATURES + 1) + 2 * (network.hidden + 1)),
            network.weights.size());
  EXPECT_EQ(static_cast<std::size_t>(network.gate.hidden * (omr::GATE_INPUTS + 1) + 2 * (network.gate.hidden + 1)),
            network.gate.weights.size());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
