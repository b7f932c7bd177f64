#include "outdoor_omr/corner_look.h"

#include <array>

namespace outdoor_omr
{
namespace
{
constexpr float LEVEL_SQUARE_HEIGHT = 24;    // px; above it a level of half the size shows the square as well
constexpr float RAW_SQUARE_HEIGHT = 5;       // px; below it the 3x3 filter costs recall
constexpr float MIN_SQUARE_HEIGHT = 1.5F;    // px; the pixel grid resolves no less
constexpr float MIN_GAP = 3;                 // grey levels between the darkest light and the lightest dark quadrant
constexpr float MIN_GAP_SHARE = 0.15F;       // of the contrast
constexpr float MIN_CONTRAST_SHARE = 0.25F;  // of the neighbours' contrast; half of it is a shadow's edge
constexpr float LOG_OFFSET = 12;  // grey levels; keeps the noise of the darkest pixels small in the logarithm

constexpr int QUADRANTS = 4;  // (+u +v), (-u +v), (-u -v), (+u -v)
constexpr int QUADRANT_SAMPLES = 6;
constexpr int RING_SAMPLES = QUADRANTS * QUADRANT_SAMPLES;
constexpr std::array<float, QUADRANTS> QUADRANT_U = {1, -1, -1, 1};
constexpr std::array<float, QUADRANTS> QUADRANT_V = {1, 1, -1, -1};

const std::array<float, 257>& logarithms()
{
  static const std::array<float, 257> TABLE = [] {
    std::array<float, 257> table;
    for (std::size_t i = 0; i < table.size(); ++i)
    {
      table[i] = std::log(static_cast<float>(i) + LOG_OFFSET);
    }
    return table;
  }();
  return TABLE;
}

float logarithm(float grey)
{
  const auto index = static_cast<std::size_t>(grey);
  const float rest = grey - static_cast<float>(index);
  return logarithms()[index] * (1 - rest) + logarithms()[index + 1] * rest;
}

/** Samples around a corner, quadrant by quadrant. */
using Ring = std::array<float, RING_SAMPLES>;

/** 25, 45 and 65 degrees from the lattice lines on two circles; at least 1 px off the lines, where edges are blurred.
 */
Ring sampleRing(const PyramidView& view, const LocalFrame& frame, float inner_radius, float outer_radius)
{
  constexpr float ANGLES[3][2] = {{0.9063F, 0.4226F}, {0.7071F, 0.7071F}, {0.4226F, 0.9063F}};
  const float least_u = std::min(0.5F, 1 / (length(frame.u) * view.scale));
  const float least_v = std::min(0.5F, 1 / (length(frame.v) * view.scale));
  float u[QUADRANT_SAMPLES];
  float v[QUADRANT_SAMPLES];
  for (int i = 0; i < QUADRANT_SAMPLES; ++i)
  {
    const float radius = i % 2 == 0 ? inner_radius : outer_radius;
    u[i] = std::max(ANGLES[i / 2][0] * radius, least_u);
    v[i] = std::max(ANGLES[i / 2][1] * radius, least_v);
  }
  Ring ring;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    for (int i = 0; i < QUADRANT_SAMPLES; ++i)
    {
      ring[q * QUADRANT_SAMPLES + i] = view.sample(frame.at(QUADRANT_U[q] * u[i], QUADRANT_V[q] * v[i]));
    }
  }
  return ring;
}

/** Mean of the two middle samples. */
float quadrantMedian(const Ring& ring, int quadrant)
{
  std::array<float, QUADRANT_SAMPLES> values;
  std::copy_n(ring.begin() + quadrant * QUADRANT_SAMPLES, QUADRANT_SAMPLES, values.begin());
  const auto order = [&](int a, int b) {
    const float low = std::min(values[a], values[b]);
    values[b] = std::max(values[a], values[b]);
    values[a] = low;
  };
  // Sorting network of six; the last exchange, of the two in the middle, does not matter.
  order(1, 2), order(4, 5), order(0, 2), order(3, 5), order(0, 1), order(3, 4), order(2, 5), order(0, 3), order(1, 4),
      order(2, 4), order(1, 3);
  return (values[2] + values[3]) / 2;
}

/** Normalised correlation of the ring with a template of one value a quadrant, in grey levels or logarithms. */
template <typename Transform>
float correlation(const Ring& ring, const std::array<float, QUADRANTS>& pattern, const Transform& transform)
{
  float sum = 0;
  float squares = 0;
  float product = 0;
  float pattern_sum = 0;
  float pattern_squares = 0;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    float quadrant = 0;
    for (int i = 0; i < QUADRANT_SAMPLES; ++i)
    {
      const float value = transform(ring[q * QUADRANT_SAMPLES + i]);
      quadrant += value;
      squares += value * value;
    }
    sum += quadrant;
    product += pattern[q] * quadrant;
    pattern_sum += pattern[q] * QUADRANT_SAMPLES;
    pattern_squares += pattern[q] * pattern[q] * QUADRANT_SAMPLES;
  }
  constexpr float N = RING_SAMPLES;
  const float variance = (squares - sum * sum / N) * (pattern_squares - pattern_sum * pattern_sum / N);
  return variance > 1e-4F ? (product - sum * pattern_sum / N) / std::sqrt(variance) : 0.F;
}

