#ifndef OUTDOOR_OMR_CORE_ARC_FAMILIES_H
#define OUTDOOR_OMR_CORE_ARC_FAMILIES_H

#include <vector>

#include "edge_arcs.h"
#include "targets/family/ring_family.h"

namespace omr
{
/** Concentric circles that several arcs lie on. */
struct ArcFamily
{
  RingFamily family;          ///< without perspective
  std::vector<double> radii;  ///< of the circles, ascending [px]
  double turning = 0;         ///< of all its arcs [rad]
};

/**
 * Families of concentric circles that share centre and shape, each from arcs that no better one has: a circle that is
 * hidden in part still shows arcs, and so do those around it.
 *
 * @return the one with most arcs first.
 */
std::vector<ArcFamily> findArcFamilies(const std::vector<EdgeArc>& arcs);

}  // namespace omr

#endif
