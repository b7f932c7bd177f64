#ifndef OUTDOOR_OMR_SETTINGS_H
#define OUTDOOR_OMR_SETTINGS_H

#include <string>
#include <vector>

namespace omr
{
/** Prefilter of the fill pipeline (paper, Table 2: the factor "algorithm filter"). */
enum class Filter
{
  none,
  gaussian,
  median
};

/** How the threshold of the edges is chosen. */
enum class EdgeThresholdMethod
{
  fixed,    ///< one for the image (paper, section 3.1)
  adaptive  ///< lower where the surroundings are faint
};

/** How contiguous regions get their labels; the labels are identical. */
enum class FillMethod
{
  runs,  ///< union-find on runs of non-edge pixels
  sweep  ///< the paper's four directional sweeps (section 3.2)
};

/** What becomes of the preliminary detection (paper, section 4.5). */
enum class CandidateMode
{
  none,
  all,     ///< candidates are reported; those not read are looked at enlarged
  enlarge  ///< they are only looked at; candidates are not reported
};

/**
 * Every tunable of the detector, with its default. The list, with unit, bounds and meaning, is settings.def.
 */
struct Settings
{
#define OMR_BOOL(name, value, group, description) bool name = value;
#define OMR_INT(name, value, min, max, group, unit, description) int name = value;
#define OMR_DOUBLE(name, value, min, max, group, unit, description) double name = value;
#define OMR_CHOICE(name, type, value, values, group, description) type name = type::value;
#include "outdoor_omr/settings.def"
#undef OMR_BOOL
#undef OMR_INT
#undef OMR_DOUBLE
#undef OMR_CHOICE

  /** @throws std::invalid_argument naming the tunable, its value and its bounds, when one is out of bounds. */
  void check() const;
};

/** What settings.def says of one tunable. */
struct Parameter
{
  std::string name;
  std::string type;  ///< "bool", "int", "double" or "choice"
  std::string group;
  std::string unit;  ///< empty for bool and choice
  std::string description;
  double min = 0;                    ///< int and double only
  double max = 0;                    ///< int and double only
  std::vector<std::string> choices;  ///< choice only, in the order of the enum
};

/** All tunables in the order of settings.def. */
const std::vector<Parameter>& parameters();

/** The known name (at least one) that a mistyped name is nearest to: fewest letters inserted, deleted or replaced. */
std::string nearestName(const std::string& name, const std::vector<std::string>& known);

/**
 * Sets one tunable from text, as the command line and yaml files give it.
 *
 * @param name  a name of settings.def.
 * @param value a number, "true"/"false", or a choice's word.
 * @throws std::invalid_argument for an unknown name (the message lists near names), text that is no such value, or a
 *         value out of bounds; settings is then unchanged.
 */
void setParameter(Settings& settings, const std::string& name, const std::string& value);

/** The value of one tunable as text that setParameter() reads back. @throws std::invalid_argument for an unknown name.
 */
std::string getParameter(const Settings& settings, const std::string& name);

/**
 * Reads tunables from a yaml file: a map of name: value.
 *
 * @throws std::invalid_argument naming file, line and key for anything that setParameter() refuses, and for a
 *         name that stands there twice;
 *         std::runtime_error when the file cannot be read.
 */
void loadSettings(Settings& settings, const std::string& file);

}  // namespace omr

#endif
