#include "outdoor_omr/corner_look.h"

#include <algorithm>
#include <cmath>

#include "outdoor_omr/corner_ring.h"
#include "saddle_fit.h"

namespace omr
{
namespace
{
constexpr float MIN_SQUARE_HEIGHT = 1.5F;    // px; the pixel grid resolves no less
constexpr float MIN_GAP = 3;                 // grey levels between the darkest light and the lightest dark quadrant
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

/** Whether all but the correlation speaks for the corner. */
bool mayAccept(const CornerQuery& query, const Verdict& verdict)
{
  return (query.sign == 0 || verdict.sign == query.sign) &&
         verdict.gap > std::max(MIN_GAP, MIN_GAP_SHARE * verdict.contrast) &&
         verdict.contrast > MIN_CONTRAST_SHARE * query.contrast;
}

bool accepts(const CornerQuery& query, const Verdict& verdict)
{
  return mayAccept(query, verdict) && verdict.correlation > query.correlation;
}

/** Sign, contrast and gap of the ring. */
Verdict judgeQuadrants(const Ring& ring)
{
  float median[QUADRANTS];
  for (int q = 0; q < QUADRANTS; ++q)
  {
    median[q] = quadrantMedian(ring, q);
  }
  Verdict verdict;
  const float difference = (median[0] + median[2] - median[1] - median[3]) / 2;
  verdict.sign = difference > 0 ? 1 : -1;
  verdict.contrast = std::abs(difference);
  const float first = std::min(median[0], median[2]) - std::max(median[1], median[3]);
  const float second = std::min(median[1], median[3]) - std::max(median[0], median[2]);
  verdict.gap = verdict.sign > 0 ? first : second;
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

/** Quick look before the ring: one sample a quadrant must alternate, whatever the sign. */
bool mayAlternate(const PyramidView& view, const LocalFrame& frame)
{
  constexpr float RADIUS = 0.3F;
  const float first = view.sample(frame.at(RADIUS, RADIUS));
  const float second = view.sample(frame.at(-RADIUS, RADIUS));
  const float third = view.sample(frame.at(-RADIUS, -RADIUS));
  const float fourth = view.sample(frame.at(RADIUS, -RADIUS));
  return std::min(first, third) > std::max(second, fourth) || std::min(second, fourth) > std::max(first, third);
}

/** Where the ring alternates best around the prediction; for a prediction too far off for the saddle fit. */
bool searchRing(const PyramidView& view, const LocalFrame& predicted, const CornerQuery& query, cv::Point2f& best)
{
  float best_gap = MIN_GAP;
  bool found = false;
  for (int i = -2; i <= 2; ++i)
  {
    for (int j = -2; j <= 2; ++j)
    {
      LocalFrame moved = predicted;
      moved.node =
          predicted.at(static_cast<float>(j) * 0.5F * query.tolerance, static_cast<float>(i) * 0.5F * query.tolerance);
      if (!mayAlternate(view, moved))
      {
        continue;
      }
      const Verdict verdict = judgeQuadrants(sampleRing(view, moved, INNER_RADIUS, OUTER_RADIUS));
      if (verdict.gap > best_gap && (query.sign == 0 || verdict.sign == query.sign))
      {
        best_gap = verdict.gap;
        best = moved.node;
        found = true;
      }
    }
  }
  return found;
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
  if (budget_ <= 0 || height < MIN_SQUARE_HEIGHT || !isInside(frame_.raw_grey, predicted.node, 2))
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
    if (!query.search || !searchRing(view, predicted, query, corner.node))
    {
      return result;
    }
    point = corner.node * view.scale;
    if (fitSaddle(*view.grey, point, radius, 0.2F * level_height + 0.5F))
    {
      corner.node = point * (1 / view.scale);
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
