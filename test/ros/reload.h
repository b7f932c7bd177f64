#ifndef OUTDOOR_OMR_TEST_RELOAD_H
#define OUTDOOR_OMR_TEST_RELOAD_H

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <cstdio>
#include <string>

#include "own_folder.h"

namespace ros_test
{
/** A file of its own for a nodelet that reads one at the start, until it goes: then the nodelet has its first again. */
class ReloadedFile
{
 public:
  /** @param node its name, as /position. @param parameter that names the file. */
  ReloadedFile(const std::string& node, const std::string& parameter)
      : node_(node),
        parameter_(node + "/" + parameter),
        first_(ros::NodeHandle().param<std::string>(parameter_, "")),
        path_(omr::test::ownPath(parameter + ".yaml"))
  {
    ros::NodeHandle().setParam(parameter_, path_);
  }

  ~ReloadedFile()
  {
    std::remove(path_.c_str());
    ros::NodeHandle().setParam(parameter_, first_);
    EXPECT_TRUE(call().success);
  }

  ReloadedFile(const ReloadedFile&) = delete;
  ReloadedFile& operator=(const ReloadedFile&) = delete;

  const std::string& path() const
  {
    return path_;
  }

  /** What the nodelet answers to a file with this text. */
  std_srvs::TriggerResponse reload(const std::string& text) const
  {
    omr::test::writeTo(path_, text);
    return call();
  }

 private:
  std_srvs::TriggerResponse call() const
  {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::call(node_ + "/reload", trigger));
    return trigger.response;
  }

  const std::string node_;
  const std::string parameter_;
  const std::string first_;
  const std::string path_;
};

}  // namespace ros_test

#endif
