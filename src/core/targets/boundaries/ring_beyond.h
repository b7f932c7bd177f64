#ifndef OUTDOOR_OMR_CORE_RING_BEYOND_H
#define OUTDOOR_OMR_CORE_RING_BEYOND_H

#include <vector>

#include "ring_profile.h"

namespace omr
{
/**
 * Whether what follows the outermost ring ends on a circle of its own over a long arc: then there is a further ring,
 * which something hides elsewhere or the ground resembles, and the number of rings is not known. The straight rim of a
 * sheet makes short arcs only.
 *
 * @param radii of the boundaries, ascending, not empty [px of the profile].
 * @param scale pixels of the profile a pixel of the image.
 */
bool showsArcBeyond(const RingProfile& profile, const std::vector<double>& radii, int scale);

}  // namespace omr

#endif
