#ifndef OUTDOOR_OMR_CORE_LATTICE_PREDICTION_H
#define OUTDOOR_OMR_CORE_LATTICE_PREDICTION_H

#include "checkerboards/corners/local_frame.h"
#include "lattice.h"

namespace omr
{
/**
 * Where a node should be, from the corners found around it: weighted least squares in lattice coordinates, affine,
 * bilinear or quadratic as their number and spread allow: wide-angle lenses and curved plates are smooth over a few
 * squares as well. Where the lattice bends strongly, by its homography with radial distortion.
 *
 * @param window corners up to this many rows and columns away count, the node's own does not.
 * @return false if there is none, or the lattice folds over itself there.
 */
bool predictNode(const Lattice& lattice, int row, int col, int window, LocalFrame& predicted);

}  // namespace omr

#endif
