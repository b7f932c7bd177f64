#include "corner_look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "corner_ring.h"
#include "grey_samples.h"
#include "saddle_fit.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr float MIN_GAP_SHARE = 0.15F;       // of the contrast
constexpr float MIN_CONTRAST_SHARE = 0.25F;  // of the neighbours' contrast; half of it is a shadow's edge
/** The ring's verdict on a corner of four alternating squares. */
struct Verdict
{
  int sign = 0;
  float gap = 0;  // darkest light quadrant minus lightest dark one
  float contrast = 0;
  float correlation = 0;
};

constexpr float INNER_RADIUS = 0.3F;  // squares
constexpr float OUTER_RADIUS = 0.5F;  // squares
// A saddle point that is reached only from the middle of where the ring alternates must be this clear: with 0.95 false
// ones on what covers boards (occlusion 56 -> 55 of 61).
constexpr float CLEAR_CORRELATION = 0.97F;

/** Whether all but the correlation speaks for the corner. */
bool mayAccept(const CornerQuery& query, const Verdict& verdict)
{
  return (query.sign == 0 || verdict.sign == query.sign) &&
         verdict.gap > std::max(RING_GAP, MIN_GAP_SHARE * verdict.contrast) &&
         verdict.contrast > MIN_CONTRAST_SHARE * query.contrast;
}

bool accepts(const CornerQuery& query, const Verdict& verdict)
{
  return mayAccept(query, verdict) && verdict.correlation > query.correlation;
}

/** Sign, contrast and gap of the ring. */
Verdict judgeQuadrants(const Ring& ring)
{
  std::array<float, QUADRANTS> median;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    median[q] = quadrantMedian(ring, q);
  }
  Verdict verdict;
  const float difference = (median[0] + median[2] - median[1] - median[3]) / 2;
  verdict.sign = difference > 0 ? 1 : -1;
  verdict.contrast = std::abs(difference);
  verdict.gap = quadrantGap(median, verdict.sign);
  return verdict;
}

Verdict judgeRing(const PyramidView& view, const LocalFrame& frame, const CornerQuery& query)
{
  const Ring ring = sampleRing(view, frame, INNER_RADIUS, OUTER_RADIUS);
  Verdict verdict = judgeQuadrants(ring);
  if (mayAccept(query, verdict))
  {
    const auto s = static_cast<float>(verdict.sign);
    verdict.correlation = ringCorrelation(ring, {s, -s, s, -s});
  }
  return verdict;
}

// Places around a prediction where the ring is looked at.
constexpr int STEPS = 2;  // to either side
constexpr int SIDE = 2 * STEPS + 1;
constexpr int PLACES = SIDE * SIDE;

/** Quick look before the ring: one sample a quadrant must alternate, whatever the sign. All places side by side. */
OMR_VECTORIZED void findAlternating(const PyramidView& view, const LocalFrame& local_frame,
                                    const SamplePlaces<PLACES>& places, std::array<int, PLACES>& alternates)
{
  constexpr float RADIUS = 0.3F;
  const LocalFrame frame = local_frame;
  const float scale = view.scale;
  SamplePlaces<QUADRANTS * PLACES> quadrants;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    const float u = RADIUS * QUADRANT_U[q];
    const float v = RADIUS * QUADRANT_V[q];
    for (int i = 0; i < PLACES; ++i)
    {
      // LocalFrame::at()
      quadrants.x[q * PLACES + i] = (places.x[i] + u * frame.u.x + v * frame.v.x) * scale;
      quadrants.y[q * PLACES + i] = (places.y[i] + u * frame.u.y + v * frame.v.y) * scale;
    }
  }
  std::array<float, QUADRANTS * PLACES> grey;
  sampleGreys(*view.grey, quadrants, grey);
  for (int i = 0; i < PLACES; ++i)
  {
    const float a = grey[i];
    const float b = grey[PLACES + i];
    const float c = grey[2 * PLACES + i];
    const float d = grey[3 * PLACES + i];
    alternates[i] = (std::min(a, c) > std::max(b, d)) | (std::min(b, d) > std::max(a, c)) ? 1 : 0;
  }
}

/** Where the ring alternates around a prediction too far off for the saddle fit. */
struct RingSearch
{
  bool found = false;
  cv::Point2f best;  ///< where it alternates most clearly
  cv::Point2f
      middle;  ///< of all places where it does so about as clearly: medians stay until an edge halves a quadrant
};

