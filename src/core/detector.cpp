#include "outdoor_omr/detector.h"

#include <chrono>
#include <future>
#include <utility>

#include "candidates/enlargement.h"
#include "checkerboards/checkerboards.h"
#include "outdoor_omr/candidates.h"
#include "outdoor_omr/frame.h"
#include "targets/targets.h"
#include "worker.h"

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

/** Lets go of an image at its end: the caller's pixels may be gone then. */
class ReleasedImage
{
 public:
  explicit ReleasedImage(cv::Mat& image) : image_(image)
  {
  }
  ReleasedImage(const ReleasedImage&) = delete;
  ReleasedImage& operator=(const ReleasedImage&) = delete;
  ~ReleasedImage()
  {
    image_.release();
  }

 private:
  cv::Mat& image_;
};
}  // namespace

Detector::Detector(const std::string& device)
    : pipeline_(device), target_worker_(std::make_unique<Worker>()), frame_worker_(std::make_unique<Worker>())
{
}

Detector::~Detector() = default;

Detector::Detector(Detector&& other) noexcept = default;

Detector& Detector::operator=(Detector&& other) noexcept = default;

void Detector::setNetwork(const MarkerNetwork& network)
{
  checkNetwork(network);
  network_ = network;
}

Markers Detector::findMarkers(const cv::Mat& bgr, const Settings& settings, const FillPipeline::Outputs& outputs,
                              RegionMap& regions, std::vector<StepTime>& times)
{
  const ReleasedImage released(frame_.bgr);  // after all tasks, also if one throws
  // Half of the search for targets and the pyramid need no regions: they are made beside the fill pipeline.
  TargetSearch targets(bgr, settings);
  Task image_look;
  if (settings.detect_targets)
  {
    image_look = target_worker_->begin([&] { targets.lookAtImage(); });
  }
  Task pyramid = frame_worker_->begin([&] {
    makeFrame(bgr, frame_);
    if (settings.detect_targets)
    {
      targets.lookAtGrey(frame_.raw_grey);
    }
  });
  pipeline_.run(bgr, settings, outputs, regions, &times);
  StopWatch watch(times);
  pyramid.get();
  watch.step("pyramid");
  Markers markers;
  Task look;
  std::promise<void> boards_expected;  // is destroyed before the look, which would wait for it
  if (settings.detect_targets)
  {
    look = target_worker_->begin([&, expected = boards_expected.get_future().share()] {
      image_look.get();
      expected.get();
      targets.lookAtRest(regions);
    });
  }
  const auto expect = [&](const std::vector<Checkerboard>& boards) {
    targets.expect(boards);
    boards_expected.set_value();
  };
  if (settings.detect_checkerboards)
  {
    markers.checkerboards = findCheckerboards(frame_, regions, settings, expect, &markers.sections);
    targets.confirm(markers.checkerboards);
    watch.step("checkerboards");
  }
  else
  {
    expect({});
  }
  if (settings.detect_targets)
  {
    look.get();
    markers.targets = targets.finish(regions, markers.checkerboards);
    watch.step("targets");
  }
  return markers;
}

Markers Detector::detect(const cv::Mat& bgr, const Settings& settings)
{
  settings.check();
  FillPipeline::checkImage(bgr);  // before the threads beside the pipeline look at it
  const bool candidates = settings.candidate_mode != CandidateMode::none;
  std::vector<StepTime> times;
  FillPipeline::Outputs outputs;
  outputs.measures = false;  // no marker needs them: the whole frame takes 5 % less
  outputs.edges = outputs.labels = settings.overlay_regions;
  outputs.network = candidates ? &network_ : nullptr;
  outputs.window_scores = &window_scores_;
  Markers markers = findMarkers(bgr, settings, outputs, regions_, times);
  if (candidates)
  {
    StopWatch watch(times);
    markers.candidates = findCandidates(bgr.size(), window_scores_, network_);
    markRead(bgr.size(), markers.checkerboards, markers.targets, markers.candidates);
    FillPipeline::Outputs of_enlarged;
    of_enlarged.measures = false;
    of_enlarged.is_enlargement = true;
    const auto detect = [&](const cv::Mat& enlarged) {
      std::vector<StepTime> own_times;  // those of the frame's steps shall not be there twice
      return findMarkers(enlarged, settings, of_enlarged, enlarged_regions_, own_times);
    };
    removeDoubtful(network_, &BoxEvidence::enlarged, markers.candidates);
    readEnlarged(bgr, settings.candidate_looks, detect, markers);
    markRead(bgr.size(), markers.checkerboards, markers.targets, markers.candidates);
    removeDoubtful(network_, &BoxEvidence::shown, markers.candidates);
    watch.step("enlargements");
    if (settings.candidate_mode == CandidateMode::enlarge)
    {
      markers.candidates.clear();
    }
  }
  markers.times = std::move(times);
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
