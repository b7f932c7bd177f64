#include <algorithm>
#include <cmath>

#include "device_fill.h"
#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
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

void DeviceFill::findCells(int level)
{
  const cv::Size cells = size_ / cellSize(level);
  const Groups rows = {static_cast<std::size_t>(divideUp(cells.height, 2)), 1};
  const cl::Buffer& next = *windows_->sums[level % 2];
  if (level == 0)
  {
    launch("cellsOfImage", rows, image_, step_, *windows_->logarithm, cells.width, cells.height, *windows_->cells,
           *windows_->blocks, next);
    return;
  }
  launch("cellsOfSums", rows, *windows_->sums[1 - level % 2], level, *windows_->logarithm, cells.width, cells.height,
         *windows_->cells, *windows_->blocks, next);
}

void DeviceFill::scoreWindows(const MarkerNetwork& network, std::vector<MarkerScores>& scores)
{
  images_without_windows_ = 0;
  reserveWindows();
  if (windows_->tables.bytes() == 0)
  {
    const auto& logarithm = haarTables().logarithm;
    upload(context_, queue_, std::vector<cl_short>(logarithm.begin(), logarithm.end()), windows_->logarithm);
    upload(context_, queue_, packTables(), windows_->tables);
  }
  const FeedForward& gate = network.gate;
  if (windows_->network.weights != network.weights || windows_->network.gate.weights != gate.weights)
  {
    upload(context_, queue_, packWeights(network), windows_->weights);
    upload(context_, queue_, gate.hidden > 0 ? packGate(gate) : std::vector<cl_float>(1), windows_->gate_weights);
    windows_->network = network;
  }
  const auto crossings = static_cast<cl_int>(haarTables().crossings.size());
  int first = 0;
  for (int level = 0; level < HAAR_LEVELS; ++level)
  {
    const cv::Size grid = windowGrid(size_, level);
    if (grid.empty())
    {
      break;
    }
    const cv::Size cells = size_ / cellSize(level);
    const Groups window_rows = {static_cast<std::size_t>(grid.height), 1};
    const Groups looked_rows = {static_cast<std::size_t>(divideUp(grid.height, 2)), 1};
    findCells(level);
    launch("gateWindows", looked_rows, *windows_->blocks, cells.width, cells.height / 2, *windows_->gate_weights,
           gate.hidden, beforeActivation(gate.thresholds[0]), beforeActivation(gate.thresholds[1]),
           divideUp(grid.width, 2), *windows_->passes);
    launch("scoreWindows", looked_rows, *windows_->cells, cells.width, cells.height, *windows_->tables, crossings,
           *windows_->weights, network.hidden, *windows_->passes, grid.width, first, *windows_->scores);
    launch("followWindows", window_rows, *windows_->cells, cells.width, cells.height, *windows_->tables, crossings,
           *windows_->weights, network.hidden, FOLLOWED_SCORE, grid.width, grid.height, first, *windows_->scores);
    first += grid.area();
  }
  scores.resize(first);
  if (first > 0)
  {
    queue_.enqueueReadBuffer(*windows_->scores, CL_FALSE, 0, scores.size() * sizeof(MarkerScores), scores.data());
  }
  scored_ = last_event_;
}

void DeviceFill::spareWindows()
{
  images_without_windows_ += 1;
  if (images_without_windows_ > PATIENCE)
  {
    windows_.reset();
  }
}

}  // namespace omr
