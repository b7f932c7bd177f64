#ifndef OUTDOOR_OMR_CORE_ARC_SEEDS_H
#define OUTDOOR_OMR_CORE_ARC_SEEDS_H

#include <vector>

#include "outdoor_omr/region.h"
#include "ring_seeds.h"
#include "targets/edges/edgels.h"

namespace omr
{
/**
 * Regions that may be sectors or arcs of a ring, as a shadow's edge or an occluder leaves them; the largest first.
 */
std::vector<const Region*> findPieces(const std::vector<Region>& regions);

/**
 * Family of concentric circles from the edges of a piece and its surroundings, without saying which edge belongs to
 * which circle: all circles of a family share centre and shape, so four edgels of any of them determine it (RANSAC).
 *
 * @param votes receives the share of the edges that the family explains, weighted by the directions they cover [0, 1].
 * @return      false if the edges are straight or no family explains enough of them.
 */
bool findArcSeed(EdgelMap& map, const Region& piece, RingSeed& seed, double& votes);

}  // namespace omr

#endif
