#include "possible_whites.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "letter_costs.h"

namespace omr
{
namespace
{
constexpr double EXCESS_DEVIATION = .3;  // of the logarithm: gloss and uneven light
constexpr double FREE_WHITE_COST = 3;    // of a white that is seen nowhere
// From the level of the brightest ring up to 4 times as bright: blue and green alone show a third of the white.
constexpr int FREE_WHITES = 5;
constexpr double FREE_WHITE_RATIO = 1.4;
// Light on the rings, relative to that on what is around them, of which shadows may cover a part: in 1040 drawn and 65
// path-traced scenes and the evaluation 28 targets more and 149 letters, and 14 wrong ones instead of 17.
constexpr std::array<double, 4> LIGHTS = {1.25, 1.4, 1.6, 2};
constexpr double LIGHT_DEVIATION = .5;  // of the logarithm
}  // namespace

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

}  // namespace omr
