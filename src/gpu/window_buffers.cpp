#include "window_buffers.h"

#include <algorithm>

#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
constexpr std::size_t INPUTS = 152;  // HAAR_FEATURES, the bias, and zeros up to a multiple of 8
constexpr std::size_t GATE_UNITS = MAX_GATE_UNITS;
constexpr std::size_t BLOCK_PLANES = 6;
constexpr std::size_t READ_BEYOND = 32;  // blocks and cells
static_assert(GATE_UNITS == 16 && GATE_INPUTS == 96, "kernels/gate.cl has as many");
static_assert(HAAR_FEATURES == 148, "kernels/haar.cl has the same number");
static_assert(HAAR_SHIFTS == 40, "kernels/haar.cl has the same number");
}  // namespace

void WindowBuffers::reserve(const cl::Context& context, const cv::Size& size)
{
  const std::size_t width = size.width;
  const std::size_t height = size.height;
  sums[0].reserve(context, height / 4 * (width / 4) * 3 + 1, sizeof(cl_uint));
  sums[1].reserve(context, height / 8 * (width / 8) * 3 + 1, sizeof(cl_uint));
  cells.reserve(context, height / 2 * (width / 2) * 3 + READ_BEYOND, sizeof(cl_short));
  blocks.reserve(context, height / 4 * (width / 4 + 16) * BLOCK_PLANES + READ_BEYOND, sizeof(cl_short));
  passes.reserve(context, windowGrid(size, 0).area() + 1, 1);
  scores.reserve(context, windowCount(size), sizeof(MarkerScores));
}

std::size_t WindowBuffers::bytes() const
{
  return sums[0].bytes() + sums[1].bytes() + cells.bytes() + logarithm.bytes() + tables.bytes() + weights.bytes() +
         gate_weights.bytes() + blocks.bytes() + passes.bytes() + scores.bytes();
}

std::vector<cl_uchar> packTables()
{
  const HaarTables& tables = haarTables();
  std::vector<cl_uchar> packed(tables.by_length.begin(), tables.by_length.end());
  for (const HaarTables::Crossing& crossing : tables.crossings)
  {
    packed.insert(packed.end(), {crossing.first, crossing.second, crossing.sum, crossing.difference});
  }
  return packed;
}

std::vector<cl_float> packWeights(const MarkerNetwork& network)
{
  const std::size_t padded = (network.hidden + 16) / 16 * 16;  // the hidden units and the bias
  const std::size_t outputs = (network.hidden + 15) / 16 * 16 * INPUTS;
  std::vector<cl_float> packed(outputs + MARKER_KINDS * padded, 0);
  const float* weights = network.weights.data();
  const auto pack = [&weights](cl_float* to, std::size_t inputs, std::size_t step) {
    to[inputs * step] = *weights++;
    for (std::size_t i = 0; i < inputs; ++i)
    {
      to[i * step] = *weights++;
    }
  };
  for (int unit = 0; unit < network.hidden; ++unit)
  {
    pack(packed.data() + unit / 16 * 16 * INPUTS + unit % 16, HAAR_FEATURES, 16);
  }
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    pack(packed.data() + outputs + kind * padded, network.hidden, 1);
  }
  return packed;
}

std::vector<cl_float> packGate(const FeedForward& gate)
{
  constexpr std::size_t OUTPUTS = (GATE_INPUTS + 1) * GATE_UNITS;
  std::vector<cl_float> packed(OUTPUTS + MARKER_KINDS * (GATE_UNITS + 1), 0);
  const float* weights = gate.weights.data();
  for (int unit = 0; unit < gate.hidden; ++unit)
  {
    for (int i = 0; i <= GATE_INPUTS; ++i)
    {
      packed[i * GATE_UNITS + unit] = *weights++;
    }
  }
  for (int kind = 0; kind < MARKER_KINDS; ++kind)
  {
    std::copy(weights, weights + gate.hidden + 1, packed.begin() + OUTPUTS + kind * (GATE_UNITS + 1));
    weights += gate.hidden + 1;
  }
  return packed;
}

}  // namespace omr
