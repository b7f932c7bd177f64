#include "device_fill.h"

#include <array>
#include <cstddef>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace omr
{
namespace
{
constexpr int GPU_LANES = 64;  // a wavefront of AMD, two warps of NVIDIA

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
      shares_memory_(device.isCpu()),
      compute_units_(static_cast<int>(device.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()))
{
  try
  {
    warmUp();
  }
  catch (...)
  {
    abandon();
    throw;
  }
#ifdef __GLIBC__
  // What PoCL freed after it had loaded the kernels: a process with one detector takes 185 instead of 190 MB at 1080p.
  malloc_trim(0);
#endif
}

Groups DeviceFill::rows() const
{
  return {static_cast<std::size_t>(size_.height), 1};
}

void DeviceFill::loadImage(const cv::Mat& bgr, bool is_enlargement)
{
  bgr_ = bgr;
  size_ = bgr.size();
  is_enlargement_ = is_enlargement;
  loaded_ = scored_ = filtered_ = edges_found_ = labelled_ = cl::Event();
  buffers_.reserve(context_, size_, stripsOfDevice(), !is_enlargement);
  if (!is_enlargement)
  {
    restUnused();
  }
  const std::size_t row_bytes = static_cast<std::size_t>(size_.width) * 3;
  if (shares_memory_)
  {
    step_ = static_cast<cl_long>(bgr.step[0]);
    image_ =
        cl::Buffer(context_, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, step_ * (size_.height - 1) + row_bytes, bgr.data);
    return;
  }
  step_ = static_cast<cl_long>(row_bytes);
  is_enlargement ? upload_.grow(context_, size_.height, row_bytes) : upload_.reserve(context_, size_.height, row_bytes);
  image_ = *upload_;
  const std::array<std::size_t, 3> origin = {0, 0, 0};
  const std::array<std::size_t, 3> region = {row_bytes, static_cast<std::size_t>(size_.height), 1};
  queue_.enqueueWriteBufferRect(image_, CL_FALSE, origin, origin, region, row_bytes, 0, bgr.step[0], 0, bgr.data,
                                nullptr, &loaded_);
}

/** What not every image needs counts the images without. */
void DeviceFill::restUnused()
{
  for (GrowingBuffer* buffer : {&edge_image_, &label_image_, &sweep_labels_})
  {
    buffer->rest();
  }
  images_without_windows_ = windows_ ? images_without_windows_ + 1 : 0;
  if (images_without_windows_ > PATIENCE)
  {
    windows_.reset();
  }
}

void DeviceFill::filter(Filter filter, int size)
{
  if (filter == Filter::none)
  {
    return;
  }
  const char* gaussian = size == 3 ? "gaussian3" : "gaussian5";
  const char* median = size == 3 ? "median3" : "median5";
  launch(filter == Filter::gaussian ? gaussian : median, rows(), image_, step_, size_.width, size_.height,
         *buffers_.filtered);
  filtered_ = last_event_;
  image_ = *buffers_.filtered;
  step_ = static_cast<cl_long>(size_.width) * 3;
}

void DeviceFill::findEdges(const EdgeThreshold& threshold)
{
  const bool by_strips = geometry_ == Geometry::strips;
  const Groups tiles = {static_cast<std::size_t>(divideUp(size_.width, EDGE_TILE_WIDTH)),
                        static_cast<std::size_t>(divideUp(size_.height, EDGE_TILE_HEIGHT))};
  if (threshold.floor < threshold.fixed)
  {
    launch(by_strips ? "strengthStrip" : "strengthTile", tiles, image_, step_, size_.width, size_.height,
           *buffers_.strength);
  }
  launch(by_strips ? "edgesStrip" : "edgesWord",
         {tiles.x, by_strips ? tiles.y : static_cast<std::size_t>(size_.height)}, image_, step_, size_.width,
         size_.height, *buffers_.strength, threshold.floor, threshold.fixed, *buffers_.mask);
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

std::size_t DeviceFill::bytes() const
{
  return buffers_.bytes() + (windows_ ? windows_->bytes() : 0) + upload_.bytes() + edge_image_.bytes() +
         label_image_.bytes() + sweep_labels_.bytes();
}

void DeviceFill::finish()
{
  queue_.finish();
  image_ = cl::Buffer();
  bgr_.release();
}

void DeviceFill::abandon()
{
  try
  {
    queue_.finish();
    image_ = cl::Buffer();
  }
  catch (const cl::Error&)
  {
    // A queue that cannot be waited for is broken, and nothing is at work in it.
  }
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
  times.candidates = until(scored_);
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
  std::vector<MarkerScores> scores;
  for (const Filter kind : {Filter::gaussian, Filter::median})
  {
    for (const int size : {3, 5})
    {
      loadImage(image);
      scoreWindows(defaultMarkerNetwork(), scores);
      filter(kind, size);
      findEdges({200, size == 3 ? 200 : 100});
      labelRegions(size == 3 ? FillMethod::runs : FillMethod::sweep, image.rows * image.cols);
      readLabels(labels);
      readEdges(edges);
      sumRegions(AreaWindow());
      readSums(sums);
      finish();
    }
  }
  windows_.reset();
  edge_image_.free();
  label_image_.free();
  sweep_labels_.free();
}

}  // namespace omr
