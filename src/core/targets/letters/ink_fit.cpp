#include "ink_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "color_key.h"
#include "letter_costs.h"
#include "targets/boundaries/ring_samples.h"

namespace omr
{
namespace
{
// Deviations of the blur, of brightness and of hue, which colour filter and JPEG widen [px].
constexpr std::array<double, 4> BRIGHTNESS_BLUR = {1, .6, 1.4, 2};
constexpr std::array<double, 4> HUE_BLUR = {2, 1.2, 2.8, .7};
// Brightness of a ring that is taken for white instead of what is around, relative to that, at least.
constexpr double BRIGHTER = 1.6;
constexpr std::array<double, 4> HAZE = {.15, .3, .45, .6};  // share of white in each ink

using Inks = std::array<cv::Vec3d, LETTERS>;

/** Inverse of linearLight(). */
double greyLevelOf(double light)
{
  light = std::clamp(light, 0., 1.);
  return 255 * (light <= .0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - .055);
}

/** Red, green and blue in linear light, not below the noise. */
LinearColor lightOf(const cv::Vec3d& bgr)
{
  return LinearColor(linearLight(bgr[2]), linearLight(bgr[1]), linearLight(bgr[0])) + LinearColor::all(DARKEST_LIGHT);
}

/** What is around, or the brightest ring where that is brighter: on dark ground it is the white one. */
cv::Vec3d whiteOf(const std::vector<cv::Vec3d>& samples, Ground ground)
{
  const auto brightest = std::max_element(samples.begin(), samples.end(),
                                          [](const cv::Vec3d& a, const cv::Vec3d& b) { return a[0] < b[0]; });
  return ground == Ground::any && (*brightest)[0] > BRIGHTER * samples.back()[0] ? *brightest : samples.back();
}

Inks inksUnder(const cv::Vec3d& white_bgr, double haze)
{
  Inks inks;
  for (int letter = 0; letter < LETTERS; ++letter)
  {
    cv::Vec3d bgr;
    for (int c = 0; c < 3; ++c)
    {
      bgr[c] = greyLevelOf(linearLight(white_bgr[c]) * (haze + (1 - haze) * REFLECTANCE[letter][2 - c]));
    }
    inks[letter] = toHue(bgr);
  }
  return inks;
}

/** Of the inks next to the rings' colours those of which neighbours differ. */
std::vector<int> nearestLetters(const Inks& inks, const std::vector<cv::Vec3d>& colors)
{
  std::vector<int> letters(colors.size());
  for (std::size_t k = colors.size(); k-- > 0;)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (int letter = 0; letter < LETTERS; ++letter)
    {
      const double distance = cv::norm(inks[letter] - colors[k]);
      if (distance < nearest && (k + 1 == colors.size() || letters[k + 1] != letter))
      {
        nearest = distance;
        letters[k] = letter;
      }
    }
  }
  return letters;
}
}  // namespace

/** Letters of the rings, of which neighbours differ, and the rest that they leave. */
class InkFit::Sequence
{
 public:
  Sequence(const InkRest& rest, const Inks& inks, std::vector<int> letters, const cv::Vec3d& around)
      : rest_(rest), inks_(inks), letters_(std::move(letters)), colors_(letters_.size() + 1, around)
  {
    std::transform(letters_.begin(), letters_.end(), colors_.begin(), [&](int letter) { return inks_[letter]; });
    slopes_ = rest.slopes(colors_);
  }

  /** Changes one ring or two neighbours as long as that explains more. */
  void descend()
  {
    const int count = static_cast<int>(letters_.size());
    for (bool is_better = true; is_better;)
    {
      is_better = false;
      for (int k = 0; k < count; ++k)
      {
        for (int pair = 0; pair < LETTERS * LETTERS; ++pair)
        {
          const Change change = {k > 0 ? letters_[k - 1] : NONE, pair % LETTERS, k + 1 < count ? pair / LETTERS : NONE};
          if (further(k, change) < -NOTHING)
          {
            apply(k, change);
            is_better = true;
          }
        }
      }
    }
  }

  double rest() const
  {
    return rest_.of(colors_);
  }

  const std::vector<int>& letters() const
  {
    return letters_;
  }

  /** Further rest with another letter of a ring, of each ring. */
  std::vector<double> margins() const
  {
    std::vector<double> result;
    const int count = static_cast<int>(letters_.size());
    for (int k = 0; k < count; ++k)
    {
      double least = std::numeric_limits<double>::infinity();
      for (int triple = 0; triple < LETTERS * LETTERS * LETTERS; ++triple)
      {
        const Change change = {k > 0 ? triple / LETTERS % LETTERS : NONE, triple % LETTERS,
                               k + 1 < count ? triple / LETTERS / LETTERS : NONE};
        if (change[1] != letters_[k])
        {
          least = std::min(least, further(k, change));
        }
      }
      result.push_back(least);
    }
    return result;
  }

  /** Fall of the rest if a ring had the colour that explains most, of each ring. */
  std::vector<double> excesses() const
  {
    std::vector<double> result;
    for (int k = 0; k < static_cast<int>(letters_.size()); ++k)
    {
      const cv::Vec3d square = rest_.square(k, k);
      double fall = 0;
      for (int c = 0; c < 3; ++c)
      {
        fall += slopes_[k][c] * slopes_[k][c] / square[c];
      }
      result.push_back(fall);
    }
    return result;
  }

