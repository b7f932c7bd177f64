#ifndef OUTDOOR_OMR_CORE_RING_SEEDS_H
#define OUTDOOR_OMR_CORE_RING_SEEDS_H

#include <vector>

#include "outdoor_omr/region.h"
#include "targets/edges/edgels.h"
#include "targets/family/ring_family.h"

namespace omr
{
/** A region that may be part of a target. */
struct RingSeed
{
  RingFamily family;
  double radius = 0;  ///< of the region's outer boundary [px]
};

/** Whether area, moments and box are a parallelogram's, such as a checkerboard's squares, rather than an ellipse's. */
bool isParallelogram(const Region& region);

/**
 * Regions that are elliptic disks or annuli by their area, second moments and box (paper, section 3.3: which regions
 * are circular is decided from the region data). The smallest first: a target grows from its inside, and costs less so.
 */
std::vector<RingSeed> findRoundSeeds(const std::vector<Region>& regions);

}  // namespace omr

#endif
