#include "status_report.h"

#include <ros/console.h>

#include "caught.h"

namespace omr
{
StatusReport::StatusReport(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh, const std::string& node,
                           const std::string& status, const std::string& hardware, const Report& report)
    : updater_(nh, private_nh, node)
{
  constexpr double PERIOD = 1;  // [s]
  updater_.setHardwareID(hardware);
  updater_.add(status, report);
  timer_ = nh.createWallTimer(ros::WallDuration(PERIOD), [this](const ros::WallTimerEvent& /*event*/) {
    const std::string error = caught([this] { updater_.force_update(); });
    ROS_ERROR_COND(!error.empty(), "diagnostics: %s", error.c_str());
  });
}

}  // namespace omr
