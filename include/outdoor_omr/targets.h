#ifndef OUTDOOR_OMR_TARGETS_H
#define OUTDOOR_OMR_TARGETS_H

#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"
#include "outdoor_omr/target.h"

namespace omr
{
/**
 * Finds all targets of concentric colour rings and reads their colours (paper, section 3.3).
 *
 * @param frame    the image.
 * @param regions  its regions.
 * @param boards   its checkerboards: what lies on them is no target.
 * @param settings the tunables of group "target".
 */
std::vector<Target> findTargets(const Frame& frame, const RegionMap& regions, const std::vector<Checkerboard>& boards,
                                const Settings& settings);

}  // namespace omr

#endif
