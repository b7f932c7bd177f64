#ifndef OUTDOOR_OMR_TEST_NODELET_MANAGER_H
#define OUTDOOR_OMR_TEST_NODELET_MANAGER_H

#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "child_process.h"

namespace ros_test
{
/** A nodelet manager in a process of its own, /manager, into which the test loads the detector. */
class NodeletManager
{
 public:
  NodeletManager() : process_({"rosrun", "nodelet", "nodelet", "manager", "__name:=manager"})
  {
    if (!ros::service::waitForService("/manager/load_nodelet", ros::Duration(20)))
    {
      throw std::runtime_error("the nodelet manager does not come up");
    }
  }

  /** @return whether /NAME was loaded. */
  static bool load(const std::string& name = "detector")
  {
    nodelet::NodeletLoad call;
    call.request.name = "/" + name;
    call.request.type = "outdoor_omr/" + name;
    return ros::service::call("/manager/load_nodelet", call) && call.response.success;
  }

  static bool unload()
  {
    nodelet::NodeletUnload call;
    call.request.name = "/detector";
    return ros::service::call("/manager/unload_nodelet", call) && call.response.success;
  }

  static bool alive()
  {
    nodelet::NodeletList call;
    return ros::service::call("/manager/list", call);
  }

  /** Ends it with Ctrl-C. @return its exit status. */
  int interrupt()
  {
    return process_.interrupt();
  }

 private:
  ChildProcess process_;
};

}  // namespace ros_test

#endif
