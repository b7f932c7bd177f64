#ifndef OUTDOOR_OMR_CORE_TARGET_PAIR_H
#define OUTDOOR_OMR_CORE_TARGET_PAIR_H

#include "outdoor_omr/camera.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/pose.h"
#include "outdoor_omr/target.h"

namespace omr
{
/**
 * Where a part has a target and where it was seen. Of a target in the plane of a flat board that is the ellipse of its
 * outermost ring, whose centre is far better than the centre of the circles: that one is extrapolated from ring to
 * ring, without a word of the camera. Which way such a target faces is known; of another it is not, and the centre has
 * to do, as it has where the pixels do not place the rings.
 */
PointPair targetPair(const Part& part, const PartTarget& target, const Target& seen, const Camera& camera);

}  // namespace omr

#endif
