#include "corner_ring.h"

#include <algorithm>
#include <cmath>

#include "grey_samples.h"
#include "vectorized.h"

namespace omr
{
namespace
{
constexpr float LEVEL_SQUARE_HEIGHT = 24;  // px; above it a level of half the size shows the square as well
constexpr float RAW_SQUARE_HEIGHT = 5;     // px; below it the 3x3 filter costs recall
constexpr float LOG_OFFSET = 12;           // grey levels

/** Normalised correlation of the ring with a template of one value a quadrant, in grey levels or logarithms. */
float correlation(const Ring& ring, const std::array<float, QUADRANTS>& pattern)
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
      const float value = ring[q * QUADRANT_SAMPLES + i];
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

using RingPlaces = SamplePlaces<RING_SAMPLES>;

OMR_VECTORIZED void takeLogarithms(const Ring& ring, Ring& logarithms)
{
  greyLogarithms(greyLogarithmTable(), ring, logarithms);
}

OMR_VECTORIZED void sampleAll(const cv::Mat& grey, const RingPlaces& places, Ring& ring)
{
  sampleGreys(grey, places, ring);
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

const std::array<float, 257>& greyLogarithmTable()
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

float greyLogarithm(float grey)
{
  const auto index = static_cast<std::size_t>(grey);
  const float rest = grey - static_cast<float>(index);
  const std::array<float, 257>& table = greyLogarithmTable();
  return table[index] * (1 - rest) + table[index + 1] * rest;
}

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
  RingPlaces places;
  const auto place = [&](int i, const cv::Point2f& point) {
    places.x[i] = point.x * view.scale;
    places.y[i] = point.y * view.scale;
  };
  for (int i = 0; i < QUADRANT_SAMPLES; ++i)
  {
    // Opposite quadrants mirror each other at the node.
    const cv::Point2f same = u[i] * frame.u + v[i] * frame.v;
    const cv::Point2f other = u[i] * frame.u - v[i] * frame.v;
    place(i, frame.node + same);
    place(QUADRANT_SAMPLES + i, frame.node - other);
    place(2 * QUADRANT_SAMPLES + i, frame.node - same);
    place(3 * QUADRANT_SAMPLES + i, frame.node + other);
  }
  Ring ring;
  sampleAll(*view.grey, places, ring);
  return ring;
}

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

float ringCorrelation(const Ring& ring, const std::array<float, QUADRANTS>& pattern)
{
  Ring logarithms;
  takeLogarithms(ring, logarithms);
  return std::max(correlation(ring, pattern), correlation(logarithms, pattern));
}

}  // namespace omr
