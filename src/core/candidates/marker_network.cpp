#include "outdoor_omr/marker_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "default_marker_network.h"
#include "outdoor_omr/haar_features.h"
#include "yaml_file.h"

namespace omr
{
namespace
{
constexpr int MAX_HIDDEN = 256;

/** Bias and weights of one unit. In float, as a device does it, the scores of large weights differ by 1e-5. */
template <typename Input>
double weightedSum(const float* weights, const Input* inputs, int count)
{
  constexpr int LANES = 8;
  std::array<double, LANES> sums = {weights[0]};
  int i = 0;
  for (; i + LANES <= count; i += LANES)
  {
    for (int lane = 0; lane < LANES; ++lane)
    {
      sums[lane] += static_cast<double>(weights[i + lane + 1]) * inputs[i + lane];
    }
  }
  for (; i < count; ++i)
  {
    sums[0] += static_cast<double>(weights[i + 1]) * inputs[i];
  }
  return std::accumulate(sums.begin(), sums.end(), 0.);
}

void appendUnits(const YamlFile& layer, const std::string& expected, std::size_t units, std::size_t inputs,
                 std::vector<float>& weights)
{
  for (const YamlFile& unit : layer.list(expected, units))
  {
    for (const double weight : unit.numbers("the bias and a weight for each input", inputs + 1))
    {
      weights.push_back(static_cast<float>(weight));
    }
  }
}

/** The keys of a network, which others may stand beside. */
void readUnits(const YamlFile& file, std::size_t inputs, int max_hidden, FeedForward& network)
{
  const YamlFile thresholds = file.get("thresholds", "the thresholds of the scores");
  thresholds.allowOnly({"checkerboard", "target"}, "a map of checkerboard and target");
  network.thresholds[0] = static_cast<float>(thresholds.get("checkerboard", "a score").number("a score", -1, 1));
  network.thresholds[1] = static_cast<float>(thresholds.get("target", "a score").number("a score", -1, 1));
  const YamlFile hidden = file.get("hidden_units", "a list of units");
  network.hidden = static_cast<int>(hidden.list("a list of units").size());
  if (network.hidden == 0 || network.hidden > max_hidden)
  {
    hidden.fail("there are " + std::to_string(network.hidden) + " units, expected 1 to " + std::to_string(max_hidden));
  }
  appendUnits(hidden, "a list of units", network.hidden, inputs, network.weights);
  appendUnits(file.get("output_units", "two units"), "two units", MARKER_KINDS, network.hidden, network.weights);
}

BoxEvidence readEvidence(const YamlFile& file)
{
  file.allowOnly({"weights", "enlarged", "shown"}, "a map of weights, enlarged and shown");
  BoxEvidence evidence;
  const std::vector<double> weights =
      file.get("weights", "a list").numbers("the bias and a weight for each feature", BOX_FEATURES + 1);
  std::copy(weights.begin(), weights.end(), evidence.weights.begin());
  evidence.enlarged = static_cast<float>(file.get("enlarged", "a number").number("a number"));
  evidence.shown = static_cast<float>(file.get("shown", "a number").number("a number"));
  return evidence;
}

MarkerNetwork readMarkerNetwork(const YamlFile& file)
{
  file.allowOnly({"thresholds", "hidden_units", "output_units", "gate", "boxes"},
                 "a map of thresholds, hidden_units, output_units, gate and boxes");
  MarkerNetwork network;
  readUnits(file, HAAR_FEATURES, MAX_HIDDEN, network);
  if (file.has("gate"))
  {
    const YamlFile gate = file.get("gate", "a network");
    gate.allowOnly({"thresholds", "hidden_units", "output_units"},
                   "a map of thresholds, hidden_units and output_units");
    readUnits(gate, GATE_INPUTS, MAX_GATE_UNITS, network.gate);
  }
  if (file.has("boxes"))
  {
    const YamlFile boxes = file.get("boxes", "a map");
    boxes.allowOnly({"checkerboard", "target"}, "a map of checkerboard and target");
    network.boxes = {readEvidence(boxes.get("checkerboard", "a map")), readEvidence(boxes.get("target", "a map"))};
  }
  return network;
}

bool isComplete(const FeedForward& network, int inputs, int max_hidden)
{
  if (network.hidden < 1 || network.hidden > max_hidden)
  {
    return false;
  }
  const int weights = network.hidden * (inputs + 1) + MARKER_KINDS * (network.hidden + 1);
  return network.weights.size() == static_cast<std::size_t>(weights);
}
}  // namespace

void checkNetwork(const MarkerNetwork& network)
{
  if (!isComplete(network, HAAR_FEATURES, MAX_HIDDEN))
  {
    throw std::invalid_argument("a network of candidates has 1 to " + std::to_string(MAX_HIDDEN) +
                                " hidden units and all their weights; this one has " + std::to_string(network.hidden) +
                                " and " + std::to_string(network.weights.size()) + " weights");
  }
  const FeedForward& gate = network.gate;
  if (gate.hidden != 0 && !isComplete(gate, GATE_INPUTS, MAX_GATE_UNITS))
  {
    throw std::invalid_argument("the gate of a network of candidates has up to " + std::to_string(MAX_GATE_UNITS) +
                                " hidden units and all their weights; this one has " + std::to_string(gate.hidden) +
                                " and " + std::to_string(gate.weights.size()) + " weights");
  }
}

MarkerScores markerScores(const FeedForward& network, int inputs, const float* values)
{
  std::array<double, MAX_HIDDEN> hidden;
  const float* weights = network.weights.data();
  for (int unit = 0; unit < network.hidden; ++unit)
  {
    hidden[unit] = std::tanh(.5 * weightedSum(weights, values, inputs));
    weights += inputs + 1;
  }
  MarkerScores scores = {};
  for (float& score : scores)
  {
    score = static_cast<float>(std::tanh(.5 * weightedSum(weights, hidden.data(), network.hidden)));
    weights += network.hidden + 1;
  }
  return scores;
}

MarkerScores markerScores(const MarkerNetwork& network, const float* features)
{
  return markerScores(network, HAAR_FEATURES, features);
}

MarkerNetwork loadMarkerNetwork(const std::string& file)
{
  return readMarkerNetwork(YamlFile::load(file));
}

MarkerNetwork parseMarkerNetwork(const std::string& text, const std::string& name)
{
  return readMarkerNetwork(YamlFile::parse(text, name));
}

const MarkerNetwork& defaultMarkerNetwork()
{
  static const MarkerNetwork NETWORK = parseMarkerNetwork(DEFAULT_MARKER_NETWORK, "marker_network.yaml");
  return NETWORK;
}

}  // namespace omr
