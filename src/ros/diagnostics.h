#ifndef OUTDOOR_OMR_ROS_DIAGNOSTICS_H
#define OUTDOOR_OMR_ROS_DIAGNOSTICS_H

#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "outdoor_omr/fill_pipeline.h"
#include "outdoor_omr/step_time.h"
#include "status_report.h"

namespace omr
{
/**
 * How a detector fares, told on /diagnostics once a second of wall time, also while simulated time stands still
 * (REP 107). Every function may be called from any thread.
 */
class Diagnostics
{
 public:
  /**
   * @param nh         of the queue that reports.
   * @param private_nh of the same queue.
   * @param name       of the node.
   * @param pipeline   whose device is named.
   */
  Diagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name,
              const FillPipeline& pipeline);

  /** @param topic where images come from now; empty when none are asked for. */
  void subscribed(const std::string& topic);

  /** Images are asked for, and cannot be subscribed to. */
  void notSubscribed(const std::string& reason);

  /** An image was replaced by a newer one before the detector had time for it. */
  void dropped();

  /** @param times of the steps of one image. */
  void processed(const std::vector<StepTime>& times);

  /** What an image was processed on, or could not be. */
  void ranOn(const DeviceState& device);

  /** An image could not be processed. */
  void refused(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  std::mutex mutex_;
  DeviceState device_;
  std::string topic_;
  std::string no_subscription_;   // why there is none; empty: there is, or none is asked for
  Clock::time_point last_image_;  // or the time of the subscription
  Clock::time_point last_report_;
  std::vector<StepTime> times_;
  std::string refusal_;
  std::uint64_t processed_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t processed_reported_ = 0;
  std::uint64_t refused_reported_ = 0;
  int failures_reported_ = 0;  // of the device
  double rate_ = 0;            // images processed a second

  StatusReport report_;  // the last member: it reports what stands above
};

}  // namespace omr

#endif
