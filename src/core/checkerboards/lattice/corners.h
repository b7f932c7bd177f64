#ifndef OUTDOOR_OMR_CORE_CORNERS_H
#define OUTDOOR_OMR_CORE_CORNERS_H

#include <opencv2/core.hpp>
#include <vector>

#include "lattice.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/**
 * Refines all corners of the lattice to sub-pixel accuracy, then draws them towards a smooth surface through all
 * (homography and cubic polynomial), the less the more alike the residuals of neighbours are: what they have in common
 * is the sheet's shape. Corners that something covers in part count little in it.
 *
 * Nodes of the box that were not found, or whose corner the surface refutes, get the surface's position; where
 * there is none, or it explains too little, that of the corners around them.
 *
 * @return one flag a node of the box, row by row: whether the corner was seen.
 */
std::vector<bool> refineCorners(const Frame& frame, Lattice& lattice);

}  // namespace omr

#endif
