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

/**
 * The network's scores of all windows, level by level, row by row; -1 where a window has too little contrast or the
 * gate finds nothing. Plain C++: the oracle of gate.cl and network.cl, and their place where no OpenCL device is.
 *
 * @param bgr H x W, CV_8UC3.
 */
std::vector<MarkerScores> windowScores(const cv::Mat& bgr, const MarkerNetwork& network);

/** Whether a window may show a marker at the first look. @param cells, first as in haarFeatures(). */
bool passesGate(const cv::Mat& cells, const cv::Point& first, const FeedForward& gate);

}  // namespace omr

#endif
