#include "narrow_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ink_fit.h"
#include "letter_costs.h"
#include "targets/boundaries/ring_samples.h"

namespace omr
{
namespace
{
// Of 300 drawn targets with rings of 2.5 to 5.2 px in photographs, blurred, mosaiced and coded as JPEG, 194 instead of
// 179 are found, of them 187 instead of 155 with the right number of rings; of 600 others 454 instead of 406, 433
// instead of 363.
constexpr std::size_t MOST_NARROW_RINGS = 9;
constexpr double RING_COST = 6;    // of a ring, in the unit of the rest
constexpr double WIDTH_COST = 10;  // of unequal widths
constexpr double NARROWEST = 1.9;  // ring [px]
// Likewise where a ring is the white, which is not seen pure in a narrower one: at 1.9 px 10 of 485 targets of the
// field are found more, 2 of them with another number of rings, and 7 letters are wrong.
constexpr double NARROWEST_ON_DARK = 2.5;
constexpr double LETTER_MARGIN = 3;
constexpr double COUNT_MARGIN = 3;
// Of a ring: with 8 of 300 targets 6 less are read. A letter of two circles and a map's sign of three have 12 and more.
constexpr double MOST_REST = 10;
// What the ink of a single ring leaves that any colour in its place would not: of 2600 letters in 800 drawn scenes 7
// that are right leave more, and 4 of the 7 that are wrong.
constexpr double MOST_RING_REST = 15;
// Haze explains what white rings between the others would, and a drawn screw on beige with a rest of 6 for each of four
// rings. In 400 drawn scenes 67 of the 68 readings behind haze that leave less than this are right.
constexpr double MOST_HAZY_REST = 5;
constexpr double HAZE_COST = 10;  // of haze, in the unit of the rest
constexpr std::size_t MOST_ADDED = 2;
constexpr std::size_t LEAST_RINGS = 3;
constexpr std::array<double, 3> SPLITS = {.4, .5, .6};  // of a ring's width

using Radii = std::vector<double>;

/** Rings of equal width, as many as were found to MOST_ADDED more. */
std::vector<Radii> equalRings(const Radii& found, double narrowest)
{
  const double outermost = found.back();
  const std::size_t most = std::min(found.size() + MOST_ADDED, MOST_NARROW_RINGS);
  std::vector<Radii> sets;
  for (std::size_t count = std::max(LEAST_RINGS, found.size());
       count <= most && outermost > static_cast<double>(count) * narrowest; ++count)
  {
    Radii radii;
    for (std::size_t k = 1; k <= count; ++k)
    {
      radii.push_back(outermost * static_cast<double>(k) / static_cast<double>(count));
    }
    sets.push_back(radii);
  }
  return sets;
}

/** The same with a boundary more or less. */
std::vector<Radii> amended(const Radii& radii, double narrowest)
{
  std::vector<Radii> sets;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const auto place = static_cast<std::ptrdiff_t>(k);
    const double inner = k > 0 ? radii[k - 1] : 0;
    const double width = radii[k] - inner;
    if (width > 2 * narrowest && radii.size() < MOST_NARROW_RINGS)
    {
      for (const double split : SPLITS)
      {
        sets.push_back(radii);
        sets.back().insert(sets.back().begin() + place, inner + split * width);
      }
    }
    if (radii.size() > LEAST_RINGS && k + 1 < radii.size())
    {
      sets.push_back(radii);
      sets.back().erase(sets.back().begin() + place);
    }
  }
  return sets;
}

/** Sum of the squared deviations of the logarithms of the widths. */
double unevenness(const Radii& radii)
{
  double sum = 0;
  double squares = 0;
  double inner = 0;
  for (const double radius : radii)
  {
    const double logarithm = std::log(radius - inner);
    sum += logarithm;
    squares += logarithm * logarithm;
    inner = radius;
  }
  return squares - sum * sum / static_cast<double>(radii.size());
}

double costOf(double rest, const Radii& radii)
{
  return rest + RING_COST * static_cast<double>(radii.size()) + WIDTH_COST * unevenness(radii);
}
}  // namespace

bool readNarrowRings(const RingProfile& profile, const std::vector<double>& found, double scale, Ground ground,
                     NarrowRings& rings)
{
  const std::vector<cv::Vec3d> samples = medianSamples(profile, found);
  if (samples.empty())
  {
    return false;
  }
  InkFit fit(samples, profile.step, scale, ground);
  const double narrowest = (fit.isOnWhite() ? NARROWEST : NARROWEST_ON_DARK) * scale;
  if (!fit.isOnWhite() && narrowestRing(found) < narrowest)
  {
    return false;
  }
  std::vector<Radii> sets = equalRings(found, narrowest);
  sets.push_back(found);
  fit.chooseBlur(sets);
  const std::vector<Radii> others = amended(found, narrowest);
  sets.insert(sets.end(), others.begin(), others.end());

  std::array<double, MOST_NARROW_RINGS + 2> least_of_count;
  least_of_count.fill(std::numeric_limits<double>::infinity());
  InkFit::Result best;
  double least = std::numeric_limits<double>::infinity();
  for (const Radii& radii : sets)
  {
    InkFit::Result result = fit.explain(radii);
    const double cost = costOf(result.rest, radii);
    double& of_count = least_of_count[std::min(radii.size(), MOST_NARROW_RINGS + 1)];
    of_count = std::min(of_count, cost);
    if (cost < least)
    {
      least = cost;
      best = std::move(result);
      rings.radii = radii;
    }
  }
  least_of_count[std::min(rings.radii.size(), MOST_NARROW_RINGS + 1)] = std::numeric_limits<double>::infinity();
  double margin = *std::min_element(least_of_count.begin(), least_of_count.end()) - least;
  bool is_veiled = false;
  if (costOf(0, found) + HAZE_COST < least)  // else haze explains no more, whatever it leaves
  {
    InkFit::Result veiled = fit.explainInHaze(found);
    is_veiled = costOf(veiled.rest, found) + HAZE_COST < least;
    if (is_veiled)
    {
      best = std::move(veiled);
      rings.radii = found;
      margin = std::numeric_limits<double>::infinity();
    }
  }
  const InkFit::Doubts doubts = fit.doubts(rings.radii, best);
  rings.rests = doubts.excesses;
  rings.letters.clear();
  for (std::size_t k = 0; k < rings.radii.size(); ++k)
  {
    const bool is_told = doubts.margins[k] > LETTER_MARGIN && rings.rests[k] < MOST_RING_REST;
    rings.letters += is_told ? LETTER[best.letters[k]] : '?';
  }
  const bool is_read = !is_veiled || rings.letters.find('?') == std::string::npos;
  const double most_rest = is_veiled ? MOST_HAZY_REST : MOST_REST;
  return is_read && best.rest < most_rest * static_cast<double>(rings.radii.size()) && margin > COUNT_MARGIN;
}

}  // namespace omr
