#ifndef OUTDOOR_OMR_CORE_CORNER_RING_H
#define OUTDOOR_OMR_CORE_CORNER_RING_H

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>

#include "local_frame.h"
#include "outdoor_omr/frame.h"

namespace omr
{
/** A prediction on the level of the pyramid where its square is at most 24 px wide; squares under 5 px use the
 * unfiltered image: recall at 2.5 to 3.5 px grows from 73 to 91 % (120 boards at distance). */
struct PyramidView
{
  PyramidView(const Frame& frame, float square_height);

  float sample(const cv::Point2f& point) const
  {
    return sampleGrey(*grey, point.x * scale, point.y * scale);
  }

  const cv::Mat* grey;
  int level = 0;
  float scale = 1;  ///< pixels of the level per pixel of the full image
};

/** Quadrants around a corner, in this order: (+u +v), (-u +v), (-u -v), (+u -v). */
constexpr int QUADRANTS = 4;
constexpr std::array<float, QUADRANTS> QUADRANT_U = {1, -1, -1, 1};
constexpr std::array<float, QUADRANTS> QUADRANT_V = {1, 1, -1, -1};

/** By how much four quadrants alternate: the darkest of the light ones minus the lightest of the dark ones. @param sign
 * +1: the first is light, -1: dark. */
inline float quadrantGap(const std::array<float, QUADRANTS>& grey, int sign)
{
  return sign > 0 ? std::min(grey[0], grey[2]) - std::max(grey[1], grey[3])
                  : std::min(grey[1], grey[3]) - std::max(grey[0], grey[2]);
}

/** One sample of each quadrant. @param offset along u and v [squares]. */
inline std::array<float, QUADRANTS> sampleQuadrants(const PyramidView& view, const LocalFrame& frame, float offset)
{
  return {view.sample(frame.at(offset, offset)), view.sample(frame.at(-offset, offset)),
          view.sample(frame.at(-offset, -offset)), view.sample(frame.at(offset, -offset))};
}

constexpr float RING_SQUARE_HEIGHT = 1.5F;  ///< px, the least; the pixel grid resolves no less
constexpr float RING_GAP = 3;               ///< grey levels between light and dark quadrants, the least

constexpr int QUADRANT_SAMPLES = 6;
constexpr int RING_SAMPLES = QUADRANTS * QUADRANT_SAMPLES;

/** Grey values around a corner, quadrant by quadrant. */
using Ring = std::array<float, RING_SAMPLES>;

/**
 * Samples 25, 45 and 65 degrees from the lattice lines on two circles; at least 1 px off the lines, where edges are
 * blurred.
 *
 * @param inner_radius, outer_radius [squares].
 */
Ring sampleRing(const PyramidView& view, const LocalFrame& frame, float inner_radius, float outer_radius);

/** Mean of the two middle samples. */
float quadrantMedian(const Ring& ring, int quadrant);

/** Normalised correlation of the ring with one value a quadrant, the better of grey levels and their logarithms
 * [-1, 1]: the edge of a hard shadow multiplies grey values and does not add to them. */
float ringCorrelation(const Ring& ring, const std::array<float, QUADRANTS>& pattern);

/** Logarithm of a grey value, offset so that the noise of the darkest pixels stays small. */
float greyLogarithm(float grey);

}  // namespace omr

#endif
