#ifndef OUTDOOR_OMR_ROS_TRACKER_PARAMETERS_H
#define OUTDOOR_OMR_ROS_TRACKER_PARAMETERS_H

#include <ros/node_handle.h>

#include "outdoor_omr/part_tracker.h"

namespace omr
{
/** ~max_speed [m/s], ~memory [s] and ~smoothing [s]. @throws std::invalid_argument naming one out of bounds. */
TrackerSettings readTrackerSettings(const ros::NodeHandle& private_nh);

}  // namespace omr

#endif
