#ifndef OUTDOOR_OMR_ROS_POSITION_DIAGNOSTICS_H
#define OUTDOOR_OMR_ROS_POSITION_DIAGNOSTICS_H

#include <outdoor_omr/PartArray.h>
#include <ros/node_handle.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

#include "status_report.h"

namespace omr
{
/** What the position nodelet gets and gives, told on /diagnostics once a second. Any thread may call. */
class PositionDiagnostics
{
 public:
  /**
   * @param nh         of the queue that reports.
   * @param private_nh of the same queue.
   * @param name       of the node.
   */
  PositionDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name);

  void markersCame();
  void cameraInfoCame();

  /** An image was located. @param parts what was found, the ambiguous as well. */
  void located(const outdoor_omr::PartArray& parts);

  /** Nothing could be said of an image. */
  void refused(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  std::mutex mutex_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_markers_ = start_;
  Clock::time_point last_camera_info_ = start_;
  Clock::time_point last_match_ = start_;  // of markers and camera_info
  std::string refusal_;                    // of the last image; empty: located
  std::uint64_t images_ = 0;
  std::uint64_t refused_ = 0;
  int parts_ = 0;
  int ambiguous_ = 0;
  std::string ambiguous_names_;

  const std::string markers_topics_;
  const std::string camera_info_topic_;

  StatusReport report_;  // the last member: it reports what stands above
};

}  // namespace omr

#endif
