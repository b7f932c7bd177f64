#include "outdoor_omr/marker_network.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "network_training.h"

using omr::FeedForward;
using omr::HAAR_FEATURES;
using omr::MarkerKind;
using omr::MarkerNetwork;
using omr::WindowLabel;

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

std::string temporaryFile(const std::string& text)
{
  const std::string name = testing::TempDir() + "marker_network.yaml";
  std::ofstream(name) << text;
  return name;
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
    omr::loadMarkerNetwork(temporaryFile(text));
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
  const cv::Ptr<cv::ml::ANN_MLP> trained = omr::trainNetwork(windows.features, windows.labels, 9, 3);
  const omr::FeedForward network = omr::toFeedForward(*trained, {});
  cv::Mat expected;
  trained->predict(windows.features, expected);
  int right = 0;
  for (int i = 0; i < windows.features.rows; ++i)
  {
    const omr::MarkerScores scores = omr::markerScores(network, HAAR_FEATURES, windows.features.ptr<float>(i));
    ASSERT_NEAR(expected.at<float>(i, 0), scores[0], 1e-5);
    ASSERT_NEAR(expected.at<float>(i, 1), scores[1], 1e-5);
    right += static_cast<int>((scores[0] > 0) == (windows.labels[i] == WindowLabel::checkerboard) &&
                              (scores[1] > 0) == (windows.labels[i] == WindowLabel::target));
  }
  EXPECT_GT(right, 2950) << "of 3000";
}

TEST(MarkerNetwork, equalWindowsGiveEqualNetworks)
{
  const omr::WindowSet windows = windowsToLearn();
  const auto trained = [&] {
    return omr::toFeedForward(*omr::trainNetwork(windows.features, windows.labels, 4, 1), {}).weights;
  };
  EXPECT_EQ(trained(), trained());
}

TEST(MarkerNetwork, readsWhatIsWritten)
{
  const omr::WindowSet windows = windowsToLearn();
  MarkerNetwork network;
  static_cast<FeedForward&>(network) =
      omr::toFeedForward(*omr::trainNetwork(windows.features, windows.labels, 5, 1), {.75F, .125F});
  network.gate = omr::toFeedForward(*omr::trainNetwork(windows.gate, windows.labels, 3, 1), {-.5F, -.25F});
  network.boxes[0] = {{1, 2, 3, 4}, -1.5F, 2.5F};
  network.boxes[1] = {{5, 6, 7, 8}, .5F, 3.5F};
  const MarkerNetwork read = omr::loadMarkerNetwork(temporaryFile("# a comment\n" + textOf(network)));
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
  EXPECT_EQ(0, omr::loadMarkerNetwork(temporaryFile(smallNetwork())).gate.hidden);
}

TEST(MarkerNetwork, aFileWithoutBoxesShowsThemAll)
{
  const std::string text = smallNetwork();
  const MarkerNetwork network = omr::loadMarkerNetwork(temporaryFile(text.substr(0, text.find("boxes:"))));
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
