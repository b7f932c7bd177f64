#ifndef OUTDOOR_OMR_CORE_RADIAL_MODEL_H
#define OUTDOOR_OMR_CORE_RADIAL_MODEL_H

#include <opencv2/core.hpp>

#include "checkerboards/corners/local_frame.h"

namespace omr
{
class Lattice;

/**
 * A flat board seen through a wide lens: a homography, then the division model of radial distortion (Fitzgibbon 2001,
 * "Simultaneous linear estimation of multiple view geometry and lens distortion") around the middle of the picture. One
 * number more than a homography, so it says where the next corner is where polynomials run away: squares of a fisheye
 * shrink to a third within a board.
 */
class RadialModel
{
 public:
  /** @param picture its size. @return false where the corners are too few, or do not lie so. */
  bool fit(const Lattice& lattice, const cv::Size& picture);

  /** Around a node of the lattice. @return false beyond what the lens shows. */
  bool frameAt(int row, int col, LocalFrame& frame) const;

 private:
  cv::Point2d place(int row, int col) const;
  bool at(int row, int col, cv::Point2d& position) const;

  cv::Matx33d homography_ = cv::Matx33d::eye();  // from place() to the undistorted picture
  cv::Point2d center_;                           // of the picture [px]
  double radius_ = 1;                            // from there to the picture's corner [px]
  double distortion_ = 0;                        // [1 / radius^2]
  double row_ = 0, col_ = 0, scale_ = 1;         // of the lattice's box
};

}  // namespace omr

#endif
