#ifndef OUTDOOR_OMR_ROS_STATUS_REPORT_H
#define OUTDOOR_OMR_ROS_STATUS_REPORT_H

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

namespace omr
{
/** Tells one status of a nodelet on /diagnostics, once a second (REP 107). */
class StatusReport
{
 public:
  using Report = std::function<void(diagnostic_updater::DiagnosticStatusWrapper&)>;

  /**
   * @param nh          of the queue that reports.
   * @param private_nh  of the same queue.
   * @param node        name of the node.
   * @param status      name of the status.
   * @param hardware    that it depends on, or "none".
   * @param report      fills it; called from the queue, what it throws is logged.
   */
  StatusReport(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& node,
               const std::string& status, const std::string& hardware, const Report& report);

 private:
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace omr

#endif
