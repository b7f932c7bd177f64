#include <algorithm>
#include <cmath>

#include "device_fill.h"
#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
/** Groups a compute unit that share the listed windows: they take different times. */
constexpr std::size_t SCORING_GROUPS = 32;

/** What a unit's weighted sum is where it gives a score. */
float beforeActivation(float score)
{
  return 2 * std::atanh(std::clamp(score, -.999999F, .999999F));
}

/** Writes what does not change while the queue reads it. */
template <typename T>
void upload(const cl::Context& context, const cl::CommandQueue& queue, const std::vector<T>& values,
            GrowingBuffer& buffer)
{
  buffer.reserve(context, values.size(), sizeof(T));
  queue.enqueueWriteBuffer(*buffer, CL_TRUE, 0, values.size() * sizeof(T), values.data());
}
}  // namespace

void DeviceFill::reserveWindows()
{
  if (!windows_)
  {
    windows_ = std::make_unique<WindowBuffers>();
  }
  windows_->reserve(context_, size_);
}

/** The kernels look all this up; it changes with the network and the image's size. */
void DeviceFill::uploadWindows(const MarkerNetwork& network)
{
  reserveWindows();
  if (!windows_->has_tables)
  {
    const auto& logarithm = haarTables().logarithm;
    upload(context_, queue_, std::vector<cl_short>(logarithm.begin(), logarithm.end()), windows_->logarithm);
    upload(context_, queue_, packTables(), windows_->tables);
    windows_->has_tables = true;
  }
  const FeedForward& gate = network.gate;
  if (windows_->network.weights != network.weights || windows_->network.gate.weights != gate.weights)
  {
    upload(context_, queue_, packWeights(network), windows_->weights);
    upload(context_, queue_, gate.hidden > 0 ? packGate(gate) : std::vector<cl_float>(1), windows_->gate_weights);
    windows_->network = network;
  }
  if (windows_->size != size_)
  {
    upload(context_, queue_, windowLevels(size_), windows_->levels);
    windows_->size = size_;
  }
  queue_.enqueueFillBuffer(*windows_->lists, cl_uint(0), 0, sizeof(WindowLists));
}

void DeviceFill::findCells(int level)
{
  const Groups rows = {static_cast<std::size_t>(divideUp(size_.height / cellSize(level), 2)), 1};
  const cl::Buffer& next = *windows_->sums[level % 2];
  if (level == 0)
  {
    launch("cellsOfImage", rows, image_, step_, *windows_->logarithm, *windows_->levels, *windows_->cells,
           *windows_->blocks, next);
    return;
  }
  launch("cellsOfSums", rows, *windows_->sums[1 - level % 2], level, *windows_->logarithm, *windows_->levels,
         *windows_->cells, *windows_->blocks, next);
}

void DeviceFill::scoreWindows(const MarkerNetwork& network, std::vector<MarkerScores>& scores)
{
  images_without_windows_ = 0;
  scores.resize(windowCount(size_));
  if (scores.empty())
  {
    return;
  }
  uploadWindows(network);
  const FeedForward& gate = network.gate;
  for (int level = 0; level < HAAR_LEVELS && !windowGrid(size_, level).empty(); ++level)
  {
    findCells(level);
    launch("gateWindows", {static_cast<std::size_t>(divideUp(windowGrid(size_, level).height, 2)), 1}, *windows_->cells,
           *windows_->blocks, *windows_->levels, level, *windows_->gate_weights, gate.hidden,
           beforeActivation(gate.thresholds[0]), beforeActivation(gate.thresholds[1]), *windows_->lists,
           *windows_->likely, *windows_->scores);
  }
  const auto crossings = static_cast<cl_int>(haarTables().crossings.size());
  const Groups groups = {SCORING_GROUPS * static_cast<std::size_t>(compute_units_), 1};
  for (const cl_int second : {0, 1})
  {
    launch("scoreWindows", groups, *windows_->cells, *windows_->levels, *windows_->tables, crossings,
           *windows_->weights, network.hidden, FOLLOWED_SCORE, second, *windows_->likely, *windows_->beside,
           *windows_->lists, *windows_->scores);
  }
  queue_.enqueueReadBuffer(*windows_->scores, CL_FALSE, 0, scores.size() * sizeof(MarkerScores), scores.data());
  scored_ = last_event_;
}

}  // namespace omr
