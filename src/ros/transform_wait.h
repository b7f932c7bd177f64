#ifndef OUTDOOR_OMR_ROS_TRANSFORM_WAIT_H
#define OUTDOOR_OMR_ROS_TRANSFORM_WAIT_H

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <string>
#include <utility>

namespace omr
{
/**
 * Transforms, waited for in wall time: tf2's own wait never ends while simulated time stands still, as in a paused bag.
 * Frames that were waited for in vain are waited for again only once TF has told something newer of them: a frame that
 * is unknown or no longer sent costs one wait, and not one of each message, behind which all later ones would queue.
 */
class TransformWait
{
 public:
  /**
   * @param buffer   filled by a thread of its own; outlives this.
   * @param patience longest wait; longer than the period at which TF is sent, or else what comes next is not waited
   * for.
   */
  TransformWait(const tf2_ros::Buffer& buffer, const ros::WallDuration& patience);

  /** @throws tf2::TransformException if it is not there in time. */
  geometry_msgs::TransformStamped lookup(const std::string& target, const std::string& source, const ros::Time& time);

 private:
  ros::Time newest(const std::string& target, const std::string& source) const;

  const tf2_ros::Buffer& buffer_;
  ros::WallDuration patience_;
  std::map<std::pair<std::string, std::string>, ros::Time> in_vain_;  // what TF knew of these when the wait ended
};

}  // namespace omr

#endif
