#include "outdoor_omr/fill_pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "device_fill.h"
#include "kernel_cache.h"
#include "outdoor_omr/reference_fill.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
constexpr int MAX_WIDTH = 65535;  // the kernels keep columns in 16 bits

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

AreaWindow areaWindow(const Settings& settings, const cv::Mat& bgr)
{
  AreaWindow window;
  window.min = settings.region_min_area;
  window.max = static_cast<cl_uint>(std::floor(settings.region_max_share * static_cast<double>(bgr.total())));
  return window;
}

/** Opens the first device that works; the reasons why others did not are appended to failures. */
std::unique_ptr<DeviceFill> openDevice(const std::vector<Device>& devices, std::string& name, std::string& failures)
{
  for (const Device& device : devices)
  {
    try
    {
      fillKernelCache(device);
      auto fill = std::make_unique<DeviceFill>(device, device.isCpu() ? Geometry::strips : Geometry::words);
      name = device.description;
      return fill;
    }
    catch (const cl::Error& error)
    {
      failures += (failures.empty() ? "" : "\n") + describeError(error, device.description);
    }
    catch (const DeviceError& error)
    {
      failures += (failures.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  return nullptr;
}
}  // namespace

void FillPipeline::checkImage(const cv::Mat& bgr)
{
  if (bgr.empty() || bgr.dims != 2 || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
  if (bgr.cols > MAX_WIDTH || bgr.total() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw std::invalid_argument("the image of " + std::to_string(bgr.cols) + " x " + std::to_string(bgr.rows) +
                                " px is too large: at most 65535 px wide and 2^31 - 1 px");
  }
}

class FillPipeline::Implementation
{
 public:
  explicit Implementation(const std::string& device)
  {
    if (device == "reference")
    {
      return;
    }
    const std::vector<Device> devices = selectDevices(device);
    std::string failures;
    fill_ = openDevice(devices, name_, failures);
    if (!fill_ && device != "auto")
    {
      throw DeviceError(failures);
    }
    if (!fill_)
    {
      fallback_reason_ = devices.empty() ? "no OpenCL device is present" : failures;
    }
  }

  void run(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
           std::vector<StepTime>* times)
  {
    const Clock::time_point start = Clock::now();
    DeviceFill::Times steps;
    map.size = bgr.size();
    if (fill_)
    {
      runOnDevice(bgr, settings, outputs, map, steps);
    }
    else
    {
      runReference(bgr, settings, outputs, map, steps);
    }
    map.regions.clear();
    giveBack(map.regions, sums_.capacity());
    map.regions.reserve(sums_.size());
    for (const RegionSums& sums : sums_)
    {
      map.regions.push_back(toRegion(sums));
    }
    if (times)
    {
      const double rest = millisecondsSince(start) - steps.candidates - steps.filter - steps.edges - steps.labels;
      if (outputs.network)
      {
        times->push_back({"candidates", steps.candidates});
      }
      times->push_back({"filter", steps.filter});
      times->push_back({"edges", steps.edges});
      times->push_back({"labels", steps.labels});
      times->push_back({"region data", rest});
    }
  }

  const std::string& name() const
  {
    return name_;
  }

  const std::string& fallbackReason() const
  {
    return fallback_reason_;
  }

  std::size_t bytes() const
  {
    return fill_ ? fill_->bytes() : 0;
  }

 private:
  void runOnDevice(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
                   DeviceFill::Times& times)
  {
    try
    {
      fill_->loadImage(bgr);
      if (outputs.network)
      {
        fill_->scoreWindows(*outputs.network, *outputs.window_scores);
      }
      else
      {
        fill_->spareWindows();
      }
      fill_->filter(settings.filter, settings.filter_size);
      fill_->findEdges(edgeThreshold(settings));
      fill_->labelRegions(settings.fill_method, settings.sweep_rounds);
      readOutputs(outputs, map);
      fill_->sumRegions(areaWindow(settings, bgr), outputs.measures);
      map.region_count = fill_->readSums(sums_);
      fill_->finish();
      times = fill_->times();
    }
    catch (const cl::Error& error)
    {
      abandon();
      throw DeviceError(describeError(error, name_));
    }
  }

  void readOutputs(const Outputs& outputs, RegionMap& map)
  {
    outputs.labels ? fill_->readLabels(map.labels) : map.labels.release();
    outputs.edges ? fill_->readEdges(map.edges) : map.edges.release();
  }

  /** After an error: the device must not read or write the caller's memory any more. */
  void abandon()
  {
    try
    {
      fill_->finish();
    }
    catch (const cl::Error&)  // the first error is the one to report
    {
    }
  }

  void runReference(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
                    DeviceFill::Times& times)
  {
    Clock::time_point start = Clock::now();
    const auto lap = [&start] {
      const double milliseconds = millisecondsSince(start);
      start = Clock::now();
      return milliseconds;
    };
    if (outputs.network)
    {
      *outputs.window_scores = windowScores(bgr, *outputs.network);
      times.candidates = lap();
    }
    const cv::Mat filtered = filterImage(bgr, settings.filter, settings.filter_size);
    times.filter = lap();
    const cv::Mat edges = edgeMask(filtered, edgeThreshold(settings));
    times.edges = lap();
    const cv::Mat labels = labelRegions(edges);
    times.labels = lap();
    sums_ = sumRegions(filtered, edges, labels);
    map.region_count = static_cast<int>(sums_.size());
    const AreaWindow window = areaWindow(settings, bgr);
    sums_.erase(std::remove_if(sums_.begin(), sums_.end(),
                               [&](const RegionSums& s) { return s.area < window.min || s.area > window.max; }),
                sums_.end());
    map.edges = outputs.edges ? edges : cv::Mat();
    map.labels = outputs.labels ? labels : cv::Mat();
  }

  std::unique_ptr<DeviceFill> fill_;  // null: the reference
  std::string name_ = "reference (no OpenCL)";
  std::string fallback_reason_;
  std::vector<RegionSums> sums_;
};

FillPipeline::FillPipeline(const std::string& device) : implementation_(std::make_unique<Implementation>(device))
{
}

FillPipeline::~FillPipeline() = default;
FillPipeline::FillPipeline(FillPipeline&&) noexcept = default;
FillPipeline& FillPipeline::operator=(FillPipeline&&) noexcept = default;

void FillPipeline::run(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
                       std::vector<StepTime>* times)
{
  checkImage(bgr);
  settings.check();
  implementation_->run(bgr, settings, outputs, map, times);
}

const std::string& FillPipeline::deviceName() const
{
  return implementation_->name();
}

const std::string& FillPipeline::fallbackReason() const
{
  return implementation_->fallbackReason();
}

std::size_t FillPipeline::bufferBytes() const
{
  return implementation_->bytes();
}

std::vector<std::string> FillPipeline::devices()
{
  std::vector<std::string> descriptions;
  for (const Device& device : findDevices())
  {
    descriptions.push_back(device.description);
  }
  return descriptions;
}

}  // namespace omr
