#ifndef OUTDOOR_OMR_ROS_RELOAD_SERVICE_H
#define OUTDOOR_OMR_ROS_RELOAD_SERVICE_H

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <cstddef>
#include <functional>
#include <string>

namespace omr
{
/** As "1 part", "2 parts". */
std::string countOf(std::size_t count, const std::string& what);

/** Reads a nodelet's file and puts what it says in force. @return what was read, in words. Throws without a change. */
using Reload = std::function<std::string()>;

/**
 * The service ~reload (std_srvs/Trigger), so that a file can be changed while the nodelet runs. It answers what was
 * read or which mistake the file has, and logs the same.
 *
 * @param private_nh whose queue the service is called from.
 */
ros::ServiceServer advertiseReload(ros::NodeHandle& private_nh, const Reload& reload);

}  // namespace omr

#endif
