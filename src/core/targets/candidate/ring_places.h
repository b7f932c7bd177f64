#ifndef OUTDOOR_OMR_CORE_RING_PLACES_H
#define OUTDOOR_OMR_CORE_RING_PLACES_H

#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "ring_candidate.h"

namespace omr
{
/** Whether a board shows at the point: not where something lies on it, which may be a target. */
bool isOnBoard(const cv::Point2d& point, const std::vector<Checkerboard>& boards);

/** Whether a candidate that no other seed will better contains the point. */
bool isInUndisputed(const std::vector<RingCandidate>& candidates, const cv::Point2d& point);

/** Whether one of the candidates contains the point. */
bool isInAny(const std::vector<RingCandidate>& candidates, const cv::Point2d& point);

/** Whether one of the candidates contains the other's centre, or the other its centre. */
bool isInAny(const std::vector<RingCandidate>& candidates, const RingCandidate& other);

/** How much speaks for a candidate: clearness, of each of its boundaries; 0 for one that only inks may tell. */
double score(const RingCandidate& candidate);

/** Of candidates one of which contains the other's centre, the best. */
std::vector<RingCandidate> bestOfEachPlace(std::vector<RingCandidate> candidates);

}  // namespace omr

#endif
