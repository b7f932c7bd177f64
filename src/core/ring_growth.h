#ifndef OUTDOOR_OMR_CORE_RING_GROWTH_H
#define OUTDOOR_OMR_CORE_RING_GROWTH_H

#include <cstdint>
#include <vector>

#include "edgels.h"
#include "ring_family.h"

namespace outdoor_omr
{
/** A set of concentric boundaries. */
struct Rings
{
  RingFamily family;
  std::vector<double> radii;  ///< on the family's plane, ascending [px]
  double rms = 0;             ///< distance of the edgels to their boundaries [px]
};

/** Directions into which angular support is divided. */
constexpr int ANGLE_BINS = 64;

/** An edgel whose gradient points along the family's radius. */
struct RadialEdgel
{
  cv::Point2f position;  ///< [px]
  float radius = 0;      ///< on the family's plane [px]
  bool brighter_outside = false;
  std::uint64_t bins = 0;  ///< directions that a pixel there covers
};

/**
 * Edgels up to a radius whose gradient runs along the radius.
 *
 * @param min_cosine of the angle between gradient and radius, either sign.
 * @param edgels     receives them; its memory is reused.
 */
void collectRadialEdgels(EdgelMap& map, const RingFamily& family, double max_radius, double min_cosine,
                         std::vector<RadialEdgel>& edgels);

/** Share of the directions in which an edgel of the more frequent sign lies within a tolerance of the circle [0, 1]. */
double angularSupport(const std::vector<RadialEdgel>& edgels, double radius, double tolerance);

/**
 * Refines rings with the edgels near their boundaries.
 *
 * @param gate largest distance of an edgel [px]; also at most 0.45 of the distance to the next boundary.
 * @return     false, with rings unchanged, when no plausible family fits.
 */
bool refineRings(EdgelMap& map, double gate, bool perspective, Rings& rings);

/**
 * Grows a family from the boundaries in its reach outwards and inwards: each new boundary sharpens the family, which
 * then predicts further ones.
 *
 * @param rings family: the start; radii: a boundary to start from, or empty. Receives all boundaries found.
 * @param reach how far to look first [px].
 * @return      false when the edgels show no two concentric boundaries.
 */
bool growRings(EdgelMap& map, double reach, Rings& rings);

}  // namespace outdoor_omr

#endif
