#ifndef OUTDOOR_OMR_ROS_NUMBER_PARAMETER_H
#define OUTDOOR_OMR_ROS_NUMBER_PARAMETER_H

#include <ros/node_handle.h>

#include <stdexcept>
#include <string>

namespace omr
{
/** A parameter of 0 to max, whole or not. @throws std::invalid_argument naming it, for anything else. */
inline double readNumber(const ros::NodeHandle& private_nh, const std::string& name, double usual, double max)
{
  XmlRpc::XmlRpcValue value;
  if (!private_nh.getParam(name, value))
  {
    return usual;
  }
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("parameter ~" + name + ": expected a number of 0 to " + std::to_string(max) + ", not " +
                                what);
  };
  double number = 0;
  if (!private_nh.getParam(name, number))  // which takes whole numbers too
  {
    fail(value.toXml());
  }
  if (!(number >= 0 && number <= max))
  {
    fail(std::to_string(number));
  }
  return number;
}

}  // namespace omr

#endif
