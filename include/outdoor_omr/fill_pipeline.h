#ifndef OUTDOOR_OMR_FILL_PIPELINE_H
#define OUTDOOR_OMR_FILL_PIPELINE_H

#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "outdoor_omr/marker_network.h"
#include "outdoor_omr/region.h"
#include "outdoor_omr/settings.h"
#include "outdoor_omr/step_time.h"

namespace omr
{
/** The OpenCL device is absent, or it failed: the message carries the driver's words. */
class DeviceError : public std::runtime_error
{
 public:
  using std::runtime_error::runtime_error;
};

/** Which device is at work. */
struct DeviceState
{
  std::string name;             ///< its description, see FillPipeline::devices(); "reference (no OpenCL)": plain C++
  std::string fallback_reason;  ///< why those that come before it are not used, in their drivers' words; else empty
  int failures = 0;             ///< times that a device failed on an image, this one or one before it
  std::string last_failure;     ///< in the driver's words
};

/**
 * Image in, regions out (paper, sections 3.1 and 3.2, Table 1): filter, colour edges, seedless filling and region data
 * on an OpenCL device.
 *
 * Buffers are kept between images; they grow when an image needs more, and shrink when 100 images in a row needed less
 * than a quarter of one. docs/performance.md says how large they are. Not thread-safe: one pipeline a thread.
 *
 * A device that fails on an image is opened anew and tries again; if it fails once more the next one takes its place.
 */
class FillPipeline
{
 public:
  /** What run() shall bring back beside place and shape of the regions; each costs time. */
  struct Outputs
  {
    /** Region::color, perimeter, mean_distance and distance_deviation, which mean nothing without. */
    bool measures = true;
    bool edges = false;                      ///< RegionMap::edges
    bool labels = false;                     ///< RegionMap::labels
    bool is_enlargement = false;             ///< of a part of the last image: the buffers that one needs are kept
    const MarkerNetwork* network = nullptr;  ///< if not null, the preliminary detection runs too (section 4.5)
    std::vector<MarkerScores>* window_scores = nullptr;  ///< if network is not null, receives windowScores()
  };

  /**
   * Chooses a device, builds the kernels and runs them once, so that the first image costs little more than the next.
   * The kernels take seconds to build where the driver keeps no cache of them.
   *
   * @param device "auto": the first that works of the GPUs, the CPU devices, other devices and the reference; "gpu" or
   * "cpu": of that type; "reference": plain C++; anything else: of those whose description (see devices()) contains
   * this text, regardless of case.
   * @throws DeviceError unless device is "auto" or "reference": if there is no such device (the message lists those
   *                     present), or if none of them works: the message has what each driver says, and the build log
   *                     of kernels that do not build.
   */
  explicit FillPipeline(const std::string& device = "auto");
  ~FillPipeline();
  FillPipeline(FillPipeline&&) noexcept;
  FillPipeline& operator=(FillPipeline&&) noexcept;

  /** @throws std::invalid_argument for an image that run() would refuse. */
  static void checkImage(const cv::Mat& bgr);

  /**
   * Runs the pipeline on one image.
   *
   * @param bgr      H x W, CV_8UC3, any row step; at most 65535 px a side and 2^31 - 1 pixels.
   * @param settings the tunables of group "fill".
   * @param outputs  what to bring back.
   * @param map      receives the result; its memory is reused. After an exception it has no region and no size.
   * @param times    if not null, filter, edges, labels and region data are appended [ms], before them candidates if a
   *                 network is given; they add up to the whole run.
   * @throws std::invalid_argument if bgr is empty, too large or of another type, a tunable is out of bounds, or the
   *         network is incomplete; DeviceError if all devices that may be used fail or lack the memory, which "auto"
   *         and "reference" never say. The next image may be run all the same.
   */
  void run(const cv::Mat& bgr, const Settings& settings, const Outputs& outputs, RegionMap& map,
           std::vector<StepTime>* times = nullptr);

  const DeviceState& device() const;

  /** Bytes of the buffers on the device, which is the host's memory where the device is a CPU; 0 for plain C++. */
  std::size_t bufferBytes() const;

  /** "platform: device (type)" of every OpenCL device of this machine; empty when there is none. */
  static std::vector<std::string> devices();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace omr

#endif
