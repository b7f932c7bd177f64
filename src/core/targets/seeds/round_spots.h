#ifndef OUTDOOR_OMR_CORE_ROUND_SPOTS_H
#define OUTDOOR_OMR_CORE_ROUND_SPOTS_H

#include <opencv2/core.hpp>
#include <vector>

namespace omr
{
/** A small place where the grey values change towards or away from one point, in all directions. */
struct RoundSpot
{
  cv::Point2d center;    ///< which the gradients point to or from [px]
  double deviation = 0;  ///< mean square of the sine between gradient and radius; texture has .5
  /** Share of the rarer kind of edges, of those where the grey values rise and fall away from the centre [0, .5]. */
  double other_kind = 0;
};

/**
 * Finds small round patterns without regions or edges: rings of 2 to 4 px leave neither. Where the gradients' tensor in
 * a window is strong in all directions, the point that the gradients point to best follows from their sums (Foerstner
 * and Guelch, 1987).
 *
 * @param grey H x W, CV_8UC1.
 * @return     the roundest first; one a place.
 */
std::vector<RoundSpot> findRoundSpots(const cv::Mat& grey);

}  // namespace omr

#endif
