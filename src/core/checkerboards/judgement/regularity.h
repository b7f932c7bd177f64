#ifndef OUTDOOR_OMR_CORE_REGULARITY_H
#define OUTDOOR_OMR_CORE_REGULARITY_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/region.h"

namespace omr
{
/**
 * The four outer squares of a board, from the centres of its regions (paper, section 3.4, steps 1 to 4): the convex
 * hull's four sharpest vertices, if opposite ones are alike.
 *
 * The paper says "too different" without a figure; 50 degrees admits every board whose squares are not foreshortened
 * beyond recognition (pose: 60 boards up to 60 degrees off the axis).
 *
 * @param centers [px], any order; under perspective black squares suffice.
 * @return        the four in the order of the hull (clockwise in the image); empty if there are not four vertices, or
 *                opposite angles differ too much.
 */
std::vector<cv::Point2f> findOuterSquares(const std::vector<cv::Point2f>& centers);

/**
 * Forecasts the centres of all squares from the four outer ones (paper, section 3.4.1), by the homography through them.
 * It is exact for flat boards seen without distortion.
 *
 * @param outer  centres of the four outer squares, from findOuterSquares() [px].
 * @param places their columns x and rows y on the board, in the same order. Where a corner square is hidden or melts
 *               into the margin, its neighbour stands in for it.
 * @return       rows * cols centres, row by row; empty if three of the four lie on one line.
 * @throws std::invalid_argument unless there are four of each, and rows and cols are at least 2.
 */
std::vector<cv::Point2f> forecastSquares(const std::vector<cv::Point2f>& outer, const std::vector<cv::Point>& places,
                                         int rows, int cols);

/** Which forecast squares are there. */
struct Regularity
{
  std::vector<bool> seen;  ///< one a forecast square, row by row
  int claimed_twice = 0;   ///< places that two regions claim
  double share = 0;        ///< of the squares that are seen [0, 1]
};

/**
 * Regularity analysis (paper, sections 3.4 and 3.4.1): the regions on the board, their hull, the four outer squares,
 * the forecast of all others, and which of these are there.
 *
 * The published text lost the steps of section 3.4.1; these were decided anew. A region claims a forecast place when
 * its centre lies within a quarter of the square's shorter diagonal of it and its area is between a sixth of the
 * square's and the whole of it, a fifth more for rounding. Places without a region are holes: something hides them. A
 * place claimed twice is refused, that is not seen: a shadow's edge may split a square, but two squares in one place
 * mean another lattice. A square of the rim that melts into the margin, one region with it, is told by its grey.
 *
 * A homography does not bend: on a curved plate the forecast of the four outer squares loses the squares between them.
 * There the centres between the inner corners, which follow the plate, are the forecast that finds more.
 *
 * @param quads   corners of each square, four a square, in the order of its outline, row by row: 4 * rows * cols [px].
 * @param regions of the fill pipeline.
 * @param grey    the same image, CV_8UC1.
 * @throws std::invalid_argument if the number of quads is another, or there are fewer than 2 rows or columns.
 */
Regularity checkRegularity(const std::vector<cv::Point2f>& quads, int rows, int cols, const RegionMap& regions,
                           const cv::Mat& grey);

}  // namespace omr

#endif
