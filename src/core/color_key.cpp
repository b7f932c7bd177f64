#include "color_key.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace omr
{
namespace
{
constexpr int LETTERS = 5;
constexpr std::array<char, LETTERS> LETTER = {'W', 'P', 'R', 'G', 'B'};

// Reflectance relative to the paper (red, green, blue): medians over prints and renders, spread .25 of the logarithm.
const std::array<LinearColor, LETTERS> REFLECTANCE = {LinearColor(1, 1, 1), LinearColor(.069, .068, .07),
                                                      LinearColor(.66, .062, .055), LinearColor(.053, .33, .095),
                                                      LinearColor(.06, .09, .38)};

constexpr double DARKEST = .055;   // ink; cameras that clip the blacks show less
constexpr double FLOOR = .03;      // of the white: glare and noise hide darker differences
constexpr double DEVIATION = .45;  // of the logarithm of the reflectance
constexpr double LARGEST_COST = 16;
constexpr double SAME_AS_NEIGHBOR = 8;   // cost of a boundary between equal letters
constexpr double TINT_DEVIATION = .35;   // of the logarithm of white's red and blue over green
constexpr double EXCESS_DEVIATION = .3;  // of the logarithm: gloss and uneven light
constexpr double FREE_WHITE_COST = 3;    // of a white that is seen nowhere
// From the level of the brightest ring up to 4 times as bright: blue and green alone show a third of the white.
constexpr int FREE_WHITES = 5;
constexpr double FREE_WHITE_RATIO = 1.4;
constexpr double HAZE_COST = 4;  // of a haze as bright as the white
const std::array<double, 7> HAZES = {0, .03, .07, .12, .2, .3, .45};

constexpr double MIN_MARGIN = 1.5;  // between the best explanation and the best with another letter
constexpr double UNEXPLAINED = 7;   // cost of a ring that no letter explains

using Costs = std::array<double, LETTERS>;

double squared(double value)
{
  return value * value;
}

Costs letterCosts(const LinearColor& ring, const LinearColor& white, double haze)
{
  Costs costs{};
  for (int letter = 0; letter < LETTERS; ++letter)
  {
    for (int c = 0; c < 3; ++c)
    {
      // Without haze a black may be deeper than ink; through haze nothing looks darker than the haze itself.
      const double reflectance = std::max(haze > 0 ? 0 : DARKEST, (ring[c] / white[c] - haze) / (1 - haze));
      costs[letter] += squared((std::log(reflectance + FLOOR) - std::log(REFLECTANCE[letter][c] + FLOOR)) / DEVIATION);
    }
    costs[letter] = std::min(costs[letter], LARGEST_COST);
  }
  return costs;
}

/** One way to see all rings. */
struct Explanation
{
  double cost = std::numeric_limits<double>::infinity();
  std::vector<int> letters;
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

double tintCost(const LinearColor& color)
{
  return squared(std::log(color[0] / color[1]) / TINT_DEVIATION) +
         squared(std::log(color[2] / color[1]) / TINT_DEVIATION);
}

/** Nothing is much brighter than white. */
double excessCost(const std::vector<LinearColor>& rings, const LinearColor& white)
{
  double cost = 0;
  for (const LinearColor& ring : rings)
  {
    const double ratio = std::max({ring[0] / white[0], ring[1] / white[1], ring[2] / white[2]});
    cost += squared(std::max(0., std::log(ratio) - EXCESS_DEVIATION) / EXCESS_DEVIATION);
  }
  return cost;
}

std::vector<White> possibleWhites(const std::vector<LinearColor>& rings, const LinearColor& around)
{
  std::vector<White> whites = {{around, tintCost(around)}};
  double brightest = 0;
  for (const LinearColor& ring : rings)
  {
    whites.push_back({ring, tintCost(ring)});
    brightest = std::max({brightest, ring[0], ring[1], ring[2]});
  }
  double level = brightest;
  for (int i = 0; i < FREE_WHITES; ++i)
  {
    whites.push_back({LinearColor::all(level), FREE_WHITE_COST});
    level *= FREE_WHITE_RATIO;
  }
  return whites;
}
}  // namespace

double linearLight(double grey_level)
{
  const double value = std::clamp(grey_level / 255, 0., 1.);
  return value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
}

std::string readColorKey(const std::vector<LinearColor>& rings, const LinearColor& around)
{
  if (rings.empty())
  {
    return "";
  }
  Explanation best;
  std::vector<Costs> alternatives(rings.size());  // cheapest explanation that gives a ring a letter
  for (Costs& costs : alternatives)
  {
    costs.fill(std::numeric_limits<double>::infinity());
  }
  std::vector<Costs> best_costs;
  for (const White& white : possibleWhites(rings, around))
  {
    for (const double haze : HAZES)
    {
      std::vector<Costs> costs;
      costs.reserve(rings.size());
      for (const LinearColor& ring : rings)
      {
        costs.push_back(letterCosts(ring, white.color, haze));
      }
      const double assumed = white.cost + excessCost(rings, white.color) + HAZE_COST * haze;
      Explanation explanation = cheapest(costs, rings.size(), 0);
      for (std::size_t k = 0; k < rings.size(); ++k)
      {
        const int letter = explanation.letters[k];
        alternatives[k][letter] = std::min(alternatives[k][letter], explanation.cost + assumed);
        const Explanation other = cheapest(costs, k, letter);
        alternatives[k][other.letters[k]] = std::min(alternatives[k][other.letters[k]], other.cost + assumed);
      }
      explanation.cost += assumed;
      if (explanation.cost < best.cost)
      {
        best = explanation;
        best_costs = costs;
      }
    }
  }
  std::string key;
  for (std::size_t k = 0; k < rings.size(); ++k)
  {
    const int letter = best.letters[k];
    double second = std::numeric_limits<double>::infinity();
    for (int other = 0; other < LETTERS; ++other)
    {
      second = other == letter ? second : std::min(second, alternatives[k][other]);
    }
    const bool readable = second - best.cost >= MIN_MARGIN && best_costs[k][letter] <= UNEXPLAINED;
    key += readable ? LETTER[letter] : '?';
  }
  return key;
}

}  // namespace omr
