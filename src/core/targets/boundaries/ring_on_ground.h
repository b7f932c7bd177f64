#ifndef OUTDOOR_OMR_CORE_RING_ON_GROUND_H
#define OUTDOOR_OMR_CORE_RING_ON_GROUND_H

#include <vector>

#include "ring_profile.h"

namespace omr
{
/**
 * Whether what follows the outermost ring, where that is no white sheet, ends on a circle, however faintly: then it is
 * a further ring, which the ground resembles, and the number of rings is not known.
 *
 * @param radii of the boundaries, ascending, not empty [px of the profile].
 * @param contrast of the outermost [logarithms].
 * @param scale pixels of the profile a pixel of the image.
 */
bool resemblesGround(const RingProfile& profile, const std::vector<double>& radii, double contrast, int scale);

}  // namespace omr

#endif
