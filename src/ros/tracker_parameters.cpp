#include "tracker_parameters.h"

#include "number_parameter.h"

namespace omr
{
TrackerSettings readTrackerSettings(const ros::NodeHandle& private_nh)
{
  TrackerSettings settings;
  settings.max_speed = readNumber(private_nh, "max_speed", settings.max_speed, 100);
  settings.memory = readNumber(private_nh, "memory", settings.memory, 3600);
  settings.smoothing = readNumber(private_nh, "smoothing", settings.smoothing, 60);
  return settings;
}

}  // namespace omr
