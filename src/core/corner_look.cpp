#include "outdoor_omr/corner_look.h"

#include <algorithm>
#include <cmath>

#include "outdoor_omr/corner_ring.h"

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

Verdict judgeRing(const PyramidView& view, const LocalFrame& frame)
{
  const Ring ring = sampleRing(view, frame, INNER_RADIUS, OUTER_RADIUS);
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
  if (verdict.gap > MIN_GAP)
  {
    const auto s = static_cast<float>(verdict.sign);
    verdict.correlation = ringCorrelation(ring, {s, -s, s, -s});
  }
  return verdict;
}

bool accepts(const CornerQuery& query, const Verdict& verdict)
{
  return (query.sign == 0 || verdict.sign == query.sign) &&
         verdict.gap > std::max(MIN_GAP, MIN_GAP_SHARE * verdict.contrast) && verdict.correlation > query.correlation &&
         verdict.contrast > MIN_CONTRAST_SHARE * query.contrast;
}

/**
 * Saddle point of the quadratic fitted to a square window, re-centred until it rests.
 *
 * @param point  start and result, pixels of this image.
 * @param radius of the window [px].
 * @param reach  largest distance from the start [px].
 * @return false if there is no saddle point within reach.
 */
bool fitSaddle(const cv::Mat& grey, cv::Point2f& point, int radius, float reach)
{
  constexpr int MAX_ROUNDS = 6;
  constexpr float AT_REST = 0.03F;  // px; the final refinement starts from 0.1 px as well
  const cv::Point2f start = point;
  const auto r = static_cast<float>(radius);
  // Sums of x^2, x^4 and x^2 y^2 over the window.
  const float n = (2 * r + 1) * (2 * r + 1);
  const float s2_line = r * (r + 1) * (2 * r + 1) / 3;
  const float s4_line = s2_line * (3 * r * r + 3 * r - 1) / 5;
  const float s2 = s2_line * (2 * r + 1);
  const float s4 = s4_line * (2 * r + 1);
  const float s22 = s2_line * s2_line;
  for (int round = 0; round < MAX_ROUNDS; ++round)
  {
    if (!isInside(grey, point, r + 1))
    {
      return false;
    }
    const int column = static_cast<int>(point.x);
    const int row = static_cast<int>(point.y);
    const float a = point.x - static_cast<float>(column);
    const float b = point.y - static_cast<float>(row);
    const float w00 = (1 - a) * (1 - b);
    const float w01 = a * (1 - b);
    const float w10 = (1 - a) * b;
    const float w11 = a * b;
    float z = 0;
    float zx = 0;
    float zy = 0;
    float zxx = 0;
    float zxy = 0;
    float zyy = 0;
    for (int y = -radius; y <= radius; ++y)
    {
      const uchar* above = grey.ptr<uchar>(row + y) + column - radius;
      const uchar* below = above + grey.step;
      float line = 0;
      float line_x = 0;
      float line_xx = 0;
      for (int i = 0; i <= 2 * radius; ++i)
      {
        const auto x = static_cast<float>(i - radius);
        const float value = w00 * above[i] + w01 * above[i + 1] + w10 * below[i] + w11 * below[i + 1];
        line += value;
        line_x += x * value;
        line_xx += x * x * value;
      }
      const auto fy = static_cast<float>(y);
      z += line;
      zx += line_x;
      zxx += line_xx;
      zy += fy * line;
      zyy += fy * fy * line;
      zxy += fy * line_x;
    }
    // z = f + d x + e y + qxx x^2 + qxy x y + qyy y^2
    const float d = zx / s2;
    const float e = zy / s2;
    const float qxy = zxy / s22;
    const float difference = (zxx - zyy) / (s4 - s22);
    const float sum = (zxx + zyy - 2 * s2 * z / n) / (s4 + s22 - 2 * s2 * s2 / n);
    const float qxx = (sum + difference) / 2;
    const float qyy = (sum - difference) / 2;
    const float determinant = 4 * qxx * qyy - qxy * qxy;
    if (determinant >= -1e-9F)
    {
      return false;
    }
    cv::Point2f move(-(2 * qyy * d - qxy * e) / determinant, -(2 * qxx * e - qxy * d) / determinant);
    const float distance = length(move);
    if (distance > r)
    {
      move *= r / distance;
    }
    point += move;
    if (length(point - start) > reach)
    {
      return false;
    }
    if (distance < AT_REST)
    {
      break;
    }
  }
  return true;
}

int fitRadius(float square_height)
{
  return std::max(1, std::min(6, static_cast<int>(std::lround(0.32F * square_height))));
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
      const Verdict verdict = judgeRing(view, moved);
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
  cv::Point2f point = predicted.node * view.scale;
  bool found = fitSaddle(*view.grey, point, radius, query.tolerance * level_height + 0.5F);
  if (found)
  {
    corner.node = point * (1 / view.scale);
    found = accepts(query, judgeRing(view, corner));
  }
  if (!found)
  {
    if (!searchRing(view, predicted, query, corner.node))
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
  const Verdict verdict = judgeRing(view, corner);
  result.position = corner.node;
  result.sign = verdict.sign;
  result.contrast = verdict.contrast;
  result.correlation = verdict.correlation;
  result.found = accepts(query, verdict) && squaresBetween(predicted, corner.node) <= query.tolerance + 0.5F / height;
  return result;
}

}  // namespace omr