float bestCorrelation(const Ring& ring, const std::array<float, QUADRANTS>& pattern)
{
  return std::max(correlation(ring, pattern, [](float grey) { return grey; }), correlation(ring, pattern, logarithm));
}

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
    verdict.correlation = bestCorrelation(ring, {s, -s, s, -s});
  }
  return verdict;
}

bool accepts(const CornerQuery& query, const Verdict& verdict)
{
  return (query.sign == 0 || verdict.sign == query.sign) &&
         verdict.gap > std::max(MIN_GAP, MIN_GAP_SHARE * verdict.contrast) && verdict.correlation > query.correlation &&
         verdict.contrast > MIN_CONTRAST_SHARE * query.contrast;
}

/** Whether all quadrants but the dark one have one hue: a coloured thing over the rim is as light as the margin, but it
 * is not the margin. */
bool haveOneColor(const cv::Mat& bgr, const LocalFrame& frame, int dark)
{
  constexpr float OFFSET = 0.3F;         // squares
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
  constexpr float DEPTH = 0.2F;       // squares
  constexpr float MIN_EDGE = 0.4F;    // logarithm of the ratio
  constexpr float MAX_FLAT = 0.2F;
  const auto step = [&](float side, float depth) {
    const cv::Point2f offset = side * along + depth * across;
    return logarithm(view.sample(frame.at(offset.x, offset.y)));
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

bool isInside(const cv::Mat& image, const cv::Point2f& point, float margin)
{
  return point.x >= margin && point.y >= margin && point.x < image.cols - 1 - margin &&
         point.y < image.rows - 1 - margin;
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

PyramidView::PyramidView(const Frame& frame, float square_height)
    : grey(square_height < RAW_SQUARE_HEIGHT ? &frame.raw_grey : frame.grey.data())
{
  while (level + 1 < static_cast<int>(frame.grey.size()) && square_height * scale > LEVEL_SQUARE_HEIGHT)
  {
    grey = &frame.grey[++level];
    scale /= 2;
  }
}

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

RimLook CornerLooker::lookAtRim(const LocalFrame& predicted, int dark_u, int dark_v, bool side_is_row, float contrast) const
{
  // Half as far out as the ring of an inner corner: a board's margin may be as narrow as half a square.
  constexpr float INNER = 0.25F;
  constexpr float OUTER = 0.4F;
  constexpr float MIN_CORRELATION = 0.9F;
  constexpr float MIN_SHARE = 0.4F;   // of the contrast
  constexpr float MAX_SPREAD = 0.4F;  // of the light squares, in contrasts
  const float height = squareHeight(predicted);
  if (height < MIN_SQUARE_HEIGHT || !isInside(frame_.raw_grey, predicted.node, 2))
  {
    return RimLook::unclear;
  }
  const PyramidView view(frame_, height);
  const Ring ring = sampleRing(view, predicted, INNER, OUTER);
  std::array<float, QUADRANTS> median;
  int dark = 0;
  for (int q = 0; q < QUADRANTS; ++q)
  {
    median[q] = quadrantMedian(ring, q);
    dark = QUADRANT_U[q] * static_cast<float>(dark_u) > 0 && QUADRANT_V[q] * static_cast<float>(dark_v) > 0 ? q : dark;
  }
  const float beside_a = median[(dark + 1) % QUADRANTS];
  const float opposite = median[(dark + 2) % QUADRANTS];
  const float beside_b = median[(dark + 3) % QUADRANTS];
  const float least_gap = std::max(MIN_GAP, MIN_SHARE * contrast);
  std::array<float, QUADRANTS> pattern = {1, 1, 1, 1};
  pattern[dark] = -1;
  const float light = std::min({beside_a, beside_b, opposite});
  if (light - median[dark] > least_gap && bestCorrelation(ring, pattern) > MIN_CORRELATION &&
      std::max({beside_a, beside_b, opposite}) - light < MAX_SPREAD * (light - median[dark]) &&
      haveOneColor(frame_.bgr, predicted, dark))
  {
    return RimLook::outer_corner;
  }
  pattern[(dark + 2) % QUADRANTS] = -1;
  if (std::min(beside_a, beside_b) - std::max(median[dark], opposite) > least_gap &&
      bestCorrelation(ring, pattern) > MIN_CORRELATION)
  {
    return RimLook::inner_corner;
  }
  const auto u = static_cast<float>(dark_u);
  const auto v = static_cast<float>(dark_v);
  const bool ends = side_is_row ? endsAtLine(view, predicted, {u, 0}, {0, v}) : endsAtLine(view, predicted, {0, v}, {u, 0});
  if (ends && haveOneColor(frame_.bgr, predicted, dark))
  {
    return RimLook::outer_edge;
  }
  return RimLook::unclear;
}

}  // namespace outdoor_omr
