#ifndef OUTDOOR_OMR_DETECTOR_H
#define OUTDOOR_OMR_DETECTOR_H

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "outdoor_omr/checkerboard.h"
#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"
#include "outdoor_omr/step_time.h"
#include "outdoor_omr/target.h"

namespace omr
{
/** All markers of one image. */
struct Markers
{
  std::vector<Checkerboard> checkerboards;
  std::vector<Target> targets;
  std::vector<StepTime> times;  ///< in the order of the steps
};

/** The chain from image to markers (paper, Fig. 6); the only place that knows all its steps. Not thread-safe;
 * targets are searched in a second thread while boards are. */
class Detector
{
 public:
  /** @param device and errors: see FillPipeline::FillPipeline(). */
  explicit Detector(const std::string& device = "auto");

  /**
   * @param bgr      H x W, CV_8UC3, any row step.
   * @param settings checked before use.
   * @throws std::invalid_argument for an image or settings out of bounds; DeviceError if the device fails.
   */
  Markers detect(const cv::Mat& bgr, const Settings& settings);

  /** The regions of the last image; edges and labels are there if Settings::overlay_regions asked for them. */
  const RegionMap& regions() const;

  const FillPipeline& pipeline() const;

 private:
  FillPipeline pipeline_;
  RegionMap regions_;
};

}  // namespace omr

#endif
