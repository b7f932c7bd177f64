#ifndef OUTDOOR_OMR_CORE_SOFT_TARGETS_H
#define OUTDOOR_OMR_CORE_SOFT_TARGETS_H

#include <atomic>
#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/target.h"
#include "targets/candidate/ring_candidate.h"
#include "targets/seeds/arc_families.h"

namespace omr
{
/**
 * Large targets that are so blurred or faint that only a reduced image shows their edges.
 *
 * @param bgr       H x W, CV_8UC3.
 * @param arcs      the families of its arcs, as of searchArcFamilies().
 * @param boards    what lies on them, where they show, is no target.
 * @param refused   rings that the image itself shows, but no targets: nothing that the reduction hides speaks for them.
 * @param min_rings of a target.
 * @param is_vain   if given and set, there is nothing to be found.
 * @return          those of which every letter is read.
 */
std::vector<Target> findSoftTargets(const cv::Mat& bgr, const std::vector<ArcFamily>& arcs,
                                    const std::vector<Checkerboard>& boards, const std::vector<RingCandidate>& refused,
                                    int min_rings, const std::atomic<bool>* is_vain);

}  // namespace omr

#endif
