#ifndef OUTDOOR_OMR_CORE_BENT_POINT_H
#define OUTDOOR_OMR_CORE_BENT_POINT_H

#include "ring_family.h"

namespace omr
{
/** A point of a bent sheet, its image, and how that moves with it. */
struct BentPoint
{
  static constexpr double LARGEST_ANGLE = 1.4;  ///< of the bend; beyond it the sheet goes on straight [rad]

  BentPoint(const RingFamily& family, const cv::Point2d& q);

  cv::Point2d s;         ///< in the plane that touches the sheet at the centre [px]
  double z = 0;          ///< below that plane [px]
  double w = 1;          ///< 1 + h.s + hz z
  cv::Point2d offset;    ///< of the image from the centre's [px]
  cv::Matx22d jacobian;  ///< of the image by q
};

}  // namespace omr

#endif
