#include "outdoor_omr/rim_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "outdoor_omr/corner_ring.h"

namespace omr
{
namespace
{
constexpr float MIN_SQUARE_HEIGHT = 1.5F;  // px; the pixel grid resolves no less
constexpr float MIN_GAP = 3;               // grey levels between light and dark squares

/** Whether all quadrants but the dark one have one hue: a coloured thing over the rim is as light as the margin, but it
 * is not the margin. */
bool haveOneColor(const cv::Mat& bgr, const LocalFrame& frame, int dark)
{
  constexpr float OFFSET = 0.3F;           // squares
  constexpr float MAX_DIFFERENCE = 0.08F;  // of a channel's share in the sum of the three
  cv::Vec3f least = cv::Vec3f::all(1);
  cv::Vec3f most = cv::Vec3f::all(0);
  for (int q = 0; q < QUADRANTS; ++q)
  {
    const cv::Point2f point = frame.at(OFFSET * QUADRANT_U[q], OFFSET * QUADRANT_V[q]);
    const cv::Point pixel(cvRound(point.x), cvRound(point.y));
    if (q == dark || !cv::Rect(cv::Point(), bgr.size()).contains(pixel))
    {
      continue;
    }
    const cv::Vec3f color = bgr.at<cv::Vec3b>(pixel);
    const cv::Vec3f shares = color * (1 / std::max(1.F, color[0] + color[1] + color[2]));
    for (int channel = 0; channel < 3; ++channel)
    {
      least[channel] = std::min(least[channel], shares[channel]);
      most[channel] = std::max(most[channel], shares[channel]);
    }
  }
  const cv::Vec3f spread = most - least;
  return std::max({spread[0], spread[1], spread[2]}) < MAX_DIFFERENCE;
}

/**
 * Whether a dark square ends at the border line and the light one beside it does not, judged by ratios of samples close
 * to each other on both sides of the line: a shadow's edge near by does not disturb it.
 *
 * @param along, across unit steps in squares from the node: to the dark square along the border, and into the board.
 */
bool endsAtLine(const PyramidView& view, const LocalFrame& frame, const cv::Point2f& along, const cv::Point2f& across)
{
  constexpr float DEPTH = 0.2F;     // squares
  constexpr float MIN_EDGE = 0.4F;  // logarithm of the ratio
  constexpr float MAX_FLAT = 0.2F;
  const auto step = [&](float side, float depth) {
    const cv::Point2f offset = side * along + depth * across;
    return greyLogarithm(view.sample(frame.at(offset.x, offset.y)));
  };
  for (const float side : {0.25F, 0.45F})
  {
    const float dark = step(side, DEPTH);
    const float light = step(-side, DEPTH);
    if (step(side, -DEPTH) - dark < MIN_EDGE || light - dark < MIN_EDGE ||
        std::abs(step(-side, -DEPTH) - light) > MAX_FLAT)
    {
      return false;
    }
  }
  return true;
}
}  // namespace

RimLook lookAtRim(const Frame& frame, const RimPlace& place, float contrast)
{
  // Half as far out as the ring of an inner corner: a board's margin may be as narrow as half a square.
  constexpr float INNER = 0.25F;
  constexpr float OUTER = 0.4F;
  constexpr float MIN_CORRELATION = 0.9F;
  constexpr float MIN_SHARE = 0.4F;   // of the contrast
  constexpr float MAX_SPREAD = 0.4F;  // of the light squares, in contrasts
  const float height = squareHeight(place.predicted);
  if (height < MIN_SQUARE_HEIGHT || !isInside(frame.raw_grey, place.predicted.node, 2))
  {
    return RimLook::unclear;
  }
  const PyramidView view(frame, height);
  const Ring ring = sampleRing(view, place.predicted, INNER, OUTER);
  std::array<float, QUADRANTS> median;
  int dark = 0;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    median[q] = quadrantMedian(ring, q);
    dark = QUADRANT_U[q] * static_cast<float>(place.dark_u) > 0 && QUADRANT_V[q] * static_cast<float>(place.dark_v) > 0
               ? q
               : dark;
  }
  const float beside_a = median[(dark + 1) % QUADRANTS];
  const float opposite = median[(dark + 2) % QUADRANTS];
  const float beside_b = median[(dark + 3) % QUADRANTS];
  const float least_gap = std::max(MIN_GAP, MIN_SHARE * contrast);
  std::array<float, QUADRANTS> pattern = {1, 1, 1, 1};
  pattern[dark] = -1;
  const float light = std::min({beside_a, beside_b, opposite});
  if (light - median[dark] > least_gap && ringCorrelation(ring, pattern) > MIN_CORRELATION &&
      std::max({beside_a, beside_b, opposite}) - light < MAX_SPREAD * (light - median[dark]) &&
      haveOneColor(frame.bgr, place.predicted, dark))
  {
    return RimLook::outer_corner;
  }
  pattern[(dark + 2) % QUADRANTS] = -1;
  if (std::min(beside_a, beside_b) - std::max(median[dark], opposite) > least_gap &&
      ringCorrelation(ring, pattern) > MIN_CORRELATION)
  {
    return RimLook::inner_corner;
  }
  const auto u = static_cast<float>(place.dark_u);
  const auto v = static_cast<float>(place.dark_v);
  const bool ends = place.along_row ? endsAtLine(view, place.predicted, {u, 0}, {0, v})
                                    : endsAtLine(view, place.predicted, {0, v}, {u, 0});
  if (ends && haveOneColor(frame.bgr, place.predicted, dark))
  {
    return RimLook::outer_edge;
  }
  return RimLook::unclear;
}

}  // namespace omr
