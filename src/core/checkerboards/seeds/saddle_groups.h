#ifndef OUTDOOR_OMR_CORE_SADDLE_GROUPS_H
#define OUTDOOR_OMR_CORE_SADDLE_GROUPS_H

#include <vector>

#include "groups.h"
#include "outdoor_omr/frame.h"
#include "search_map.h"

namespace omr
{
/**
 * Seeds for what regions do not give: squares under 6 px, whose edges fill them, and blurred or faint boards. Three
 * saddle points, one with two of its neighbours, make a frame when the squares between them alternate.
 *
 * @param level    of the pyramid.
 * @param faint    whether boards of a few grey levels are wanted as well, as haze leaves them.
 * @param open     where seeds are wanted.
 * @return         highest rank first.
 */
std::vector<Seed> groupSaddlePoints(const Frame& frame, int level, bool faint, const SearchMap& open);

}  // namespace omr

#endif
