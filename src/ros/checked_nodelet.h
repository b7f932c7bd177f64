#ifndef OUTDOOR_OMR_ROS_CHECKED_NODELET_H
#define OUTDOOR_OMR_ROS_CHECKED_NODELET_H

#include <nodelet/nodelet.h>

#include <stdexcept>
#include <string>

#include "caught.h"

namespace omr
{
/** A nodelet that logs why it cannot start: the manager, which learns it by an exception, keeps the text to itself. */
class CheckedNodelet : public nodelet::Nodelet
{
 protected:
  /** What onInit() is to others; may throw. */
  virtual void start() = 0;

 private:
  void onInit() final
  {
    const std::string error = caught([this] { start(); });
    if (!error.empty())
    {
      NODELET_FATAL("Cannot start: %s", error.c_str());
      throw std::runtime_error(error);
    }
  }
};

}  // namespace omr

#endif
