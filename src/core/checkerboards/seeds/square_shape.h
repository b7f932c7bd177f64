#ifndef OUTDOOR_OMR_CORE_SQUARE_SHAPE_H
#define OUTDOOR_OMR_CORE_SQUARE_SHAPE_H

#include <algorithm>
#include <opencv2/core.hpp>

#include "checkerboards/lattice/lattice.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** How far a square reaches from its centre, of the ways to its corners and to the middles of its sides: 1 of sharp
 * squares, less of dark ones where light spills over. Dots reach 0.71 times as far towards the corners. */
struct SquareReach
{
  float corner = 0;
  float side = 0;

  float shape() const
  {
    return corner / std::max(1e-3F, side);
  }
};

/**
 * Measures a square.
 *
 * @param grey          CV_8UC1.
 * @param center        of the square, inside the picture or not [px].
 * @param first, second from the centre to the next squares of its colour, with which it shares corners [px].
 * @param threshold     between dark and light [grey levels].
 * @param is_dark       whether it is the dark squares' colour.
 * @return              means over the four corners and the four sides, which end at the next squares' middles: [0, 1]
 * and [0, 2].
 */
SquareReach reachOfSquare(const cv::Mat& grey, const cv::Point2f& center, const cv::Point2f& first,
                          const cv::Point2f& second, float threshold, bool is_dark);

/** Whether what lies between the corners of a lattice, dark or light, are dots and no squares: round, and ending before
 * the corners. Dots of a calibration grid for circles lie as a board's squares do, and nearly touch. */
bool isOfDots(const Frame& frame, const Lattice& lattice);

}  // namespace omr

#endif
