#ifndef OUTDOOR_OMR_ROS_POSITION_DIAGNOSTICS_H
#define OUTDOOR_OMR_ROS_POSITION_DIAGNOSTICS_H

#include <outdoor_omr/PartArray.h>
#include <ros/node_handle.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "status_report.h"

namespace omr
{
enum class PositionInput
{
  checkerboards,
  targets,
  camera_info
};

/** What the position nodelet gets and gives, told on /diagnostics once a second. Any thread may call. */
class PositionDiagnostics
{
 public:
  /**
   * @param nh         of the queue that reports.
   * @param private_nh of the same queue.
   * @param name       of the node.
   * @param parts      names of those in the parts file.
   */
  PositionDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& name,
                      const std::vector<std::string>& parts);

  /** The parts file was read anew. @param parts names of those in it. */
  void partsAre(const std::vector<std::string>& parts);

  void came(PositionInput input);

  /** An image was located. @param parts what was found, the ambiguous as well. */
  void located(const outdoor_omr::PartArray& parts);

  /** Nothing could be said of an image. */
  void refused(const std::string& reason);

 private:
  using Clock = std::chrono::steady_clock;

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);
  void summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  /** Since a message of it, or the start [s]. */
  double silence(PositionInput input) const;
  const std::string& topicOf(PositionInput input) const;

  std::mutex mutex_;
  const Clock::time_point start_ = Clock::now();
  std::array<Clock::time_point, 3> last_{start_, start_, start_};  // of each input
  Clock::time_point last_match_ = start_;                          // of all inputs
  std::map<std::string, std::optional<Clock::time_point>> seen_;   // when each part was, certain of its pose
  std::string refusal_;                                            // of the last image; empty: located
  std::uint64_t images_ = 0;
  std::uint64_t refused_ = 0;
  int parts_ = 0;
  int ambiguous_ = 0;
  std::string ambiguous_names_;
  std::string misfits_;  // in the last image

  const std::array<std::string, 3> topics_;

  StatusReport report_;  // the last member: it reports what stands above
};

}  // namespace omr

#endif
