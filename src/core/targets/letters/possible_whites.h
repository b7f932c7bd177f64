#ifndef OUTDOOR_OMR_CORE_POSSIBLE_WHITES_H
#define OUTDOOR_OMR_CORE_POSSIBLE_WHITES_H

#include <vector>

#include "color_key.h"

namespace omr
{
/** A white to judge by, and what it costs to assume it. */
struct White
{
  LinearColor color;
  double cost = 0;
};

/**
 * What is around the rings, under up to twice its light, each of the rings, and neutral ones that are seen nowhere.
 *
 * @param seen of each ring, whether its colour counts.
 */
std::vector<White> possibleWhites(const std::vector<LinearColor>& rings, const std::vector<bool>& seen,
                                  const LinearColor& around);

/** Cost of rings that are brighter than the white: nothing is much brighter. */
double excessCost(const std::vector<LinearColor>& rings, const std::vector<bool>& seen, const LinearColor& white);

/**
 * Shares of the white that a haze hides in each channel: as the white is tinted, and neutral. Behind a warm light's
 * haze red rings were P: of these pictures 12 targets more and 47 letters, as many wrong.
 */
std::vector<LinearColor> hazesOf(double level, const White& white);

}  // namespace omr

#endif