RingSearch searchRing(const PyramidView& view, const LocalFrame& predicted, const CornerQuery& query)
{
  constexpr float CLEAR_SHARE = 0.8F;
  SamplePlaces<PLACES> places;
  const float step = query.tolerance / STEPS;
  for (int i = 0; i < PLACES; ++i)
  {
    const int row = i / SIDE - STEPS;
    const int col = i % SIDE - STEPS;
    const cv::Point2f point = predicted.at(static_cast<float>(col) * step, static_cast<float>(row) * step);
    places.x[i] = point.x;
    places.y[i] = point.y;
  }
  const auto place = [&](std::size_t index) { return cv::Point2f(places.x[index], places.y[index]); };
  std::array<int, PLACES> alternates;
  findAlternating(view, predicted, places, alternates);
  std::array<float, PLACES> gaps = {};
  for (std::size_t i = 0; i < gaps.size(); ++i)
  {
    if (alternates[i] != 0)
    {
      LocalFrame moved = predicted;
      moved.node = place(i);
      const Verdict verdict = judgeQuadrants(sampleRing(view, moved, INNER_RADIUS, OUTER_RADIUS));
      gaps[i] = query.sign == 0 || verdict.sign == query.sign ? verdict.gap : 0;
    }
  }
  const auto best = std::max_element(gaps.begin(), gaps.end());
  cv::Point2f sum;
  float count = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i)
  {
    if (gaps[i] >= CLEAR_SHARE * *best)
    {
      sum += place(i);
      ++count;
    }
  }
  return {*best > RING_GAP, place(best - gaps.begin()), sum * (1 / count)};
}

/** Follows a saddle point found on a coarse level down to the full image. */
void refineDownwards(const Frame& frame, int level, float square_height, cv::Point2f& point)
{
  while (level-- > 0)
  {
    const float scale = 1.F / static_cast<float>(1 << level);
    cv::Point2f finer = point * scale;
    if (!fitSaddle(frame.grey[level], finer, fitRadius(square_height * scale), 0.12F * square_height * scale + 1))
    {
      return;
    }
    point = finer * (1 / scale);
  }
}
}  // namespace

CornerLooker::CornerLooker(const Frame& frame, int budget) : frame_(frame), budget_(budget)
{
}

CornerLook CornerLooker::look(const LocalFrame& predicted, const CornerQuery& query)
{
  CornerLook result;
  const float height = squareHeight(predicted);
  if (budget_ <= 0 || height < RING_SQUARE_HEIGHT || !isInside(frame_.raw_grey, predicted.node, 2))
  {
    return result;
  }
  --budget_;
  const PyramidView view(frame_, height);
  const float level_height = height * view.scale;
  const int radius = fitRadius(level_height);
  LocalFrame corner = predicted;
  Verdict verdict;
  cv::Point2f point = predicted.node * view.scale;
  bool found = fitSaddle(*view.grey, point, radius, query.tolerance * level_height + 0.5F);
  if (found)
  {
    corner.node = point * (1 / view.scale);
    verdict = judgeRing(view, corner, query);
    found = accepts(query, verdict);
  }
  const bool searched = !found;
  if (searched)
  {
    const RingSearch search = query.search ? searchRing(view, predicted, query) : RingSearch{};
    if (!search.found)
    {
      return result;
    }
    corner.node = search.best;
    const auto fit = [&](const cv::Point2f& start) {
      point = start * view.scale;
      return fitSaddle(*view.grey, point, radius, 0.2F * level_height + 0.5F);
    };
    if (fit(search.best))
    {
      corner.node = point * (1 / view.scale);
    }
    else if (fit(search.middle))
    {
      LocalFrame centred = corner;
      centred.node = point * (1 / view.scale);
      if (judgeRing(view, centred, query).correlation > CLEAR_CORRELATION)
      {
        corner = centred;
      }
    }
  }
  refineDownwards(frame_, view.level, height, corner.node);
  if (searched || view.level > 0)
  {
    verdict = judgeRing(view, corner, query);
  }
  result.position = corner.node;
  result.sign = verdict.sign;
  result.contrast = verdict.contrast;
  result.correlation = verdict.correlation;
  result.found = accepts(query, verdict) && squaresBetween(predicted, corner.node) <= query.tolerance + 0.5F / height;
  return result;
}

}  // namespace omr
