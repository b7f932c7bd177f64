#include "reload_service.h"

#include <ros/console.h>
#include <std_srvs/Trigger.h>

#include <boost/function.hpp>

#include "caught.h"

namespace omr
{
std::string countOf(std::size_t count, const std::string& what)
{
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

ros::ServiceServer advertiseReload(ros::NodeHandle& private_nh, const Reload& reload)
{
  using Callback = boost::function<bool(std_srvs::TriggerRequest&, std_srvs::TriggerResponse&)>;
  const std::string node = private_nh.getNamespace();
  const Callback answer = [reload, node](std_srvs::TriggerRequest& /*request*/, std_srvs::TriggerResponse& response) {
    const std::string error = caught([&] { response.message = reload(); });
    response.success = error.empty() ? 1 : 0;
    if (error.empty())
    {
      ROS_INFO("%s: %s", node.c_str(), response.message.c_str());
    }
    else
    {
      response.message = error + "; what was read before stays in force";
      ROS_ERROR("%s: %s", node.c_str(), response.message.c_str());
    }
    return true;
  };
  return private_nh.advertiseService("reload", answer);
}

}  // namespace omr
