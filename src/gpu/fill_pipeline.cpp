#include "outdoor_omr/fill_pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "device_choice.h"
#include "device_fill.h"
#include "outdoor_omr/reference_fill.h"
#include "outdoor_omr/window_scores.h"

namespace omr
{
namespace
{
constexpr int MAX_SIDE = 65535;  // the kernels keep columns in 16 bits, and sums of squares of rows in 64

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
}  // namespace

void FillPipeline::checkImage(const cv::Mat& bgr)
{
  if (bgr.empty() || bgr.dims != 2 || bgr.type() != CV_8UC3)
  {
    throw std::invalid_argument("expected an image of type CV_8UC3 that is not empty");
  }
  if (std::max(bgr.cols, bgr.rows) > MAX_SIDE ||
      bgr.total() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw std::invalid_argument("the image of " + std::to_string(bgr.cols) + " x " + std::to_string(bgr.rows) +
                                " px is too large: at most 65535 px a side and 2^31 - 1 px");
  }
}

class FillPipeline::Implementation
{
 public:
  explicit Implementation(const std::string& device) : devices_(device)
  {
  }

  void run(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
           std::vector<StepTime>* times)
  {
    const Clock::time_point start = Clock::now();
    map.size = cv::Size();
    map.region_count = 0;
    map.regions.clear();
    DeviceFill::Times steps;
    const bool done =
        devices_.run([&](DeviceFill& device) { runOnDevice(device, bgr, settings, outputs, map, steps); });
    if (!done)
    {
      runReference(bgr, settings, outputs, map, steps);
    }
    giveBack(map.regions, sums_.capacity());
    map.regions.reserve(sums_.size());
    for (const RegionSums& sums : sums_)
    {
      map.regions.push_back(toRegion(sums));
    }
    map.size = bgr.size();
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

  const DeviceState& device() const
  {
    return devices_.state();
  }

  std::size_t bytes() const
  {
    return devices_.fill() ? devices_.fill()->bytes() : 0;
  }

 private:
  void runOnDevice(DeviceFill& device, const cv::Mat& bgr, const Settings& settings, const Outputs& outputs,
                   RegionMap& map, DeviceFill::Times& times)
  {
    device.loadImage(bgr, outputs.is_enlargement);
    if (outputs.network)
    {
      device.scoreWindows(*outputs.network, *outputs.window_scores);
    }
    device.filter(settings.filter, settings.filter_size);
    device.findEdges(edgeThreshold(settings));
    device.labelRegions(settings.fill_method, settings.sweep_rounds);
    outputs.labels ? device.readLabels(map.labels) : map.labels.release();
    outputs.edges ? device.readEdges(map.edges) : map.edges.release();
    device.sumRegions(areaWindow(settings, bgr), outputs.measures);
    map.region_count = device.readSums(sums_);
    device.finish();
    times = device.times();
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

  DeviceChoice devices_;
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
  if (outputs.network)
  {
    checkNetwork(*outputs.network);
    if (!outputs.window_scores)
    {
      throw std::invalid_argument("a network is given, but no window_scores that receive what it finds");
    }
  }
  implementation_->run(bgr, settings, outputs, map, times);
}

const DeviceState& FillPipeline::device() const
{
  return implementation_->device();
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
