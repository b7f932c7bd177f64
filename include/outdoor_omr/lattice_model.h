#ifndef OUTDOOR_OMR_LATTICE_MODEL_H
#define OUTDOOR_OMR_LATTICE_MODEL_H

#include <opencv2/core.hpp>
#include <vector>

#include "outdoor_omr/lattice.h"
#include "outdoor_omr/local_frame.h"

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
    quadratic = 6,
    cubic = 10,
    cubic_twisted = 12  ///< and x^3 y, x y^3
  };

  /**
   * @param ridge pulls the polynomial towards none; more where little data supports it.
   * @return false if the corners span no homography.
   */
  bool fit(const Lattice& lattice, Terms terms, double ridge);

  /** Position of a node or between nodes [px]. */
  cv::Point2f at(double row, double col) const;

  LocalFrame frameAt(double row, double col) const;

  /** Root mean square of the residuals, outliers counting little [px]. */
  double rms() const
  {
    return rms_;
  }

  /** Median residual [px]. */
  double median() const
  {
    return median_;
  }

 private:
  static constexpr int MAX_TERMS = 12;

  void features(double row, double col, double (&values)[MAX_TERMS]) const;
  bool fitPolynomial(const std::vector<cv::Point2f>& nodes, const std::vector<cv::Point2f>& positions,
                     const std::vector<double>& weights, double ridge);

  cv::Matx33d homography_ = cv::Matx33d::eye();
  cv::Point2d coefficients_[MAX_TERMS];
  int terms_ = 0;
  double row_ = 0, col_ = 0, half_height_ = 1, half_width_ = 1;  // of the box, for features of size 1
  double rms_ = 0;
  double median_ = 0;
};

}  // namespace omr

#endif
