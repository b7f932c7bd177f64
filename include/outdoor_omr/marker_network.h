#ifndef OUTDOOR_OMR_MARKER_NETWORK_H
#define OUTDOOR_OMR_MARKER_NETWORK_H

#include <array>
#include <string>
#include <vector>

namespace omr
{
/** What a candidate may be; the order of the network's outputs. */
enum class MarkerKind
{
  checkerboard,
  target
};
constexpr int MARKER_KINDS = 2;

/** One score a kind, -1 (no marker) to 1 (marker). */
using MarkerScores = std::array<float, MARKER_KINDS>;

/**
 * A feed-forward neural network with a single hidden layer and one output a kind. A unit gives tanh(x / 2) of its
 * weighted sum, which is cv::ml::ANN_MLP::SIGMOID_SYM with both parameters 1.
 */
struct FeedForward
{
  int hidden = 0;              ///< units of the hidden layer
  std::vector<float> weights;  ///< of each hidden unit: bias and a weight for each input; then of each output: bias and
                               ///< one weight a hidden unit
  MarkerScores thresholds = {1, 1};  ///< a larger score stands for a marker of the kind

  bool passes(const MarkerScores& scores) const
  {
    return scores[0] > thresholds[0] || scores[1] > thresholds[1];
  }
};

/** What the windows of a box tell about it; see boxFeatures(). */
constexpr int BOX_FEATURES = 3;

/** How much evidence the windows of a box give for a marker, and what that is good for. */
struct BoxEvidence
{
  std::array<float, BOX_FEATURES + 1> weights = {};  ///< bias and a weight a feature; the sum is the log of the odds
  float enlarged = 0;                                ///< least evidence of a box that is looked at enlarged
  float shown = 0;                                   ///< least evidence of a candidate that was not read
};

constexpr int MAX_GATE_UNITS = 16;  ///< which kernels/gate.cl computes at once

/**
 * The network that tells windows with markers from others (paper, section 4.5), by the features of haar_features.h.
 * Windows that the gate, a smaller network on gateInputs(), finds no marker in are not looked at any further.
 */
struct MarkerNetwork : FeedForward
{
  FeedForward gate;  ///< of MAX_GATE_UNITS hidden units at most; of none: every window passes
  std::array<BoxEvidence, MARKER_KINDS> boxes;
};

/** @throws std::invalid_argument unless there are 1 to 256 hidden units, 16 in the gate at most, and all weights. */
void checkNetwork(const MarkerNetwork& network);

/** @param inputs of the network: HAAR_FEATURES values for a MarkerNetwork, GATE_INPUTS for its gate. */
MarkerScores markerScores(const FeedForward& network, int inputs, const float* values);

/** @param features HAAR_FEATURES values. */
MarkerScores markerScores(const MarkerNetwork& network, const float* features);

/**
 * Reads a network from a yaml file as omr_train writes it.
 *
 * @throws std::invalid_argument naming file, line and key for what does not suit; std::runtime_error when the file
 *         cannot be read.
 */
MarkerNetwork loadMarkerNetwork(const std::string& file);

/** The same from the text of such a file. @param name that errors give it. */
MarkerNetwork parseMarkerNetwork(const std::string& text, const std::string& name);

/** The network of config/marker_network.yaml, built into the library. */
const MarkerNetwork& defaultMarkerNetwork();

}  // namespace omr

#endif
