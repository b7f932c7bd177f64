#include "rim_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "corner_ring.h"

namespace omr
{
namespace
{
constexpr float MAX_COLOR_DIFFERENCE = 0.08F;  // of a channel's share in the sum of the three

/** Shares of blue, green and red in their sum, at the nearest pixel, which lies in the image. */
cv::Vec3f colorShares(const cv::Mat& bgr, const cv::Point2f& point)
{
  const cv::Vec3f color = bgr.at<cv::Vec3b>(cvRound(point.y), cvRound(point.x));
  return color * (1 / std::max(1.F, color[0] + color[1] + color[2]));
}

/** Whether all quadrants but the dark one have one hue: a coloured thing over the rim is as light as the margin, but it
 * is not the margin. */
bool haveOneColor(const cv::Mat& bgr, const LocalFrame& frame, int dark)
{
  constexpr float OFFSET = 0.3F;  // squares
  cv::Vec3f least = cv::Vec3f::all(1);
  cv::Vec3f most = cv::Vec3f::all(0);
  for (int q = 0; q < QUADRANTS; ++q)
  {
    const cv::Point2f point = frame.at(OFFSET * QUADRANT_U[q], OFFSET * QUADRANT_V[q]);
    if (q == dark || !isInside(bgr, point, 0))
    {
      continue;
    }
    const cv::Vec3f shares = colorShares(bgr, point);
    for (int channel = 0; channel < 3; ++channel)
    {
      least[channel] = std::min(least[channel], shares[channel]);
      most[channel] = std::max(most[channel], shares[channel]);
    }
  }
  return cv::norm(most - least, cv::NORM_INF) < MAX_COLOR_DIFFERENCE;
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

/**
 * Whether a dark and a light square of the rim end where one plain ground begins, as they do on a board cut along its
 * squares. In logarithms as well: in a deep shadow two squares differ by few grey levels, but by as large a ratio.
 *
 * @param dark, light, first, second medians of the quadrants: two inside, two outside.
 */
bool endAtGround(float dark, float light, float first, float second)
{
  constexpr float MAX_DIFFERENCE = 0.2F;  // of the ground, in contrasts of the board
  return std::abs(first - second) < MAX_DIFFERENCE * (light - dark) &&
         std::abs(greyLogarithm(first) - greyLogarithm(second)) <
             MAX_DIFFERENCE * (greyLogarithm(light) - greyLogarithm(dark));
}

/** Unit steps in squares from a place of the rim: to its dark square along the border, and into the board. */
struct RimAxes
{
  explicit RimAxes(const RimPlace& place)
  {
    const cv::Point2f u(static_cast<float>(place.dark_u), 0);
    const cv::Point2f v(0, static_cast<float>(place.dark_v));
    along = place.along_row ? u : v;
    across = place.along_row ? v : u;
  }

  cv::Point2f along;
  cv::Point2f across;
};
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
  if (height < RING_SQUARE_HEIGHT || !isInside(frame.raw_grey, place.predicted.node, 2))
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
  const float least_gap = std::max(RING_GAP, MIN_SHARE * contrast);
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
  const RimAxes axes(place);
  const bool ends = endsAtLine(view, place.predicted, axes.along, axes.across);
  if (ends && haveOneColor(frame.bgr, place.predicted, dark))
  {
    return RimLook::outer_edge;
  }
  // The quadrants run around the node, so the light square of the rim is beside the dark one along the border.
  const int next = (dark + 1) % QUADRANTS;
  const bool next_is_inside =
      place.along_row ? QUADRANT_V[next] == QUADRANT_V[dark] : QUADRANT_U[next] == QUADRANT_U[dark];
  const float light_inside = next_is_inside ? beside_a : beside_b;
  const float dark_outside = next_is_inside ? beside_b : beside_a;
  if (light_inside - median[dark] > least_gap && endAtGround(median[dark], light_inside, dark_outside, opposite) &&
      ringCorrelation(ring, median) > MIN_CORRELATION)
  {
    return RimLook::bare_edge;
  }
  return RimLook::unclear;
}

bool marginFollows(const Frame& frame, const RimPlace& place)
{
  constexpr float MIN_EDGE = 0.4F;  // logarithm of the ratio
  constexpr float MAX_FLAT = 0.2F;
  const float height = squareHeight(place.predicted);
  const RimAxes axes(place);
  const auto at = [&](float depth) {
    const cv::Point2f offset = -0.5F * axes.along + depth * axes.across;
    return place.predicted.at(offset.x, offset.y);
  };
  if (height < RING_SQUARE_HEIGHT || !isInside(frame.raw_grey, at(-0.5F), 2) || !isInside(frame.raw_grey, at(1.5F), 2))
  {
    return false;
  }
  const PyramidView view(frame, height);
  const auto grey = [&](float depth) { return greyLogarithm(view.sample(at(depth))); };
  const float light = grey(0.5F);
  if (light - grey(1.5F) < MIN_EDGE)
  {
    return false;
  }
  const cv::Vec3f inside = colorShares(frame.bgr, at(0.5F));
  for (const float depth : {0.25F, 0.F, -0.25F, -0.5F})
  {
    if (std::abs(grey(depth) - light) > MAX_FLAT ||
        cv::norm(colorShares(frame.bgr, at(depth)) - inside, cv::NORM_INF) > MAX_COLOR_DIFFERENCE)
    {
      return false;
    }
  }
  return true;
}

}  // namespace omr
