#ifndef OUTDOOR_OMR_ROS_CAUGHT_H
#define OUTDOOR_OMR_ROS_CAUGHT_H

#include <functional>
#include <string>

namespace omr
{
/**
 * Runs an action and returns the text of what it threw, empty if nothing: the one place of the ROS layer that catches.
 * An exception that leaves an image callback ends the whole nodelet manager, every camera driver in it included.
 */
std::string caught(const std::function<void()>& action);

}  // namespace omr

#endif
