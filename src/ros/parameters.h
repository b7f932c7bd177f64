#ifndef OUTDOOR_OMR_ROS_PARAMETERS_H
#define OUTDOOR_OMR_ROS_PARAMETERS_H

#include <outdoor_omr/OmrConfig.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "outdoor_omr/settings.h"

namespace omr
{
/** @throws std::invalid_argument naming the parameter, when a word is none of its choices or a value is refused. */
Settings toSettings(const outdoor_omr::OmrConfig& config);

/**
 * Looks through the parameters that are set in a detector's private namespace, before dynamic_reconfigure reads them:
 * it would leave out unknown names and values of the wrong type, and clamp numbers, without a word.
 *
 * A value that cannot be used is deleted, so that the default stays.
 *
 * @return one sentence for each name that no one reads, with the nearest known name, and for each value not used.
 */
std::vector<std::string> checkParameters(const ros::NodeHandle& private_nh);

}  // namespace omr

#endif
