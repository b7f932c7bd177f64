#include "transform_wait.h"

namespace omr
{
TransformWait::TransformWait(const tf2_ros::Buffer& buffer, const ros::WallDuration& patience)
    : buffer_(buffer), patience_(patience)
{
}

geometry_msgs::TransformStamped TransformWait::lookup(const std::string& target, const std::string& source,
                                                      const ros::Time& time)
{
  constexpr double POLL = 0.002;  // [s]
  const auto in_vain = in_vain_.find({target, source});
  bool is_there = buffer_.canTransform(target, source, time);
  if (!is_there && (in_vain == in_vain_.end() || newest(target, source) != in_vain->second))
  {
    const ros::WallTime end = ros::WallTime::now() + patience_;
    while (!is_there && ros::WallTime::now() < end)
    {
      ros::WallDuration(POLL).sleep();
      is_there = buffer_.canTransform(target, source, time);
    }
    if (!is_there)
    {
      in_vain_[{target, source}] = newest(target, source);
    }
  }
  return buffer_.lookupTransform(target, source, time);
}

/** Time of the newest transform; 0 if there is none. */
ros::Time TransformWait::newest(const std::string& target, const std::string& source) const
{
  return buffer_.canTransform(target, source, ros::Time())
             ? buffer_.lookupTransform(target, source, ros::Time()).header.stamp
             : ros::Time();
}

}  // namespace omr
