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
 * The network's scores of all windows, level by level, row by row; -1 where a window has too little contrast. Plain
 * C++: the oracle of kernels/network.cl, and its place where no OpenCL device is.
 *
 * @param bgr H x W, CV_8UC3.
 */
std::vector<MarkerScores> windowScores(const cv::Mat& bgr, const MarkerNetwork& network);

}  // namespace omr

#endif
