#ifndef OUTDOOR_OMR_CORE_CHECKERBOARDS_H
#define OUTDOOR_OMR_CORE_CHECKERBOARDS_H

#include <functional>
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
 * @param use_first if given, receives the boards that the regions gave, once, before more are searched where no region
 *                  is a square. Mostly these are all, as they will be returned: in 72 of 72 pictures of the paper's
 *                  experiment, 4 of 5 photographs, 3 of 5 pictures of distant boards.
 * @param sections  if given, receives what may be a section of a board that is hidden beyond, of any size and with
 *                  size_certain false: no board by itself, but see locateParts().
 */
std::vector<Checkerboard> findCheckerboards(
    const Frame& frame, const RegionMap& regions, const Settings& settings,
    const std::function<void(const std::vector<Checkerboard>&)>& use_first = nullptr,
    std::vector<Checkerboard>* sections = nullptr);

}  // namespace omr

#endif
