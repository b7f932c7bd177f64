#ifndef OUTDOOR_OMR_CORE_LETTER_COSTS_H
#define OUTDOOR_OMR_CORE_LETTER_COSTS_H

#include <array>

#include "color_key.h"

namespace omr
{
constexpr int LETTERS = 5;
constexpr std::array<char, LETTERS> LETTER = {'W', 'P', 'R', 'G', 'B'};  ///< of the key

/** Reflectances of the letters' inks relative to the paper: red, green, blue. */
extern const std::array<LinearColor, LETTERS> REFLECTANCE;

/** Of each letter for one ring. */
using Costs = std::array<double, LETTERS>;

inline double squared(double value)
{
  return value * value;
}

/** Of taking a colour for white: the light has a tint. @param color positive */
double tintCost(const LinearColor& color);

/**
 * Squared deviations of a ring's colour from each letter's.
 *
 * @param white         of its place.
 * @param haze          that lies on all rings, relative to the white.
 * @param thickest_veil of gloss on this ring alone, likewise; 0 or less: none.
 */
Costs letterCosts(const LinearColor& ring, const LinearColor& white, const LinearColor& haze, double thickest_veil);

}  // namespace omr

#endif
