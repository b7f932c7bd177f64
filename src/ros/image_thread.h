#ifndef OUTDOOR_OMR_ROS_IMAGE_THREAD_H
#define OUTDOOR_OMR_ROS_IMAGE_THREAD_H

#include <sensor_msgs/Image.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace omr
{
/**
 * A thread that processes images one after the other, always the newest: an image that still waits when the next one
 * comes is dropped.
 *
 * Images are not processed in a nodelet's own callback queue: an unload that falls into a long callback returns before
 * the nodelet is gone and frees its other queue, and the next timer or image crashes the manager (nodelet 1.10).
 */
class ImageThread
{
 public:
  using Process = std::function<void(const sensor_msgs::ImageConstPtr&)>;

  /** @param process called in the thread; must not throw. */
  explicit ImageThread(Process process);

  /** Waits for the image at work; one that still waits is dropped. */
  ~ImageThread();

  ImageThread(const ImageThread&) = delete;
  ImageThread& operator=(const ImageThread&) = delete;

  /** @return whether an older image was dropped for this one. */
  bool put(const sensor_msgs::ImageConstPtr& image);

 private:
  void run();

  Process process_;
  std::mutex mutex_;
  std::condition_variable changed_;
  sensor_msgs::ImageConstPtr newest_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace omr

#endif
