#include "window_buffers.h"

#include <algorithm>

#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
constexpr std::size_t INPUTS = 152;  // HAAR_FEATURES, the bias, and zeros up to a multiple of 8
constexpr std::size_t FIRST_CROSSING = 48;
static_assert(HAAR_FEATURES == 148, "kernels/haar.cl has the same number");
static_assert(HAAR_SHIFTS == 40, "kernels/haar.cl has the same number");
}  // namespace

void WindowBuffers::reserve(const cl::Context& context, const cv::Size& size, int strips)
{
  const std::size_t width = size.width;
  const std::size_t height = size.height;
  column_sums.reserve(context, strips * width * 3, sizeof(cl_uint));
  integral.reserve(context, (height + 1) * (width + 1) * 3, sizeof(cl_uint));
  cells.reserve(context, height / 2 * (width / 2) * 3, sizeof(cl_short));
  scores.reserve(context, windowCount(size), sizeof(MarkerScores));
}

std::size_t WindowBuffers::bytes() const
{
  return column_sums.bytes() + integral.bytes() + cells.bytes() + logarithm.bytes() + tables.bytes() + weights.bytes() +
         scores.bytes();
}

std::vector<cl_uchar> packTables()
{
  const HaarTables& tables = haarTables();
  std::vector<cl_uchar> packed(FIRST_CROSSING, 0);
  std::copy(tables.by_length.begin(), tables.by_length.end(), packed.begin());
  std::copy(tables.bands.begin(), tables.bands.end(), packed.begin() + HAAR_SHIFTS);
  for (const HaarTables::Crossing& crossing : tables.crossings)
  {
    packed.insert(packed.end(), {crossing.first, crossing.second, crossing.sum, crossing.difference});
  }
  return packed;
}

std::vector<cl_float> packWeights(const MarkerNetwork& network)
{
  const std::size_t padded = (network.hidden + 8) / 8 * 8;  // the hidden units and the bias
  std::vector<cl_float> packed(network.hidden * INPUTS + MARKER_KINDS * padded, 0);
  const float* weights = network.weights.data();
  const auto pack = [&weights](cl_float* to, std::size_t inputs) {
    to[inputs] = *weights++;
    std::copy(weights, weights + inputs, to);
    weights += inputs;
  };
  for (int unit = 0; unit < network.hidden; ++unit)
  {
    pack(packed.data() + unit * INPUTS, HAAR_FEATURES);
  }
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    pack(packed.data() + network.hidden * INPUTS + kind * padded, network.hidden);
  }
  return packed;
}

}  // namespace omr
