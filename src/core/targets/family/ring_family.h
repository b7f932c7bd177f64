#ifndef OUTDOOR_OMR_CORE_RING_FAMILY_H
#define OUTDOOR_OMR_CORE_RING_FAMILY_H

#include <opencv2/core.hpp>

namespace omr
{
/**
 * Concentric circles of a plane as one camera sees them: one homography for all of them, so that its centre is the
 * image of the circles' centre, which the ellipses' centres are not (Jiang and Quan, ICCV 2005).
 *
 * Plane point q appears at center + A q / (1 + h.q) with the symmetric A = [a b; b d], det A = 1: radii on the plane
 * are about those in the image [px].
 *
 * The sheet may be bent like a pipe: with u = q.e across the pipe's axis and the curvature k, q moves to
 * s = q + (sin(k u) / k - u) e and z = (1 - cos(k u)) / k deep, and appears at center + (A s + w z) / (1 + h.s + hz z).
 */
struct RingFamily
{
  cv::Point2d center;          ///< [px]
  double a = 1, b = 0, d = 1;  ///< shape of small circles
  double hx = 0, hy = 0;       ///< perspective [1/px]
  cv::Point2d bend;            ///< k e; 0 for a plane sheet [1/px]
  cv::Point2d normal;          ///< w: where the sheet's normal points in the image
  double hz = 0;               ///< perspective along the normal [1/px]

  bool isBent() const
  {
    return bend.x != 0 || bend.y != 0;
  }

  cv::Point2d toImage(const cv::Point2d& q) const;
  cv::Point2d toPlane(const cv::Point2d& p) const;

  /** Longest over shortest axis of small circles, >= 1. */
  double aspect() const;

  /** Gradient of the radius over the place in the image, at the image of q. */
  cv::Point2d radiusGradient(const cv::Point2d& q) const;

  /** Half sides of a box around the image of the circle; of a plane sheet without perspective. */
  cv::Point2d halfBox(double radius) const;

  /** The circle's image, an exact ellipse on a plane sheet; size holds full axes [px], angle degrees. */
  cv::RotatedRect ellipse(double radius) const;
};

/**
 * The family whose small circles have the second moments' shape, without perspective.
 *
 * @return false if the moments are no ellipse's.
 */
bool familyFromMoments(const cv::Point2d& center, double cxx, double cxy, double cyy, RingFamily& family);

}  // namespace omr

#endif
