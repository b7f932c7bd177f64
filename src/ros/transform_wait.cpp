#include "transform_wait.h"

namespace omr
{
geometry_msgs::TransformStamped lookupWithin(const tf2_ros::Buffer& buffer, const std::string& target,
                                             const std::string& source, const ros::Time& time,
                                             const ros::WallDuration& patience)
{
  constexpr double POLL = 0.002;  // [s]
  const ros::WallTime end = ros::WallTime::now() + patience;
  while (!buffer.canTransform(target, source, time) && ros::WallTime::now() < end)
  {
    ros::WallDuration(POLL).sleep();
  }
  return buffer.lookupTransform(target, source, time);
}

}  // namespace omr
