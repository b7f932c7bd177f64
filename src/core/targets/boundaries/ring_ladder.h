#ifndef OUTDOOR_OMR_CORE_RING_LADDER_H
#define OUTDOOR_OMR_CORE_RING_LADDER_H

#include <vector>

#include "ring_boundaries.h"

namespace omr
{
/**
 * Adds boundaries that are hidden in most directions. Where all rings but one are equally wide and that one is twice or
 * three times as wide, the places of the boundaries that it may contain are known, so that a few directions suffice.
 * Where an occluder or the blur may hide them entirely, they are added as not shown.
 *
 * @param boundaries of the profile; receives the hidden ones.
 * @param radii      the same boundaries after the last refinement [px]; receives the hidden ones.
 */
void addHiddenBoundaries(const RingProfile& profile, const AngularSupport& support, std::vector<Boundary>& boundaries,
                         std::vector<double>& radii);

/**
 * Adds boundaries inside the outermost one that show in few directions, but there clearly: what covers the others hides
 * them there.
 */
void addPartialBoundaries(const RingProfile& profile, const AngularSupport& support, std::vector<Boundary>& boundaries,
                          std::vector<double>& radii);

}  // namespace omr

#endif
