#ifndef OUTDOOR_OMR_CORE_BENT_REFINEMENT_H
#define OUTDOOR_OMR_CORE_BENT_REFINEMENT_H

#include <vector>

#include "ring_refinement.h"

namespace omr
{
/**
 * Finds out how the sheet may be bent on which the points lie: of axes in all directions the one that fits best.
 *
 * @param family, radii the plane sheet that fits best; receive the bent one.
 * @return              false, with nothing changed, if there is no plausible bend.
 */
bool findBend(const std::vector<BoundaryPoint>& points, RingFamily& family, std::vector<double>& radii);

/** refineFamily() of a bent family. */
double refineBentFamily(const std::vector<BoundaryPoint>& points, RingFamily& family, std::vector<double>& radii);

}  // namespace omr

#endif
