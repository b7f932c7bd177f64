#ifndef OUTDOOR_OMR_CORE_SMALL_RINGS_H
#define OUTDOOR_OMR_CORE_SMALL_RINGS_H

#include <opencv2/core.hpp>

#include "targets/candidate/ring_candidate.h"
#include "targets/edges/edgels.h"
#include "targets/seeds/round_spots.h"

namespace omr
{
/** Whether there are enough edges of both kinds to grow it. */
bool mayBeRings(const RoundSpot& spot);

/**
 * Grows what a round spot may be the middle of, in the image and in a twofold enlargement of its surroundings: between
 * the edges of rings of 2 to 3.5 px the image has too few pixels, of blurred ones the enlargement shows too little.
 *
 * @param map       of the image.
 * @param bgr       H x W, CV_8UC3.
 * @param candidate receives the better of the two, in pixels of the image.
 * @return          whether one of them isTarget().
 */
bool growSpot(const EdgelMap& map, const cv::Mat& bgr, const RoundSpot& spot, int min_rings, RingCandidate& candidate);

}  // namespace omr

#endif
