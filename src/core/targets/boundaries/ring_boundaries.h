#ifndef OUTDOOR_OMR_CORE_RING_BOUNDARIES_H
#define OUTDOOR_OMR_CORE_RING_BOUNDARIES_H

#include <cstddef>
#include <vector>

#include "ring_profile.h"
#include "targets/family/radial_edgels.h"

namespace omr
{
/** A circle on which the colour steps by the same amount in (nearly) all directions. */
struct Boundary
{
  double radius = 0;        ///< [px]
  LogColor change;          ///< median colour step from the ring inside to what is outside it
  double contrast = 0;      ///< length of that step
  double coherence = 0;     ///< |sum of the steps| / sum of |steps| over the directions with an edge [0, 1]
  double agreement = 0;     ///< share of the directions whose step resembles the median and lies at the radius [0, 1]
  AngleBins seen = 0;       ///< directions that lie inside the image
  AngleBins agreeing = 0;   ///< directions that agree
  AngleBins supported = 0;  ///< directions with an edgel
  bool shown = true;        ///< false: assumed where equal rings would have one
};

/** How far from its boundary an edge may be [px]. */
double edgeTolerance(double radius);

/** Their radii [px]. */
std::vector<double> radiiOf(const std::vector<Boundary>& boundaries);

/**
 * Measures the step between two rings in all directions.
 *
 * @param radii of all boundaries, ascending [px].
 * @param k     index of the boundary.
 */
Boundary measureBoundary(const RingProfile& profile, const AngularSupport& support, const std::vector<double>& radii,
                         std::size_t k);

/**
 * The boundaries between rings of any width: the fewest that explain the profile. A shadow's edge, a scratch or a
 * texture steps in some directions only, an overshoot has the same colour on both sides; neither is a boundary.
 *
 * @param support edgels of the profile's family: a boundary that is hidden in most directions is measured in those in
 *                which it has an edge.
 * @param known   radii at which a boundary may be, beside those at which the profile has a median slope [px].
 */
std::vector<Boundary> findBoundaries(const RingProfile& profile, const AngularSupport& support,
                                     const std::vector<double>& known);

}  // namespace omr

#endif
