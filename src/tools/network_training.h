#ifndef OUTDOOR_OMR_TOOLS_NETWORK_TRAINING_H
#define OUTDOOR_OMR_TOOLS_NETWORK_TRAINING_H

#include <opencv2/core.hpp>
#include <ostream>

#include "outdoor_omr/marker_network.h"
#include "training_windows.h"

namespace omr
{
/** What a network learns from: rows of inputs, what they show, and how much each counts. */
struct Examples
{
  const cv::Mat& inputs;  ///< WindowSet::features or WindowSet::gate
  const std::vector<WindowLabel>& labels;
  const std::vector<float>& weights;
};

/**
 * Trains a network by gradient descent in batches. Equal examples give equal networks.
 *
 * @param epochs passes over the examples.
 * @param varied whether a window is learned from as it would be turned, mirrored and with dark and light exchanged, in
 *               each pass another way.
 */
FeedForward trainNetwork(const Examples& examples, int hidden, int epochs, bool varied);

/** Writes what loadMarkerNetwork() reads. */
void writeMarkerNetwork(std::ostream& stream, const MarkerNetwork& network);

}  // namespace omr

#endif
