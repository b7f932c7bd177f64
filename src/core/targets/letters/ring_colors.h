#ifndef OUTDOOR_OMR_CORE_RING_COLORS_H
#define OUTDOOR_OMR_CORE_RING_COLORS_H

#include <vector>

#include "color_key.h"
#include "targets/boundaries/ring_boundaries.h"
#include "targets/boundaries/ring_profile.h"

namespace omr
{
/**
 * Colours of the rings and, last, of what is around them, as if under one light: each follows from its neighbour by
 * the median step across their boundary, so that a shadow over part of the target cancels.
 *
 * @param boundaries of the rings: the directions in which one shows are those that tell its step.
 * @param radii      their radii on the profile's family [px], not empty.
 * @return           radii.size() + 1 colours.
 */
std::vector<LinearColor> measureRingColors(const RingProfile& profile, const std::vector<Boundary>& boundaries,
                                           const std::vector<double>& radii);

/** Part of the directions, by their brightness. */
enum class Light
{
  brightest,  ///< where a shadow leaves a part of each ring in the sun, that part tells its colour
  darkest     ///< and where gloss covers a part, the rest does
};

/** The same colours as measureRingColors() gives, from a part of the directions. */
std::vector<LinearColor> measureColorsIn(Light light, const RingProfile& profile, const std::vector<double>& radii);

}  // namespace omr

#endif
