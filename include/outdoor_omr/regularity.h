#ifndef OUTDOOR_OMR_REGULARITY_H
#define OUTDOOR_OMR_REGULARITY_H

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
 * It is exact for flat boards seen without distortion; the detector itself forecasts from the corners it found.
 *
 * @param outer four centres in the order top left, top right, bottom right, bottom left of the board [px].
 * @return      rows * cols centres, row by row.
 * @throws std::invalid_argument unless outer has four points and rows and cols are at least 2.
 */
std::vector<cv::Point2f> forecastSquares(const std::vector<cv::Point2f>& outer, int rows, int cols);

/** Which forecast squares are there. */
struct Regularity
{
  std::vector<bool> seen;  ///< one a forecast square, row by row
  int claimed_twice = 0;   ///< places that two regions claim
  double share = 0;        ///< of the squares that are seen [0, 1]
};

/**
 * Regularity analysis (paper, section 3.4.1): every region near a forecast centre claims that place.
 *
 * The published text lost the steps of this section; these were decided anew. A region claims the nearest place when
 * its centre lies within a quarter of the square's diagonal of it and its area is between a sixth of the square's and
 * the whole of it, twice for rounding. Places without a region are holes: the squares of the rim that melt into the
 * margin, and those that something hides. A place claimed twice counts as not seen: a shadow's edge may split a
 * square, but two squares in one place mean another lattice.
 *
 * @param quads   corners of each forecast square, four a square, in the order of its outline [px].
 * @param regions of the fill pipeline.
 */
Regularity checkRegularity(const std::vector<cv::Point2f>& quads, const RegionMap& regions);

}  // namespace omr

#endif
