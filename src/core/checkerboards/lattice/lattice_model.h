#ifndef OUTDOOR_OMR_CORE_LATTICE_MODEL_H
#define OUTDOOR_OMR_CORE_LATTICE_MODEL_H

#include <opencv2/core.hpp>
#include <vector>

#include "checkerboards/corners/local_frame.h"
#include "lattice.h"

namespace omr
{
/**
 * One smooth surface through all corners of a lattice: a homography, and a polynomial for what lens and curved plate
 * add to it. Corners that do not fit count little, so it tells them apart.
 */
class LatticeModel
{
 public:
  /** Polynomial terms beside the homography. */
  enum Terms
  {
    homography = 0,
    robust_homography = 1,  ///< the same with outliers re-weighted; not for few corners: it leaves out good ones
    quadratic = 6,
    cubic = 10,
    quartic = 15
  };

  /**
   * @param ridge pulls the polynomial towards none; more where little data supports it.
   * @return false if the corners span no homography.
   */
  bool fit(const Lattice& lattice, Terms terms, double ridge);

  /**
   * Cubic, or quartic where that leaves fewer outliers: perspective and a lens together
   * bend a board near the picture's corner more than cubics can follow, and its outermost corners would count as false
   * (2 of 54 on most photographs of OpenCV's calibration example, up to 4 px off).
   */
  bool fitSmooth(const Lattice& lattice, double ridge);

  /** Position of a node or between nodes [px]. */
  cv::Point2f at(double row, double col) const;

  LocalFrame frameAt(double row, double col) const;

  /** Root mean square of the residuals, outliers counting little [px]. */
  double rms() const
  {
    return rms_;
  }

  /** Whether a corner with this residual [px] is none of the surface's. */
  bool isOutlier(double residual) const;

  /** Median residual [px]. */
  double median() const
  {
    return median_;
  }

 private:
  static constexpr int MAX_TERMS = 15;

  /** A node in the coordinates of the fit: the box spans [-1, 1]. */
  cv::Point2d place(double row, double col) const;
  cv::Point2f at(const cv::Point2d& place) const;
  static void features(const cv::Point2d& place, double (&values)[MAX_TERMS]);
  bool fitPolynomial(const std::vector<cv::Point2d>& places, const std::vector<cv::Point2d>& positions,
                     const std::vector<double>& weights, double ridge);

  cv::Matx33d homography_ = cv::Matx33d::eye();  // from place() to pixels
  cv::Point2d coefficients_[MAX_TERMS];
  int terms_ = 0;
  double row_ = 0, col_ = 0, half_height_ = 1, half_width_ = 1;  // of the box
  double rms_ = 0;
  double median_ = 0;
  int outliers_ = 0;
};

}  // namespace omr

#endif
