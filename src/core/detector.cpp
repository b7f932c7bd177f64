#include "outdoor_omr/detector.h"

#include <chrono>
#include <future>

#include "outdoor_omr/checkerboards.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/targets.h"

namespace omr
{
namespace
{
/** Appends the time since its creation, or since the last call of step(). */
class StopWatch
{
 public:
  explicit StopWatch(std::vector<StepTime>& times) : times_(times), start_(Clock::now())
  {
  }

  void step(const std::string& name)
  {
    const Clock::time_point now = Clock::now();
    times_.push_back({name, std::chrono::duration<double, std::milli>(now - start_).count()});
    start_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StepTime>& times_;
  Clock::time_point start_;
};
}  // namespace

Detector::Detector(const std::string& device) : pipeline_(device)
{
}

Markers Detector::detect(const cv::Mat& bgr, const Settings& settings)
{
  settings.check();
  Markers markers;
  FillPipeline::Outputs outputs;
  outputs.edges = outputs.labels = settings.overlay_regions;
  pipeline_.run(bgr, settings, outputs, regions_, &markers.times);
  StopWatch watch(markers.times);
  const Frame frame = makeFrame(bgr);
  watch.step("pyramid");
  TargetSearch targets(frame, regions_, settings);
  std::future<void> ahead;
  if (settings.detect_checkerboards && settings.detect_targets)
  {
    ahead = std::async([&targets] { targets.lookAhead(); });
  }
  if (settings.detect_checkerboards)
  {
    markers.checkerboards = findCheckerboards(frame, regions_, settings);
    watch.step("checkerboards");
  }
  if (settings.detect_targets)
  {
    if (ahead.valid())
    {
      ahead.get();
    }
    markers.targets = targets.finish(markers.checkerboards);
    watch.step("targets");
  }
  return markers;
}

const RegionMap& Detector::regions() const
{
  return regions_;
}

const FillPipeline& Detector::pipeline() const
{
  return pipeline_;
}

}  // namespace omr
