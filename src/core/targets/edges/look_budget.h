#ifndef OUTDOOR_OMR_CORE_LOOK_BUDGET_H
#define OUTDOOR_OMR_CORE_LOOK_BUDGET_H

#include <cstddef>
#include <opencv2/core.hpp>

namespace omr
{
/** Looks at edgels (EdgelMap::looks()) that a search in an image may take. */
std::size_t allowedLooks(const cv::Size& image_size);

// Shares of them that may be spent when a step ends, in the order of the steps. In 40 pictures of clutter families take
// up to .67 in all, and the whole search 1.01, but for round spots, whose growths are few and bounded.
constexpr double FAMILIES_SHARE = .4;  ///< for each family of arcs, as they grow side by side
constexpr double PIECES_SHARE = .8;    ///< pieces with many votes
constexpr double ROUND_SHARE = .95;    ///< round seeds

std::size_t sharedLooks(const cv::Size& image_size, double share);

}  // namespace omr

#endif
