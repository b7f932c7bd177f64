#ifndef OUTDOOR_OMR_DETECTOR_H
#define OUTDOOR_OMR_DETECTOR_H

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/frame.h"
#include "outdoor_omr/marker_network.h"
#include "outdoor_omr/markers.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"

namespace omr
{
class Worker;

/** The chain from image to markers (paper, Fig. 6); the only place that knows all its steps. Not thread-safe;
 * two threads of its own look for targets and reduce the image beside the fill pipeline. */
class Detector
{
 public:
  /** @param device and errors: see FillPipeline::FillPipeline(). */
  explicit Detector(const std::string& device = "auto");
  ~Detector();
  Detector(Detector&& other) noexcept;
  Detector& operator=(Detector&& other) noexcept;

  /** In the place of the default network, see omr_train. @throws std::invalid_argument: see checkNetwork(). */
  void setNetwork(const MarkerNetwork& network);

  /**
   * @param bgr      H x W, CV_8UC3, any row step.
   * @param settings checked before use.
   * @throws std::invalid_argument for an image or settings out of bounds; DeviceError if the device fails.
   */
  Markers detect(const cv::Mat& bgr, const Settings& settings);

  /**
   * The regions of the last image, their place and shape: Outputs::measures is off. Edges and labels are there if
   * Settings::overlay_regions asked for them.
   */
  const RegionMap& regions() const;

  const FillPipeline& pipeline() const;

 private:
  Markers findMarkers(const cv::Mat& bgr, const Settings& settings, const FillPipeline::Outputs& outputs,
                      RegionMap& regions, std::vector<StepTime>& times);

  FillPipeline pipeline_;
  MarkerNetwork network_ = defaultMarkerNetwork();
  Frame frame_;  // of the image at work; of the last one its memory
  RegionMap regions_;
  RegionMap enlarged_regions_;
  std::vector<MarkerScores> window_scores_;
  std::unique_ptr<Worker> target_worker_;
  std::unique_ptr<Worker> frame_worker_;
};

}  // namespace omr

#endif
