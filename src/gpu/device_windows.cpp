#include <algorithm>
#include <cmath>

#include "device_fill.h"
#include "outdoor_omr/haar_features.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
/** Rows of a strip of the integral image, an even number: a group starts with the sums of all strips above, so few
 * strips are better; 16 a core divide the load. */
int integralRows(int height, int compute_units)
{
  return std::max(16, 2 * divideUp(height, 32 * compute_units));
}

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
  windows_->reserve(context_, size_, divideUp(size_.height, integralRows(size_.height, compute_units_)));
}

void DeviceFill::findIntegral()
{
  if (geometry_ == Geometry::words)
  {
    if (size_.height > 1)
    {
      launch("integralRows", {static_cast<std::size_t>(size_.height / 2), 1}, image_, step_, size_.width,
             *windows_->integral);
    }
    launch("integralColumns", program_.groupsOf(3 * (static_cast<std::size_t>(size_.width / 2) + 1)), size_.width,
           size_.height, *windows_->integral);
    return;
  }
  const int strip_rows = integralRows(size_.height, compute_units_);
  const Groups groups = {static_cast<std::size_t>(divideUp(size_.height, strip_rows)), 1};
  launch("columnSums", groups, image_, step_, size_.width, size_.height, strip_rows, *windows_->column_sums);
  launch("integralStrip", groups, image_, step_, size_.width, size_.height, strip_rows, *windows_->column_sums,
         *windows_->integral);
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
  findIntegral();
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
    launch("haarCells", {static_cast<std::size_t>(divideUp(cells.height, 2)), 1}, *windows_->integral, size_.width,
           level, *windows_->logarithm, cells.width, cells.height, *windows_->cells, *windows_->blocks);
    launch("gateWindows", looked_rows, *windows_->blocks, cells.width / 2, cells.height / 2, *windows_->gate_weights,
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

void DeviceFill::readIntegral(cv::Mat& integral)
{
  reserveWindows();
  findIntegral();
  integral.create(size_.height / 2 + 1, size_.width / 2 + 1, CV_32SC3);
  queue_.enqueueReadBuffer(*windows_->integral, CL_TRUE, 0, integral.total() * integral.elemSize(), integral.data);
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
