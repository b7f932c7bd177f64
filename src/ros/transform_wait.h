#ifndef OUTDOOR_OMR_ROS_TRANSFORM_WAIT_H
#define OUTDOOR_OMR_ROS_TRANSFORM_WAIT_H

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <string>

namespace omr
{
/**
 * A transform, waited for in wall time: tf2's own wait never ends while simulated time stands still, as in a paused
 * bag.
 *
 * @param buffer   filled by a thread of its own.
 * @param patience longest wait.
 * @throws tf2::TransformException if it does not come.
 */
geometry_msgs::TransformStamped lookupWithin(const tf2_ros::Buffer& buffer, const std::string& target,
                                             const std::string& source, const ros::Time& time,
                                             const ros::WallDuration& patience);

}  // namespace omr

#endif
