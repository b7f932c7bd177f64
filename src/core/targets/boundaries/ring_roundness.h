#ifndef OUTDOOR_OMR_CORE_RING_ROUNDNESS_H
#define OUTDOOR_OMR_CORE_RING_ROUNDNESS_H

#include <vector>

#include "ring_boundaries.h"

namespace omr
{
/**
 * How much rounder the outermost boundary is than a square sheet's edge, which resembles a circle in half of the
 * directions in which the rings are seen. Below 1: it may be such an edge.
 *
 * @param boundaries at least two, ascending.
 * @param support    the edgels that they were measured with.
 */
double roundness(const std::vector<Boundary>& boundaries, const AngularSupport& support);

}  // namespace omr

#endif