 private:
  static constexpr int NONE = -1;  // a letter where there is no ring
  static constexpr double NOTHING = 1e-6;
  using Change = std::array<int, 3>;  // letters of a ring's inner neighbour, its own, of its outer neighbour

  /** Further rest with other letters of ring k and its neighbours; infinite where equal ones meet. */
  double further(int k, const Change& change) const
  {
    const int count = static_cast<int>(letters_.size());
    if (change[0] == change[1] || change[1] == change[2] || (k > 1 && letters_[k - 2] == change[0]) ||
        (k + 2 < count && letters_[k + 2] == change[2]))
    {
      return std::numeric_limits<double>::infinity();
    }
    double rest = 0;
    std::array<cv::Vec3d, 3> steps;
    for (int i = 0; i < 3; ++i)
    {
      const int ring = k + i - 1;
      if (change[i] == NONE || change[i] == letters_[ring])
      {
        continue;
      }
      steps[i] = inks_[change[i]] - colors_[ring];
      rest += 2 * steps[i].dot(slopes_[ring]) + steps[i].dot(steps[i].mul(rest_.square(ring, ring)));
      for (int j = k > 0 ? 0 : 1; j < i; ++j)
      {
        rest += 2 * steps[j].dot(steps[i].mul(rest_.square(ring, k + j - 1)));
      }
    }
    return rest;
  }

  void apply(int k, const Change& change)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (change[i] != NONE)
      {
        letters_[k + i - 1] = change[i];
        colors_[k + i - 1] = inks_[change[i]];
      }
    }
    slopes_ = rest_.slopes(colors_);
  }

  const InkRest& rest_;
  const Inks& inks_;
  std::vector<int> letters_;
  std::vector<cv::Vec3d> colors_;
  std::vector<cv::Vec3d> slopes_;
};

InkFit::InkFit(const std::vector<cv::Vec3d>& samples, double step, double scale, Ground ground)
    : source_{samples, step, scale, whiteOf(samples, ground)}, deviations_(BRIGHTNESS_BLUR[0], HUE_BLUR[0])
{
}

bool InkFit::isOnWhite() const
{
  return source_.white == source_.samples.back();
}

/** Calls with the rest of each blur, and its deviations. */
template <typename Call>
void InkFit::forEachBlur(const std::vector<double>& radii, const Call& call) const
{
  std::vector<InkRestPart> hues;
  hues.reserve(HUE_BLUR.size());
  for (const double of_hue : HUE_BLUR)
  {
    hues.emplace_back(source_, 1, of_hue, radii);
  }
  for (const double of_brightness : BRIGHTNESS_BLUR)
  {
    const InkRestPart brightness(source_, 0, of_brightness, radii);
    for (std::size_t i = 0; i < hues.size(); ++i)
    {
      call(InkRest(brightness, hues[i]), cv::Vec2d(of_brightness, HUE_BLUR[i]));
    }
  }
}

void InkFit::chooseBlur(const std::vector<std::vector<double>>& sets_of_radii)
{
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& radii : sets_of_radii)
  {
    forEachBlur(radii, [&](const InkRest& rest_of, const cv::Vec2d& deviations) {
      const double rest = explain(rest_of, radii, 0).rest;
      if (rest < least)
      {
        least = rest;
        deviations_ = deviations;
      }
    });
  }
}

InkFit::Result InkFit::explain(const std::vector<double>& radii) const
{
  const InkRestPart brightness(source_, 0, deviations_[0], radii);
  const InkRestPart hue(source_, 1, deviations_[1], radii);
  Result result = explain(InkRest(brightness, hue), radii, 0);
  result.deviations = deviations_;
  return result;
}

InkFit::Result InkFit::explainInHaze(const std::vector<double>& radii) const
{
  Result best;
  forEachBlur(radii, [&](const InkRest& rest_of, const cv::Vec2d& deviations) {
    for (const double haze : HAZE)
    {
      Result result = explain(rest_of, radii, haze);
      if (result.rest < best.rest)
      {
        best = std::move(result);
        best.deviations = deviations;
      }
    }
  });
  return best;
}

InkFit::Result InkFit::explain(const InkRest& rest, const std::vector<double>& radii, double haze) const
{
  std::vector<cv::Vec3d> middles;
  for (std::size_t k = 0; k < radii.size(); ++k)
  {
    const double middle = k == 0 ? 0 : .5 * (radii[k - 1] + radii[k]);
    middles.push_back(
        source_.samples[std::min(source_.samples.size() - 1, static_cast<std::size_t>(middle / source_.step))]);
  }
  const cv::Vec3d& around = source_.samples.back();
  const Inks inks = inksUnder(fromHue(source_.white), haze);
  Sequence sequence(rest, inks, nearestLetters(inks, middles), around);
  sequence.descend();
  return {sequence.rest() + tintCost(lightOf(fromHue(source_.white))), sequence.letters(), haze, {}};
}

InkFit::Doubts InkFit::doubts(const std::vector<double>& radii, const Result& result) const
{
  const InkRestPart brightness(source_, 0, result.deviations[0], radii);
  const InkRestPart hue(source_, 1, result.deviations[1], radii);
  const Inks inks = inksUnder(fromHue(source_.white), result.haze);
  const InkRest rest(brightness, hue);
  const Sequence sequence(rest, inks, result.letters, source_.samples.back());
  return {sequence.margins(), sequence.excesses()};
}

}  // namespace omr
