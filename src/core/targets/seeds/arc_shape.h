#ifndef OUTDOOR_OMR_CORE_ARC_SHAPE_H
#define OUTDOOR_OMR_CORE_ARC_SHAPE_H

#include <opencv2/core.hpp>

#include "targets/edges/edgels.h"
#include "targets/family/ring_family.h"

namespace omr
{
/** Coefficients s11, s12, s22, d1, d2 of concentric circles' image: level sets of p^T S p - 2 d^T p. */
using ShapeVector = cv::Vec<double, 5>;
using ShapeMatrix = cv::Matx<double, 5, 5>;
/** Of a symmetric matrix the upper triangle, row by row. */
using ShapeTriangle = cv::Vec<double, 15>;

/**
 * Sums over edgels that say how well any family of concentric circles fits them: with the coefficients s of the family,
 * s^T M s is a sum of squares. So a family is fitted to, and compared with, arcs at the cost of one edgel each.
 */
struct ArcSums
{
  double count = 0;
  ShapeTriangle direction;  ///< of the sine between normal and radius x half the levels' gradient
  ShapeTriangle level;      ///< of the levels' deviations from their mean
  ShapeTriangle gradient;   ///< of half the levels' gradient
  ShapeVector mean_level = ShapeVector::all(0);

  /** Adds an edgel; close() ends the adding. */
  void add(const Edgel& edgel);
  void close();

  /** Mean square of the sine between normal and radius. */
  double squaredSine(const ShapeVector& shape) const;

  /** Mean square of the distance to the circle [px^2]. */
  double squaredDistance(const ShapeVector& shape) const;
};

/** Of two arcs of a family, each on a circle of its own. */
ArcSums sumOf(const ArcSums& left, const ArcSums& right);

/** Of two arcs of one circle. */
ArcSums joined(const ArcSums& left, const ArcSums& right);

/**
 * The family without perspective that fits best.
 *
 * @param origin, scale place and size of the arcs, for the sake of rounding [px].
 * @param shape         receives its coefficients.
 * @return              false if it is no ellipses' or a far too oblique one.
 */
bool fitShape(const ArcSums& sums, const cv::Point2d& origin, double scale, ShapeVector& shape, RingFamily& family);

/** Radius on the family's plane of the circle that an arc lies on [px]. */
double radiusOf(const ArcSums& sums, const ShapeVector& shape, const RingFamily& family);

}  // namespace omr

#endif
