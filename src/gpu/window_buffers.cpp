#include "window_buffers.h"

#include <algorithm>

#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
constexpr std::size_t INPUTS = HAAR_FEATURES + 1;
constexpr std::size_t GATE_UNITS = MAX_GATE_UNITS;
constexpr std::size_t BLOCK_PLANES = 6;
constexpr std::size_t READ_BEYOND = 32;  // blocks and cells
static_assert(GATE_UNITS == 16 && GATE_INPUTS == 96, "kernels/gate.cl has as many");
static_assert(HAAR_FEATURES == 212, "kernels/haar.cl has the same number");
static_assert(HAAR_SHIFTS == 40, "kernels/haar.cl has the same number");
}  // namespace

std::vector<WindowLevel> windowLevels(const cv::Size& size)
{
  std::vector<WindowLevel> levels(HAAR_LEVELS);
  WindowLevel next;
  for (int i = 0; i < HAAR_LEVELS; ++i)
  {
    const cv::Size cells = size / cellSize(i);
    const cv::Size windows = windowGrid(size, i);
    levels[i] = {next.first_cell, cells.width, cells.height, next.first_window, windows.width, windows.height};
    next.first_cell += static_cast<cl_uint>(3 * static_cast<std::size_t>(cells.width) * cells.height);
    next.first_window += static_cast<cl_uint>(windows.area());
  }
  return levels;
}

void WindowBuffers::reserve(const cl::Context& context, const cv::Size& size)
{
  const std::size_t width = size.width;
  const std::size_t height = size.height;
  const std::size_t windows = windowCount(size);
  levels.reserve(context, HAAR_LEVELS, sizeof(WindowLevel));
  sums[0].reserve(context, height / 4 * (width / 4) * 3 + 1, sizeof(cl_uint));
  sums[1].reserve(context, height / 8 * (width / 8) * 3 + 1, sizeof(cl_uint));
  cells.reserve(context, 4 * (height / 2 * (width / 2)) + READ_BEYOND,
                sizeof(cl_short));  // 3 * 4 / 3 of the first level
  blocks.reserve(context, height / 4 * (width / 4 + 16) * BLOCK_PLANES + READ_BEYOND, sizeof(cl_short));
  lists.reserve(context, 1, sizeof(WindowLists));
  likely.reserve(context, windows + 1, sizeof(cl_uint));
  beside.reserve(context, windows + 1, sizeof(cl_uint));
  scores.reserve(context, windows, sizeof(MarkerScores));
}

std::size_t WindowBuffers::bytes() const
{
  std::size_t sum = 0;
  for (const GrowingBuffer* buffer : {&levels, sums.data(), sums.data() + 1, &cells, &logarithm, &tables, &weights,
                                      &gate_weights, &blocks, &lists, &likely, &beside, &scores})
  {
    sum += buffer->bytes();
  }
  return sum;
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
