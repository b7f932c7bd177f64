#include "color_key.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "letter_costs.h"

namespace omr
{
namespace
{
constexpr double OTHER_WAY_COST = 3;     // of another way of measuring than the first
constexpr double SAME_AS_NEIGHBOR = 8;   // cost of a boundary between equal letters
constexpr double EXCESS_DEVIATION = .3;  // of the logarithm: gloss and uneven light
constexpr double FREE_WHITE_COST = 3;    // of a white that is seen nowhere
// From the level of the brightest ring up to 4 times as bright: blue and green alone show a third of the white.
constexpr int FREE_WHITES = 5;
constexpr double FREE_WHITE_RATIO = 1.4;
// Light on the rings, relative to that on what is around them, of which shadows may cover a part: in 1040 drawn and 65
// path-traced scenes and the evaluation 28 targets more and 149 letters, and 14 wrong ones instead of 17.
constexpr std::array<double, 4> LIGHTS = {1.25, 1.4, 1.6, 2};
constexpr double LIGHT_DEVIATION = .5;  // of the logarithm
constexpr double HAZE_COST = 4;         // of a haze as bright as the white
constexpr double THICKEST_VEIL = .4;    // with the haze: behind a thicker one hues are too faint
const std::array<double, 14> HAZES = {0, .03, .07, .12, .2, .3, .45, .6, .68, .74, .79, .83, .87, .9};

constexpr double MIN_MARGIN = 1.5;          // between the best explanation and the best with another letter
constexpr double EXPLAINED = .8;            // cost a ring below which no other way of measuring is tried
constexpr double UNEXPLAINED_MEDIAN = 2.5;  // of the rings' costs: no key explains the whole
constexpr double THICK_HAZE = .4;
constexpr double UNEXPLAINED_IN_HAZE = 3;  // cost of the whole a ring, through a thick haze
// Cost of a ring that no letter explains. Grey, which a black disk shows below gloss, costs 5.9 as a green.
constexpr double UNEXPLAINED = 5;

/** One way to see all rings. */
struct Explanation
{
  double cost = std::numeric_limits<double>::infinity();
  std::vector<int> letters;
  double haze = 0;
};

/** Cheapest sequence in which neighbours differ (Viterbi); at ring `fixed`, letter `banned` is not allowed. */
Explanation cheapest(const std::vector<Costs>& costs, std::size_t fixed, int banned)
{
  const std::size_t count = costs.size();
  std::vector<Costs> total(count);
  std::vector<std::array<int, LETTERS>> previous(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    for (int letter = 0; letter < LETTERS; ++letter)
    {
      double best = k == 0 ? 0 : std::numeric_limits<double>::infinity();
      for (int inner = 0; k > 0 && inner < LETTERS; ++inner)
      {
        const double candidate = total[k - 1][inner] + (inner == letter ? SAME_AS_NEIGHBOR : 0);
        if (candidate < best)
        {
          best = candidate;
          previous[k][letter] = inner;
        }
      }
      total[k][letter] = best + (k == fixed && letter == banned ? 1e6 : costs[k][letter]);
    }
  }
  Explanation explanation;
  int letter = static_cast<int>(std::min_element(total.back().begin(), total.back().end()) - total.back().begin());
  explanation.cost = total.back()[letter];
  explanation.letters.resize(count);
  for (std::size_t k = count; k-- > 0;)
  {
    explanation.letters[k] = letter;
    letter = previous[k][letter];
  }
  return explanation;
}

/** A white to judge by, and what it costs to assume it. */
struct White
{
  LinearColor color;
  double cost = 0;
};

/** Nothing is much brighter than white. */
double excessCost(const std::vector<LinearColor>& rings, const std::vector<bool>& seen, const LinearColor& white)
{
  double cost = 0;
  for (std::size_t k = 0; k < rings.size(); ++k)
  {
    if (!seen[k])
    {
      continue;
    }
    const LinearColor& ring = rings[k];
    const double ratio = std::max({ring[0] / white[0], ring[1] / white[1], ring[2] / white[2]});
    cost += squared(std::max(0., std::log(ratio) - EXCESS_DEVIATION) / EXCESS_DEVIATION);
  }
  return cost;
}

std::vector<White> possibleWhites(const std::vector<LinearColor>& rings, const std::vector<bool>& seen,
                                  const LinearColor& around)
{
  std::vector<White> whites = {{around, tintCost(around)}};
  for (const double light : LIGHTS)
  {
    whites.push_back({light * around, tintCost(around) + squared(std::log(light) / LIGHT_DEVIATION)});
  }
  // A ring that is alone would be as white as itself.
  const bool is_one_of_several = std::count(seen.begin(), seen.end(), true) > 1;
  double brightest = 0;
  for (std::size_t k = 0; k < rings.size(); ++k)
  {
    if (seen[k])
    {
      if (is_one_of_several)
      {
        whites.push_back({rings[k], tintCost(rings[k])});
      }
      brightest = std::max({brightest, rings[k][0], rings[k][1], rings[k][2]});
    }
  }
  double level = brightest;
  for (int i = 0; i < FREE_WHITES; ++i)
  {
    whites.push_back({LinearColor::all(level), FREE_WHITE_COST});
    level *= FREE_WHITE_RATIO;
  }
  return whites;
}

/**
 * Shares of the white that a haze hides in each channel: as the white is tinted, and neutral. Behind a warm light's
 * haze red rings were P: of these pictures 12 targets more and 47 letters, as many wrong.
 */
std::vector<LinearColor> hazesOf(double level, const White& white)
{
  constexpr double MOST = .95;
  std::vector<LinearColor> hazes = {LinearColor::all(level)};
  if (level > 0)
  {
    const double grey = (white.color[0] + white.color[1] + white.color[2]) / 3;
    hazes.emplace_back();
    for (int c = 0; c < 3; ++c)
    {
      hazes.back()[c] = std::min(MOST, level * grey / white.color[c]);
    }
  }
  return hazes;
}

/** Tries whites and hazes, and keeps what explains the rings best, and what gives them other letters. */
class KeySearch
{
 public:
  /** @param seen of each ring, whether its colour counts. @param thickest_veil of gloss and haze on a ring. */
  KeySearch(const std::vector<bool>& seen, double thickest_veil)
      : seen_(seen), thickest_veil_(thickest_veil), alternatives_(seen.size())
  {
    for (Costs& alternative : alternatives_)
    {
      alternative.fill(std::numeric_limits<double>::infinity());
    }
  }

