#include "letter_costs.h"

#include <algorithm>
#include <cmath>

namespace omr
{
// Reflectance relative to the paper (red, green, blue): medians over prints and renders, spread .25 of the logarithm.
const std::array<LinearColor, LETTERS> REFLECTANCE = {LinearColor(1, 1, 1), LinearColor(.069, .068, .07),
                                                      LinearColor(.66, .062, .055), LinearColor(.053, .33, .095),
                                                      LinearColor(.06, .09, .38)};

namespace
{
constexpr double DARKEST = .03;         // ink; cameras that clip the blacks show less
constexpr double FLOOR = .03;           // of the white: glare and noise hide darker differences
constexpr double DEVIATION = .4;        // of the logarithm of the reflectance, its mean over the channels apart
constexpr double WHITE_DEVIATION = .2;  // the same of white, which the light tints as it tints the white of the place
constexpr double BRIGHTNESS_DEVIATION = .6;  // of that mean
constexpr double LARGEST_COST = 16;
constexpr double TINT_DEVIATION = .35;  // of the logarithm of white's red and blue over green
// Gloss lies on one ring more than on another: a neutral light that takes a hue's depth, and leaves the hue
// ("occlusion": 122 -> 130 of 141 letters).
const std::array<double, 4> VEILS = {0, .1, .2, .3};
constexpr double VEIL_COST = 10;  // of one as bright as the white
constexpr double UNVEILED = 3;    // cost below which a ring needs none

/** Logarithms of a reflectance, which tells little where it is low. */
LinearColor logarithms(const LinearColor& reflectance)
{
  return {std::log(reflectance[0] + FLOOR), std::log(reflectance[1] + FLOOR), std::log(reflectance[2] + FLOOR)};
}

std::array<LinearColor, LETTERS> logarithmsOfLetters()
{
  std::array<LinearColor, LETTERS> result;
  std::transform(REFLECTANCE.begin(), REFLECTANCE.end(), result.begin(), logarithms);
  return result;
}

/** Cost of a letter for what is seen of a ring: logarithms of the reflectance. */
double letterCost(const LinearColor& seen, int letter)
{
  static const std::array<LinearColor, LETTERS> LOGARITHMS = logarithmsOfLetters();
  const LinearColor error = seen - LOGARITHMS[letter];
  // A shadow that covers one ring more than another changes its brightness alone.
  const double brightness = (error[0] + error[1] + error[2]) / 3;
  double cost = 3 * squared(brightness / BRIGHTNESS_DEVIATION);
  for (int c = 0; c < 3; ++c)
  {
    cost += squared((error[c] - brightness) / (LETTER[letter] == 'W' ? WHITE_DEVIATION : DEVIATION));
  }
  return std::min(cost, LARGEST_COST);
}
}  // namespace

double tintCost(const LinearColor& color)
{
  return squared(std::log(color[0] / color[1]) / TINT_DEVIATION) +
         squared(std::log(color[2] / color[1]) / TINT_DEVIATION);
}

Costs letterCosts(const LinearColor& ring, const LinearColor& white, const LinearColor& haze, double thickest_veil)
{
  Costs costs;
  costs.fill(LARGEST_COST);
  for (const double veil : VEILS)
  {
    LinearColor reflectance;
    for (int c = 0; c < 3; ++c)
    {
      // Without haze a black may be deeper than ink; through haze nothing looks darker than the haze itself.
      reflectance[c] = std::max(haze[c] > 0 ? 0 : DARKEST, (ring[c] / white[c] - haze[c]) / (1 - haze[c]) - veil);
    }
    const LinearColor seen = logarithms(reflectance);
    for (int letter = 0; letter < LETTERS; ++letter)
    {
      if (veil == 0 || (LETTER[letter] != 'W' && LETTER[letter] != 'P'))
      {
        costs[letter] = std::min(costs[letter], letterCost(seen, letter) + VEIL_COST * veil);
      }
    }
    if (veil >= thickest_veil || *std::min_element(costs.begin(), costs.end()) < UNVEILED)
    {
      break;
    }
  }
  return costs;
}

}  // namespace omr
