#ifndef OUTDOOR_OMR_CORE_RING_DEBLUR_H
#define OUTDOOR_OMR_CORE_RING_DEBLUR_H

#include <opencv2/core.hpp>
#include <vector>

#include "ring_profile.h"

namespace omr
{
/**
 * Colours of narrow rings without what the blur mixes into them: the rings of uniform colour whose blurred image fits
 * the median over all directions best. Brightness is blurred by the lens, hues far more by the camera's colour filter
 * and JPEG's subsampling.
 *
 * @param radii of the boundaries [px], not empty.
 * @return      B, G, R [0, 255] of each ring, and of what is around them.
 */
std::vector<cv::Vec3d> deblurredColors(const RingProfile& profile, const std::vector<double>& radii);

/**
 * What uniform rings leave of the profile: root mean square, relative to the strongest contrast of two neighbours.
 *
 * @param radii of the boundaries [px], not empty.
 */
double unexplained(const RingProfile& profile, const std::vector<double>& radii);

/**
 * Radius of a boundary within a ring that the blur hides: where two narrow rings of similar brightness meet, the
 * colour has no steepest place.
 *
 * @param radii of the known boundaries [px], not empty.
 * @return      0 if uniform rings explain the profile.
 */
double mergedBoundary(const RingProfile& profile, const std::vector<double>& radii);

/** A ring between two others whose boundaries the blur merges to one. */
struct SeamRing
{
  std::size_t boundary = 0;  ///< index of what is left of them
  double half_width = 0;     ///< [px]; 0: there is no such ring
};

/**
 * A ring that is no more than a seam between its neighbours, darker than both, or brighter: no mixture of them is.
 *
 * @param radii of the known boundaries [px], not empty.
 * @param whole of each, whether it shows all around: what lies across one is no ring.
 */
SeamRing seamRing(const RingProfile& profile, const std::vector<double>& radii, const std::vector<bool>& whole);

}  // namespace omr

#endif
