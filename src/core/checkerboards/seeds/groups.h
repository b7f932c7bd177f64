#ifndef OUTDOOR_OMR_CORE_GROUPS_H
#define OUTDOOR_OMR_CORE_GROUPS_H

#include <vector>

#include "checkerboards/corners/local_frame.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/region.h"

namespace omr
{
/** A place where a corner of four squares may be, with the lattice around it. */
struct Seed
{
  LocalFrame frame;
  bool is_saddle_point = false;  ///< the node is a saddle point of the image, no estimate of one
  int rank = 0;                  ///< the more, the likelier: of regions the neighbours alike that both have, of
                                 ///< saddle points the grey levels by which the squares around alternate
};

/**
 * Pairs of neighbouring regions that are alike in size and shape and lie as diagonal neighbours on a checkerboard
 * would (paper, section 3.4: adjacent regions are grouped together).
 *
 * Under perspective a square becomes a parallelogram, whose covariance gives its axes: in the metric of that
 * covariance a diagonal neighbour is sqrt(24) away, whatever the perspective. One pair is a complete affine frame: the
 * corner between the two, and the steps to the next. Black squares alone suffice, as white ones on the rim melt into
 * the margin.
 *
 * @return highest rank first.
 */
std::vector<Seed> pairNeighbours(const Frame& frame, const RegionMap& regions);

}  // namespace omr

#endif
