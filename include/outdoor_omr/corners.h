#ifndef OUTDOOR_OMR_CORNERS_H
#define OUTDOOR_OMR_CORNERS_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/frame.h"
#include "outdoor_omr/lattice.h"

namespace omr
{
/**
 * The point through which the edges of the squares run (Foerstner & Guelch 1987): least squares over the gradients
 * around a corner. Only gradients near the two lattice lines and across them count, so that the edge of a shadow
 * through the corner pulls little.
 *
 * @param grey   CV_8UC1.
 * @param corner position and lattice around it [px].
 * @return       the refined position; the given one where the refinement leaves the corner or the picture.
 */
cv::Point2f refineCorner(const cv::Mat& grey, const LocalFrame& corner);

/**
 * Refines all corners of the lattice to sub-pixel accuracy, then draws them towards a smooth surface through all
 * (homography and cubic polynomial) when that explains them to within the noise: of all steps the one that gains most
 * accuracy (RMS 0.089 -> 0.058 px on 72 rendered boards).
 *
 * Nodes of the box that were not found, or whose corner the surface refutes, get the surface's position.
 *
 * @return one flag a node of the box, row by row: whether the corner was seen.
 */
std::vector<bool> refineCorners(const Frame& frame, Lattice& lattice);

}  // namespace omr

#endif
