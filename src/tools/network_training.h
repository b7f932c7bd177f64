#ifndef OUTDOOR_OMR_TOOLS_NETWORK_TRAINING_H
#define OUTDOOR_OMR_TOOLS_NETWORK_TRAINING_H

#include <opencv2/ml.hpp>
#include <ostream>

#include "outdoor_omr/marker_network.h"
#include "training_windows.h"

namespace omr
{
/**
 * Trains OpenCV's network by stochastic gradient descent, with steps that shrink from pass to pass. Equal windows
 * give equal networks: OpenCV starts from weights of its own seed.
 *
 * @param inputs of each window, a row: WindowSet::features or WindowSet::gate.
 * @param epochs passes over the windows.
 */
cv::Ptr<cv::ml::ANN_MLP> trainNetwork(const cv::Mat& inputs, const std::vector<WindowLabel>& labels, int hidden,
                                      int epochs);

/** The same network, its scales of the inputs folded into the weights. @param thresholds of it. */
FeedForward toFeedForward(const cv::ml::ANN_MLP& trained, const MarkerScores& thresholds);

/** Writes what loadMarkerNetwork() reads. */
void writeMarkerNetwork(std::ostream& stream, const MarkerNetwork& network);

}  // namespace omr

#endif
