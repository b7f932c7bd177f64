#ifndef OUTDOOR_OMR_CORE_ARC_CIRCLES_H
#define OUTDOOR_OMR_CORE_ARC_CIRCLES_H

#include <utility>
#include <vector>

namespace omr
{
/** Radius [px] and turning [rad] of an arc. */
using ArcRadius = std::pair<double, double>;

/**
 * Radii of the circles that arcs of one family lie on, where they are densest: stray arcs have radii anywhere.
 *
 * @return ascending [px].
 */
std::vector<double> circlesOf(std::vector<ArcRadius> arcs);

}  // namespace omr

#endif
