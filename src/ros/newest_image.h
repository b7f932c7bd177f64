#ifndef OUTDOOR_OMR_ROS_NEWEST_IMAGE_H
#define OUTDOOR_OMR_ROS_NEWEST_IMAGE_H

#include <ros/callback_queue_interface.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <mutex>

namespace outdoor_omr
{
/**
 * The newest image that waits for the detector. A subscriber's own queue of length one does the same, but does not say
 * how many images it dropped. Thread-safe.
 */
class NewestImage
{
 public:
  /** @return whether an older image was waiting, which is dropped. */
  bool put(const sensor_msgs::ImageConstPtr& image);

  /** The image that waits; none waits afterwards. */
  sensor_msgs::ImageConstPtr take();

 private:
  std::mutex mutex_;
  sensor_msgs::ImageConstPtr image_;
};

/** Has the queue's thread call a function once. */
void callLater(ros::CallbackQueueInterface& queue, const std::function<void()>& function);

}  // namespace outdoor_omr

#endif
