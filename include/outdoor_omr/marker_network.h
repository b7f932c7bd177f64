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
 * The feed-forward neural network with a single hidden layer that tells windows with markers from others (paper,
 * section 4.5). Inputs are the features of haar_features.h; a unit gives tanh(x / 2) of its weighted sum, which is
 * cv::ml::ANN_MLP::SIGMOID_SYM with both parameters 1.
 */
struct MarkerNetwork
{
  int hidden = 0;              ///< units of the hidden layer
  std::vector<float> weights;  ///< of each hidden unit: bias and HAAR_FEATURES weights; then of each output: bias and
                               ///< one weight a hidden unit
  MarkerScores thresholds = {1, 1};  ///< a window with a larger score may show a marker of the kind
};

/** @param features HAAR_FEATURES values. */
MarkerScores markerScores(const MarkerNetwork& network, const float* features);

/**
 * Reads a network from a yaml file as omr_train writes it.
 *
 * @throws std::invalid_argument naming file, line and key for what does not suit; std::runtime_error when the file
 *         cannot be read.
 */
MarkerNetwork loadMarkerNetwork(const std::string& file);

/** The network of config/marker_network.yaml, built into the library. */
const MarkerNetwork& defaultMarkerNetwork();

}  // namespace omr

#endif
