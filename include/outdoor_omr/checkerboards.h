#ifndef OUTDOOR_OMR_CHECKERBOARDS_H
#define OUTDOOR_OMR_CHECKERBOARDS_H

#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"

namespace omr
{
/**
 * Finds all checkerboards of 5x7 to 21x21 squares, their size unknown beforehand (paper, section 3.4).
 *
 * @param frame    the image.
 * @param regions  its regions.
 * @param settings the tunables of group "checkerboard".
 */
std::vector<Checkerboard> findCheckerboards(const Frame& frame, const RegionMap& regions, const Settings& settings);

}  // namespace omr

#endif
