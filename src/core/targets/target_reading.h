#ifndef OUTDOOR_OMR_CORE_TARGET_READING_H
#define OUTDOOR_OMR_CORE_TARGET_READING_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/target.h"
#include "targets/candidate/ring_candidate.h"

namespace omr
{
/**
 * Reads the letters of the candidates; those that have too few for what else is known of them are no targets.
 *
 * @param bgr CV_8UC3, not filtered, to place the rings by; empty: they stay where their edgels have them.
 */
std::vector<Target> readTargets(const cv::Mat& bgr, const std::vector<RingCandidate>& candidates, int min_rings);

}  // namespace omr

#endif
