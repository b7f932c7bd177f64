#include "device_fill.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace outdoor_omr
{
namespace
{
constexpr int GPU_LANES = 64;  // a wavefront of AMD, two warps of NVIDIA
constexpr int EDGE_ROWS = 16;  // kernels/edges.cl

int divideUp(int a, int b)
{
  return (a + b - 1) / b;
}

/** Strips for a CPU: 16 a core for an even load, 16 to 64 rows each (fewer unions across seams; measured flat there).
 */
Strips stripsFor(Geometry geometry, int height, int compute_units)
{
  Strips strips;
  if (geometry == Geometry::strips)
  {
    strips.rows = std::clamp(height / (16 * compute_units), 16, 64);
    strips.united = true;
  }
  return strips;
}

double millisecondsBetween(cl_ulong start, cl_ulong end)
{
  return end > start ? (end - start) * 1e-6 : 0.;
}
}  // namespace

DeviceFill::DeviceFill(const Device& device, Geometry geometry)
    : context_(device.device),
      queue_(context_, device.device, CL_QUEUE_PROFILING_ENABLE),
      program_(context_, device.device, geometry == Geometry::strips ? 1 : GPU_LANES),
      geometry_(geometry),
      shares_memory_(device.cpu),
      compute_units_(static_cast<int>(device.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()))
{
  warmUp();
}

template <typename... Arguments>
void DeviceFill::launch(const std::string& kernel, const Groups& groups, const Arguments&... arguments)
{
  last_event_ = program_.launch(queue_, kernel, groups, arguments...);
  if (loaded_() == nullptr)
  {
    loaded_ = last_event_;
  }
}

Groups DeviceFill::rows() const
{
  return {static_cast<std::size_t>(size_.height), 1};
}

Groups DeviceFill::strips() const
{
  return {static_cast<std::size_t>(strips_.count(size_.height)), 1};
}

Groups DeviceFill::words(int row_count) const
{
  const std::size_t lanes = geometry_ == Geometry::strips ? 1 : GPU_LANES;
  return {(static_cast<std::size_t>(divideUp(size_.width, 64)) * row_count + lanes - 1) / lanes, 1};
}

void DeviceFill::loadImage(const cv::Mat& bgr)
{
  bgr_ = bgr;
  size_ = bgr.size();
  loaded_ = filtered_ = edges_found_ = labelled_ = cl::Event();
  strips_ = stripsFor(geometry_, size_.height, compute_units_);
  buffers_.reserve(context_, size_, strips_);
  const std::size_t row_bytes = static_cast<std::size_t>(size_.width) * 3;
  if (shares_memory_)
  {
    step_ = static_cast<cl_long>(bgr.step[0]);
    image_ =
        cl::Buffer(context_, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, step_ * (size_.height - 1) + row_bytes, bgr.data);
    return;
  }
  step_ = static_cast<cl_long>(row_bytes);
  upload_.reserve(context_, size_.height, row_bytes);
  image_ = *upload_;
  const std::array<std::size_t, 3> origin = {0, 0, 0};
  const std::array<std::size_t, 3> region = {row_bytes, static_cast<std::size_t>(size_.height), 1};
  queue_.enqueueWriteBufferRect(image_, CL_FALSE, origin, origin, region, row_bytes, 0, bgr.step[0], 0, bgr.data,
                                nullptr, &loaded_);
}

void DeviceFill::filter(Filter filter, int size)
{
  if (filter == Filter::none)
  {
    return;
  }
  const std::string name = (filter == Filter::gaussian ? "gaussian" : "median") + std::to_string(size);
  launch(name, rows(), image_, step_, size_.width, size_.height, *buffers_.filtered);
  filtered_ = last_event_;
  image_ = *buffers_.filtered;
  step_ = static_cast<cl_long>(size_.width) * 3;
}

void DeviceFill::findEdges(int threshold)
{
  const bool by_strips = geometry_ == Geometry::strips;
  const int groups_down = by_strips ? divideUp(size_.height, EDGE_ROWS) : size_.height;
  launch(by_strips ? "edgesStrip" : "edgesWord",
         {static_cast<std::size_t>(divideUp(size_.width, 64)), static_cast<std::size_t>(groups_down)}, image_, step_,
         size_.width, size_.height, threshold, *buffers_.mask);
  edges_found_ = last_event_;
}

void DeviceFill::loadEdges(const cv::Mat& edges)
{
  const int words = divideUp(size_.width, 64);
  std::vector<cl_ulong> mask(static_cast<std::size_t>(words) * size_.height, 0);
  for (int y = 0; y < size_.height; ++y)
  {
    const auto* row = edges.ptr<uchar>(y);
    for (int x = 0; x < size_.width; ++x)
    {
      mask[static_cast<std::size_t>(y) * words + x / 64] |= static_cast<cl_ulong>(row[x] == 0) << (x % 64);
    }
  }
  queue_.enqueueWriteBuffer(*buffers_.mask, CL_TRUE, 0, mask.size() * sizeof(cl_ulong), mask.data());
}

/** Lets write() fill a buffer that reaches the host as image; on a CPU device it is the image's own memory. */
template <typename Write>
void DeviceFill::readImage(cv::Mat& image, GrowingBuffer& buffer, const Write& write)
{
  const std::size_t bytes = image.total() * image.elemSize();
  if (!shares_memory_)
  {
    buffer.reserve(context_, bytes, 1);
    write(*buffer);
    queue_.enqueueReadBuffer(*buffer, CL_FALSE, 0, bytes, image.data);
    return;
  }
  const cl::Buffer shared(context_, CL_MEM_WRITE_ONLY | CL_MEM_USE_HOST_PTR, bytes, image.data);
  write(shared);
  void* mapped = queue_.enqueueMapBuffer(shared, CL_FALSE, CL_MAP_READ, 0, bytes);
  queue_.enqueueUnmapMemObject(shared, mapped);
}

void DeviceFill::readEdges(cv::Mat& edges)
{
  edges = edges.isContinuous() ? edges : cv::Mat();
  edges.create(size_, CV_8UC1);
  readImage(edges, edge_image_,
            [this](const cl::Buffer& image) { launch("edgeImage", rows(), *buffers_.mask, size_.width, image); });
}

FillMethod DeviceFill::labelRegions(FillMethod method, int sweep_rounds)
{
  if (method == FillMethod::sweep)
  {
    findRuns(Strips());
    if (sweep(sweep_rounds))
    {
      findRegions();
      return FillMethod::sweep;
    }
  }
  findRuns(stripsFor(geometry_, size_.height, compute_units_));
  mergeSeams();
  findRegions();
  return FillMethod::runs;
}

void DeviceFill::findRuns(const Strips& strips)
{
  strips_ = strips;
  buffers_.reserve(context_, size_, strips_);
  if (strips_.united)
  {
    launch("runsStrip", this->strips(), *buffers_.mask, size_.width, size_.height, strips_.rows, *buffers_.runs,
           *buffers_.row_first, *buffers_.row_runs, *buffers_.rank, *buffers_.run_slot, *buffers_.parent,
           *buffers_.slot_label, *buffers_.strip_slots);
  }
  else
  {
    launch("runsWord", rows(), *buffers_.mask, size_.width, *buffers_.runs, *buffers_.row_first, *buffers_.row_runs,
           *buffers_.rank, *buffers_.run_slot, *buffers_.parent, *buffers_.slot_label, *buffers_.strip_slots);
  }
}

bool DeviceFill::sweep(int rounds)
{
  const int lanes = geometry_ == Geometry::strips ? 1 : GPU_LANES;
  const auto lines = [lanes](int count) { return Groups{static_cast<std::size_t>(divideUp(count, lanes)), 1}; };
  sweep_labels_.reserve(context_, size_.area(), sizeof(cl_int));
  launch("sweepInit", rows(), size_.width, *sweep_labels_);
  Counters counters;
  counters.changed = 1;
  for (int round = 0; round < rounds && counters.changed != 0; ++round)
  {
    queue_.enqueueFillBuffer(*buffers_.counters, cl_uint(0), 0, sizeof(Counters));
    launch("sweepRows", lines(size_.height), *buffers_.mask, size_.width, size_.height, *sweep_labels_,
           *buffers_.counters);
    launch("sweepColumns", lines(size_.width), *buffers_.mask, size_.width, size_.height, *sweep_labels_,
           *buffers_.counters);
    queue_.enqueueReadBuffer(*buffers_.counters, CL_TRUE, 0, sizeof(Counters), &counters);
  }
  if (counters.changed != 0)
  {
    return false;
  }
  launch("adoptLabels", rows(), *buffers_.mask, size_.width, *sweep_labels_, *buffers_.runs, *buffers_.row_first,
         *buffers_.row_runs, *buffers_.rank, *buffers_.parent);
  return true;
}

void DeviceFill::mergeSeams()
{
  const int seams = strips_.count(size_.height) - 1;
  if (seams > 0)
  {
    launch("mergeSeams", words(seams), *buffers_.mask, size_.width, size_.height, strips_.rows, *buffers_.row_first,
           *buffers_.rank, *buffers_.run_slot, *buffers_.parent);
  }
}

void DeviceFill::findRegions()
{
  queue_.enqueueFillBuffer(*buffers_.counters, cl_uint(0), 0, sizeof(Counters));
  launch("findRegions", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
         *buffers_.slot_label, cl_int(strips_.united), *buffers_.slot_record, *buffers_.records,
         buffers_.record_capacity, *buffers_.counters);
  labelled_ = last_event_;
}

void DeviceFill::readLabels(cv::Mat& labels)
{
  labels = labels.isContinuous() ? labels : cv::Mat();
  labels.create(size_, CV_32SC1);
  readImage(labels, label_image_, [this](const cl::Buffer& image) {
    if (geometry_ == Geometry::strips)
    {
      launch("labelsByRuns", rows(), size_.width, *buffers_.runs, *buffers_.row_first, *buffers_.row_runs,
             *buffers_.run_slot, *buffers_.parent, *buffers_.slot_label, image);
    }
    else
    {
      launch("labelsByPixels", rows(), *buffers_.mask, size_.width, *buffers_.row_first, *buffers_.rank,
             *buffers_.run_slot, *buffers_.parent, *buffers_.slot_label, image);
    }
  });
  labelled_ = last_event_;
}

void DeviceFill::sumRegions(const AreaWindow& window)
{
  window_ = window;
  if (strips_.united)
  {
    launch("sumStrip", strips(), image_, step_, *buffers_.mask, size_.width, size_.height, strips_.rows, *buffers_.runs,
           *buffers_.row_first, *buffers_.row_runs, *buffers_.run_slot, *buffers_.slot_record, *buffers_.prefix,
           *buffers_.records, buffers_.record_capacity, *buffers_.counters);
    launch("reduceRecords", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
           *buffers_.slot_record, *buffers_.records, buffers_.record_capacity, *buffers_.counters);
  }
  else
  {
    launch("sumWord", words(size_.height), image_, step_, *buffers_.mask, size_.width, size_.height, *buffers_.runs,
           *buffers_.row_first, *buffers_.rank, *buffers_.parent, *buffers_.slot_record, *buffers_.records,
           buffers_.record_capacity, *buffers_.counters);
  }
  launch("sumDistances", rows(), *buffers_.runs, *buffers_.row_first, *buffers_.row_runs, *buffers_.run_slot,
         *buffers_.parent, *buffers_.slot_record, window_.min, window_.max, *buffers_.records, buffers_.record_capacity,
         *buffers_.counters);
  reportRegions();
}

void DeviceFill::reportRegions()
{
  launch("reportRegions", strips(), size_.width, strips_.rows, *buffers_.strip_slots, *buffers_.parent,
         *buffers_.slot_record, window_.min, window_.max, *buffers_.records, buffers_.record_capacity,
         *buffers_.reported, buffers_.reported_capacity, *buffers_.counters);
}

int DeviceFill::readSums(std::vector<RegionSums>& sums)
{
  Counters counters;
  while (true)
  {
    // As many as the last image had arrive together with the counters: one wait for both.
    sums.resize(std::min(expected_reports_, buffers_.reported_capacity));
    queue_.enqueueReadBuffer(*buffers_.counters, CL_FALSE, 0, sizeof(Counters), &counters);
    queue_.enqueueReadBuffer(*buffers_.reported, CL_TRUE, 0, sums.size() * sizeof(RegionSums), sums.data());
    if (counters.records > buffers_.record_capacity)
    {
      buffers_.reserveRecords(context_, counters.records);
      findRegions();
      sumRegions(window_);
    }
    else if (counters.reported > buffers_.reported_capacity)
    {
      buffers_.reserveReported(context_, counters.reported);
      queue_.enqueueFillBuffer(*buffers_.counters, cl_uint(0), offsetof(Counters, reported), sizeof(cl_uint));
      reportRegions();
    }
    else
    {
      break;
    }
  }
  const std::size_t read = sums.size();
  sums.resize(counters.reported);
  if (counters.reported > read)
  {
    queue_.enqueueReadBuffer(*buffers_.reported, CL_TRUE, read * sizeof(RegionSums),
                             (counters.reported - read) * sizeof(RegionSums), sums.data() + read);
  }
  expected_reports_ = counters.reported + counters.reported / 4 + 64;
  std::sort(sums.begin(), sums.end(), [](const RegionSums& a, const RegionSums& b) { return a.label < b.label; });
  return static_cast<int>(counters.regions);
}

void DeviceFill::finish()
{
  queue_.finish();
  image_ = cl::Buffer();
  bgr_.release();
}

DeviceFill::Times DeviceFill::times() const
{
  Times times;
  if (loaded_() == nullptr)
  {
    return times;
  }
  cl_ulong before = loaded_.getProfilingInfo<CL_PROFILING_COMMAND_START>();
  const auto until = [&before](const cl::Event& event) {
    if (event() == nullptr)
    {
      return 0.;
    }
    const cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    const double milliseconds = millisecondsBetween(before, end);
    before = end;
    return milliseconds;
  };
  times.filter = until(filtered_);
  times.edges = until(edges_found_);
  times.labels = until(labelled_);
  return times;
}

/** Drivers compile a kernel for its local size when it first runs: up to 0.4 s each that the first image would pay. */
void DeviceFill::warmUp()
{
  cv::Mat image(48, 80, CV_8UC3);
  cv::randu(image, 0, 256);
  cv::Mat edges;
  cv::Mat labels;
  std::vector<RegionSums> sums;
  for (const Filter kind : {Filter::gaussian, Filter::median})
  {
    for (const int size : {3, 5})
    {
      loadImage(image);
      filter(kind, size);
      findEdges(200);
      readEdges(edges);
      labelRegions(size == 3 ? FillMethod::runs : FillMethod::sweep, image.rows * image.cols);
      readLabels(labels);
      sumRegions(AreaWindow());
      readSums(sums);
      finish();
    }
  }
}

}  // namespace outdoor_omr
