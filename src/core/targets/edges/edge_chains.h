#ifndef OUTDOOR_OMR_CORE_EDGE_CHAINS_H
#define OUTDOOR_OMR_CORE_EDGE_CHAINS_H

#include <cstddef>
#include <vector>

#include "edgels.h"

namespace omr
{
/** Edgels along edges, one chain after the other. */
struct Chains
{
  std::vector<const Edgel*> edgels;
  std::vector<std::size_t> ends;  // of each chain
  std::vector<int> index;         // memory: the edgel in each pixel that has one
};

/** All edgels of an image. */
void edgelsOf(EdgelMap& map, const cv::Size& size, std::vector<Edgel>& edgels);

/**
 * Follows edgels along edges, each edgel on one chain; short chains are left out.
 *
 * @param edgels must outlive the chains.
 * @param size   of their image.
 */
void followEdges(const std::vector<Edgel>& edgels, const cv::Size& size, Chains& chains);

}  // namespace omr

#endif
