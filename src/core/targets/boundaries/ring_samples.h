#ifndef OUTDOOR_OMR_CORE_RING_SAMPLES_H
#define OUTDOOR_OMR_CORE_RING_SAMPLES_H

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "ring_profile.h"

namespace omr
{
constexpr std::array<float, 3> GREY_WEIGHTS = {.114F, .587F, .299F};  ///< of B, G, R in the brightness

/** Brightness, and the differences of red and blue to it: what cameras blur alike. @param bgr B, G, R [0, 255] */
cv::Vec3d toHue(const cv::Vec3d& bgr);

/** B, G, R of brightness and hue. */
cv::Vec3d fromHue(const cv::Vec3d& hue);

/**
 * Brightness and hue along a ray: medians over the directions at each radius, from the centre to a little beyond the
 * outermost boundary.
 *
 * @param radii of the boundaries, ascending, not empty [px].
 */
std::vector<cv::Vec3d> medianSamples(const RingProfile& profile, const std::vector<double>& radii);

}  // namespace omr

#endif
