#ifndef OUTDOOR_OMR_WINDOW_SCORES_H
#define OUTDOOR_OMR_WINDOW_SCORES_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/marker_network.h"

namespace omr
{
/** Number of windows of an image on all levels. @param size of the image [px]. */
int windowCount(const cv::Size& size);

/** A score from which on the neighbours of a window are looked at as well, whether they pass the gate or not. */
constexpr float FOLLOWED_SCORE = -.85F;

/**
 * The network's scores of all windows, level by level, row by row. The gate looks at every second window of every
 * second row, the network at those that pass, and at the neighbours of those with a score above FOLLOWED_SCORE; the
 * rest, and windows without contrast, have -1. Plain C++: the oracle of gate.cl and network.cl, and their place where
 * no OpenCL device is.
 *
 * @param bgr H x W, CV_8UC3.
 */
std::vector<MarkerScores> windowScores(const cv::Mat& bgr, const MarkerNetwork& network);

/** Whether a window may show a marker at the first look. @param cells, first as in haarFeatures(). */
bool passesGate(const cv::Mat& cells, const cv::Point& first, const FeedForward& gate);

}  // namespace omr

#endif
