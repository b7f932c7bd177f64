#ifndef OUTDOOR_OMR_REFERENCE_FILL_H
#define OUTDOOR_OMR_REFERENCE_FILL_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"

namespace omr
{
/**
 * The fill pipeline in plain C++: the oracle of the device code, and what runs where there is no OpenCL device.
 */

/**
 * Prefilter (paper, section 4.1), borders replicated.
 *
 * @param bgr  H x W, CV_8UC3.
 * @param size 3 or 5 [px]; ignored by Filter::none.
 * @throws std::invalid_argument for another type, an empty image or another size.
 */
cv::Mat filterImage(const cv::Mat& bgr, Filter filter, int size);

/** Where edges begin; grey levels of the 3x3 Sobel response, which is 8 times the slope per pixel, at most 2040. */
struct EdgeThreshold
{
  int fixed = 100;   ///< the paper's
  int floor = 2040;  ///< below `fixed`: the threshold of a tile is 0.45 of the strongest response in it and the eight
                     ///< around it, but not below the floor nor above `fixed`
};

/** Size of the tiles of an adaptive threshold [px]. */
constexpr int EDGE_TILE_WIDTH = 64;
constexpr int EDGE_TILE_HEIGHT = 16;

/** The threshold that the settings ask for. */
EdgeThreshold edgeThreshold(const Settings& settings);

/**
 * Colour Sobel edges (paper, section 3.1): the maximum over B, G and R of |gx| + |gy|, borders replicated.
 *
 * @param bgr H x W, CV_8UC3.
 * @return    H x W, CV_8UC1; 255 where the response exceeds the threshold, else 0.
 * @throws std::invalid_argument if bgr is empty or has another type.
 */
cv::Mat edgeMask(const cv::Mat& bgr, const EdgeThreshold& threshold);

/**
 * Gives every pixel the number of its contiguous colour region (paper, section 3.2).
 *
 * Two pixels share a label when steps left, right, up and down lead from one to the other without touching an edge.
 * A label is the smallest pixel index (row * W + column) of its region, so the result depends neither on the device
 * nor on the order of the work. An edge pixel keeps its own index, as in the paper's initial map.
 *
 * @param edges H x W, CV_8UC1; 0 = region, anything else = edge.
 * @return      H x W, CV_32SC1; labels in [0, H * W).
 * @throws std::invalid_argument if edges is empty, has another type or more than 2^31 - 1 pixels.
 */
cv::Mat labelRegions(const cv::Mat& edges);

/**
 * Region data (paper, Table 1) as exact sums, one record a region, ascending label.
 *
 * @param bgr    H x W, CV_8UC3: the filtered image.
 * @param edges  H x W, CV_8UC1, as labelRegions() took it.
 * @param labels H x W, CV_32SC1, as labelRegions() gave it.
 * @throws std::invalid_argument if the three do not fit together.
 */
std::vector<RegionSums> sumRegions(const cv::Mat& bgr, const cv::Mat& edges, const cv::Mat& labels);

}  // namespace omr

#endif
