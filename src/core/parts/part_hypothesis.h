#ifndef OUTDOOR_OMR_CORE_PART_HYPOTHESIS_H
#define OUTDOOR_OMR_CORE_PART_HYPOTHESIS_H

#include <opencv2/core/affine.hpp>
#include <vector>

#include "outdoor_omr/camera.h"
#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/parts.h"
#include "outdoor_omr/pose.h"

namespace omr
{
/** What a seen board can be: a board of a part, or a section of it, in one of the orientations its squares allow. */
struct PartHypothesis
{
  const Part* part = nullptr;
  std::size_t board = 0;         ///< which of the part's
  Pose pose;                     ///< of the part, from this board alone
  std::vector<PointPair> pairs;  ///< its seen inner corners on the part
};

/**
 * Everything that the residuals of the board's own corners leave possible.
 *
 * @param seen with at least four inner corners seen; else nothing is.
 */
std::vector<PartHypothesis> partHypotheses(const Checkerboard& seen, const std::vector<Part>& parts,
                                           const Camera& camera);

}  // namespace omr

#endif
