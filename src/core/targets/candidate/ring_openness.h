#ifndef OUTDOOR_OMR_CORE_RING_OPENNESS_H
#define OUTDOOR_OMR_CORE_RING_OPENNESS_H

#include "ring_growth.h"

namespace omr
{
/**
 * Directions in which most of the boundaries have an edge where they should be: what covers a target hides several of
 * them at once.
 *
 * @param rings with at least one radius.
 */
AngleBins openDirections(EdgelMap& map, const Rings& rings);

}  // namespace omr

#endif
