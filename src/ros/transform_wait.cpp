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
  bool is_there = buffer_.canTransform(target, source, time);
  if (!is_there && isWorthIt(target, source, time))
  {
    const ros::WallTime end = ros::WallTime::now() + patience_;
    while (!is_there && ros::WallTime::now() < end)
    {
      ros::WallDuration(POLL).sleep();
      is_there = buffer_.canTransform(target, source, time);
    }
  }
  is_there ? void(in_vain_.erase({target, source})) : void(in_vain_.insert({target, source}));
  return buffer_.lookupTransform(target, source, time);
}

/** Whether what comes within the patience may reach the time. */
bool TransformWait::isWorthIt(const std::string& target, const std::string& source, const ros::Time& time) const
{
  const ros::Duration patience(patience_.toSec());
  return in_vain_.count({target, source}) == 0 ||
         (time > ros::Time() + patience && buffer_.canTransform(target, source, time - patience));
}

}  // namespace omr