  /** @param rings colours. @param around what is around them. @param way_cost of measuring them so. */
  void explain(const std::vector<LinearColor>& rings, const LinearColor& around, double way_cost)
  {
    for (const White& white : possibleWhites(rings, seen_, around))
    {
      const double excess = way_cost + excessCost(rings, seen_, white.color);
      for (const double level : HAZES)
      {
        const double assumed = white.cost + excess + HAZE_COST * level;
        if (assumed > best_.cost + MIN_MARGIN)
        {
          break;  // nor with a thicker haze: no letter that is chosen or in doubt comes from here
        }
        for (const LinearColor& haze : hazesOf(level, white))
        {
          explain(rings, white, haze, level, assumed);
        }
      }
    }
  }

  const Explanation& best() const
  {
    return best_;
  }

  /** Cost of the best explanation's letter for ring k alone. */
  double costOf(std::size_t k) const
  {
    return best_costs_[k][best_.letters[k]];
  }

  /** How much more it costs to give ring k another letter. */
  double marginOf(std::size_t k) const
  {
    double second = std::numeric_limits<double>::infinity();
    for (int letter = 0; letter < LETTERS; ++letter)
    {
      second = letter == best_.letters[k] ? second : std::min(second, alternatives_[k][letter]);
    }
    return second - best_.cost;
  }

 private:
  void explain(const std::vector<LinearColor>& rings, const White& white, const LinearColor& haze, double level,
               double assumed)
  {
    std::vector<Costs> costs;
    costs.reserve(rings.size());
    for (std::size_t k = 0; k < rings.size(); ++k)
    {
      costs.push_back(seen_[k] ? letterCosts(rings[k], white.color, haze, thickest_veil_ - level) : Costs{});
    }
    Explanation explanation = cheapest(costs, rings.size(), 0);
    if (explanation.cost + assumed > best_.cost + MIN_MARGIN)
    {
      return;  // no letter that is chosen or in doubt comes from here
    }
    for (std::size_t k = 0; k < rings.size(); ++k)
    {
      const int letter = explanation.letters[k];
      alternatives_[k][letter] = std::min(alternatives_[k][letter], explanation.cost + assumed);
      const Explanation other = cheapest(costs, k, letter);
      alternatives_[k][other.letters[k]] = std::min(alternatives_[k][other.letters[k]], other.cost + assumed);
    }
    explanation.cost += assumed;
    explanation.haze = level;
    if (explanation.cost < best_.cost)
    {
      best_ = explanation;
      best_costs_ = costs;
    }
  }

  const std::vector<bool>& seen_;
  double thickest_veil_;
  Explanation best_;
  std::vector<Costs> best_costs_;
  std::vector<Costs> alternatives_;  // cheapest explanation that gives a ring a letter
};
}  // namespace

double linearLight(double grey_level)
{
  const double value = std::clamp(grey_level / 255, 0., 1.);
  return value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
}

std::string readColorKey(const std::vector<ColorMeasurement>& ways, const std::vector<bool>& seen, bool is_sharp)
{
  const std::size_t count = seen.size();
  const auto seen_count = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  std::string key(count, '?');
  if (seen_count == 0)
  {
    return key;
  }
  KeySearch search(seen, is_sharp ? THICKEST_VEIL : 0);
  double way_cost = 0;
  for (const ColorMeasurement& measure : ways)
  {
    if (search.best().cost < EXPLAINED * seen_count)
    {
      break;
    }
    std::vector<LinearColor> rings = measure();
    if (rings.empty())
    {
      continue;
    }
    const LinearColor around = rings.back();
    rings.pop_back();
    search.explain(rings, around, way_cost);
    way_cost = OTHER_WAY_COST;
  }
  const Explanation& best = search.best();
  std::vector<double> ring_costs;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (seen[k])
    {
      ring_costs.push_back(search.costOf(k));
    }
  }
  std::sort(ring_costs.begin(), ring_costs.end());
  const bool is_unexplained = ring_costs[ring_costs.size() / 2] > UNEXPLAINED_MEDIAN ||
                              (best.haze > THICK_HAZE && best.cost > UNEXPLAINED_IN_HAZE * seen_count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool readable =
        seen[k] && search.marginOf(k) >= MIN_MARGIN && search.costOf(k) <= UNEXPLAINED && !is_unexplained;
    key[k] = readable ? LETTER[best.letters[k]] : '?';
  }
  return key;
}

}  // namespace omr
