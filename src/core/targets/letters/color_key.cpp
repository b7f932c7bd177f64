#include "color_key.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "letter_costs.h"
#include "possible_whites.h"

namespace omr
{
namespace
{
constexpr double OTHER_WAY_COST = 3;    // of another way of measuring than the first
constexpr double SAME_AS_NEIGHBOR = 8;  // cost of a boundary between equal letters
constexpr double HAZE_COST = 4;         // of a haze as bright as the white
constexpr double THICKEST_VEIL = .4;    // with the haze: behind a thicker one hues are too faint
const std::array<double, 14> HAZES = {0, .03, .07, .12, .2, .3, .45, .6, .68, .74, .79, .83, .87, .9};

constexpr double MIN_MARGIN = 1.5;          // between the best explanation and the best with another letter
constexpr double EXPLAINED = .8;            // cost a ring below which no other way of measuring is tried
constexpr double UNEXPLAINED_MEDIAN = 2.5;  // of the rings' costs: no key explains the whole
// The same of rings that lie close to circles, each of which any other letter would explain far worse: in 1040 drawn
// and 65 path-traced scenes and the evaluation 5 targets and 30 letters more, none of them wrong.
constexpr double UNEXPLAINED_CLEAR_MEDIAN = 3.5;
constexpr double CLEAR_MARGIN = 6;
// Of rings that are certain. Mixtures of two rings that the blur merges come near to several letters.
constexpr double CERTAIN_MARGIN = 5;
constexpr double CERTAIN_COST = 4;  // most, of a ring
constexpr double CERTAIN_HAZE = .2;
// Cost of a ring that no letter explains. Grey, which a black disk shows below gloss, costs 5.9 as a green.
constexpr double UNEXPLAINED = 5;

/** What the best explanation costs the rings that are seen. */
struct RingCosts
{
  double median = 0;
  double largest = 0;
  double least_margin = std::numeric_limits<double>::infinity();  ///< of their letters
};

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

  RingCosts costs() const
  {
    RingCosts costs;
    std::vector<double> of_rings;
    for (std::size_t k = 0; k < seen_.size(); ++k)
    {
      if (seen_[k])
      {
        of_rings.push_back(costOf(k));
        costs.least_margin = std::min(costs.least_margin, marginOf(k));
      }
    }
    std::sort(of_rings.begin(), of_rings.end());
    costs.median = of_rings[of_rings.size() / 2];
    costs.largest = of_rings.back();
    return costs;
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

KeyReading readColorKey(const std::vector<ColorMeasurement>& ways, const std::vector<bool>& seen, bool is_sharp,
                        bool is_close)
{
  const std::size_t count = seen.size();
  const auto seen_count = static_cast<double>(std::count(seen.begin(), seen.end(), true));
  KeyReading reading{std::string(count, '?')};
  if (seen_count == 0)
  {
    return reading;
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
  const RingCosts costs = search.costs();
  const bool is_clear = is_close && costs.least_margin > CLEAR_MARGIN;
  const bool is_unexplained = costs.median > (is_clear ? UNEXPLAINED_CLEAR_MEDIAN : UNEXPLAINED_MEDIAN);
  for (std::size_t k = 0; k < count; ++k)
  {
    const bool readable =
        seen[k] && search.marginOf(k) >= MIN_MARGIN && search.costOf(k) <= UNEXPLAINED && !is_unexplained;
    reading.letters[k] = readable ? LETTER[best.letters[k]] : '?';
  }
  const auto read_count =
      count - static_cast<std::size_t>(std::count(reading.letters.begin(), reading.letters.end(), '?'));
  reading.is_certain = static_cast<double>(read_count) == seen_count && best.haze <= CERTAIN_HAZE &&
                       costs.least_margin > CERTAIN_MARGIN && costs.largest < CERTAIN_COST;
  return reading;
}

}  // namespace omr
