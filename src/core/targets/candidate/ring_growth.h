#ifndef OUTDOOR_OMR_CORE_RING_GROWTH_H
#define OUTDOOR_OMR_CORE_RING_GROWTH_H

#include <vector>

#include "targets/family/radial_edgels.h"

namespace omr
{
/** A set of concentric boundaries. */
struct Rings
{
  RingFamily family;
  std::vector<double> radii;       ///< on the family's plane, ascending [px]
  double rms = 0;                  ///< distance of the edgels to their boundaries [px]
  AngleBins open = ~AngleBins{0};  ///< directions that count: in the others something hides the rings
};

/**
 * Refines rings with the edgels near their boundaries.
 *
 * @param gate largest distance of an edgel [px]; also at most 0.45 of the distance to the next boundary.
 * @return     false, with rings unchanged, when no plausible family fits.
 */
bool refineRings(EdgelMap& map, double gate, bool perspective, Rings& rings);

/**
 * Refines rings as those of a sheet that is bent like a pipe.
 *
 * @return false, with rings unchanged, when no bend fits or none fits much better than the plane.
 */
bool bendRings(EdgelMap& map, Rings& rings);

/**
 * Grows a family from the boundaries in its reach outwards and inwards: each new boundary sharpens the family, which
 * then predicts further ones.
 *
 * @param rings family: the start; radii: a boundary to start from, or empty. Receives all boundaries found.
 * @param reach how far to look first [px].
 * @return      false when the edgels show no two concentric boundaries.
 */
bool growRings(EdgelMap& map, double reach, Rings& rings);

}  // namespace omr

#endif
