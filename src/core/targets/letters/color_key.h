#ifndef OUTDOOR_OMR_CORE_COLOR_KEY_H
#define OUTDOOR_OMR_CORE_COLOR_KEY_H

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace omr
{
/** Red, green and blue in linear light, 1 = the brightest the camera can tell. */
using LinearColor = cv::Vec3d;

constexpr double DARKEST_LIGHT = .003;  ///< linear: two grey levels in the dark, below it is noise

/** Inverse of the sRGB transfer function. @param grey_level [0, 255] */
double linearLight(double grey_level);

/**
 * Measures the rings from the inside out, as if under one light, and last what is around the outermost: paper or
 * anything else.
 */
using ColorMeasurement = std::function<std::vector<LinearColor>()>;

/** What the key tells of rings. */
struct KeyReading
{
  std::string letters;      ///< '?' for what is not known
  bool is_certain = false;  ///< whether none that is seen comes near to another letter, as mixtures of two do
};

/**
 * Reads the colours of rings by the paper's key (section 3.3): W white, P black, R red, G green, B blue, ? unknown.
 *
 * Each ring is judged relative to the white of its place, not by absolute levels, which gave the paper 83.5 %: white
 * is the surroundings, a ring, or a neutral colour of unknown brightness, whichever explains all rings best; a haze
 * that lifts all of them may be part of the explanation. Neighbours differ. A ring whose second best letter explains
 * the whole nearly as well, or which no letter explains, is '?'.
 *
 * Where the colours can be measured in several ways, the way that one key explains best decides, and a letter that
 * another way would change at little cost is '?'.
 *
 * @param ways     are taken in turn until a key explains one well: nearly always the first.
 * @param seen     of each ring: false where something hides it; it is '?' and tells nothing.
 * @param is_sharp whether the rings are too wide for the blur to pale them, so that gloss does where they are pale.
 * @param is_close whether their edges lie close to circles: their letters may explain them worse if they are clear.
 */
KeyReading readColorKey(const std::vector<ColorMeasurement>& ways, const std::vector<bool>& seen, bool is_sharp,
                        bool is_close);

}  // namespace omr

#endif
