#ifndef OUTDOOR_OMR_CORE_RADIAL_EDGELS_H
#define OUTDOOR_OMR_CORE_RADIAL_EDGELS_H

#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "angle_bins.h"
#include "ring_family.h"
#include "targets/edges/edgels.h"

namespace omr
{
/** An edgel whose gradient points along the family's radius. */
struct RadialEdgel
{
  cv::Point2f position;           ///< [px]
  float radius = 0;               ///< on the family's plane [px]
  bool brighter_outside = false;  ///< the sign of the gradient
  AngleBins bins = 0;             ///< directions that a pixel there covers
};

/**
 * Edgels up to a radius whose gradient runs along the radius.
 *
 * @param min_cosine of the angle between gradient and radius, either sign.
 * @param edgels     receives them; its memory is reused.
 */
void collectRadialEdgels(EdgelMap& map, const RingFamily& family, double max_radius, double min_cosine,
                         std::vector<RadialEdgel>& edgels);

/** Leaves out the edgels in other directions. */
void keepDirections(AngleBins open, std::vector<RadialEdgel>& edgels);

/** The directions in which edgels lie on circles of each radius. */
class AngularSupport
{
 public:
  static constexpr double CELL = .25;  ///< width of a histogram's cell [px]

  AngularSupport(const std::vector<RadialEdgel>& edgels, double max_radius);

  /**
   * Directions with an edgel within a tolerance of the circle, of the more frequent sign: clutter has both signs on
   * one circle, a boundary one.
   */
  AngleBins at(double radius, double tolerance) const;

  /** The same of either sign. */
  AngleBins either(double radius, double tolerance) const;

 private:
  /** By sign. */
  std::pair<AngleBins, AngleBins> apart(double radius, double tolerance) const;

  std::vector<AngleBins> brighter_, darker_;  // per cell, apart by sign
};

}  // namespace omr

#endif
