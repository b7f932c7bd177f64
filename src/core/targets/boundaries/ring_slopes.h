#ifndef OUTDOOR_OMR_CORE_RING_SLOPES_H
#define OUTDOOR_OMR_CORE_RING_SLOPES_H

#include <vector>

#include "ring_profile.h"

namespace omr
{
/**
 * Radii at which the colour changes fastest: maxima of the median slope over all directions, as a length over the
 * channels, ascending [px]. Two that change different channels are apart even where no valley lies between them.
 */
std::vector<double> steepestRadii(const RingProfile& profile);

}  // namespace omr

#endif
