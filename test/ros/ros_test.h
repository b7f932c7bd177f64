#ifndef OUTDOOR_OMR_TEST_ROS_TEST_H
#define OUTDOOR_OMR_TEST_ROS_TEST_H

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

/** What the tests of the running detector share. They spin in threads of their own, and wait on wall time. */
namespace ros_test
{
inline bool waitFor(const std::function<bool()>& condition, double seconds = 20)
{
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (!condition())
  {
    if (!ros::ok() || ros::WallTime::now() > end)
    {
      return false;
    }
    ros::WallDuration(0.01).sleep();
  }
  return true;
}

/** Keeps every message of a topic while it lives. */
template <typename Message>
class Listener
{
 public:
  explicit Listener(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe<Message>(topic, 100, &Listener::receive, this))
  {
  }

  std::vector<boost::shared_ptr<const Message>> messages() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }

  std::size_t count() const
  {
    return messages().size();
  }

  bool connected() const
  {
    return subscriber_.getNumPublishers() > 0;
  }

 private:
  void receive(const boost::shared_ptr<const Message>& message)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(message);
  }

  mutable std::mutex mutex_;
  std::vector<boost::shared_ptr<const Message>> messages_;
  ros::Subscriber subscriber_;  // the last member: shut down first
};

/** A blue field with a red disk and a grey bar: three regions with edges between them. */
inline cv::Mat scene(const cv::Size& size = {320, 240})
{
  cv::Mat image(size, CV_8UC3, cv::Scalar(160, 60, 40));
  cv::circle(image, {size.width / 3, size.height / 2}, size.height / 4, cv::Scalar(30, 30, 200), cv::FILLED);
  const cv::Rect bar(2 * size.width / 3, size.height / 8, size.width / 8, size.height / 2);
  cv::rectangle(image, bar, cv::Scalar::all(128), cv::FILLED);
  return image;
}

/** @param image CV_8UC3. @param stamp not zero. */
inline sensor_msgs::ImagePtr toMessage(const cv::Mat& image, const ros::Time& stamp)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = stamp;
  message->header.frame_id = "camera";
  message->width = image.cols;
  message->height = image.rows;
  message->step = image.cols * 3;
  message->encoding = sensor_msgs::image_encodings::BGR8;
  message->data.assign(image.datastart, image.dataend);
  return message;
}

/** The newest status that the detector has told; empty before the first. */
inline diagnostic_msgs::DiagnosticStatus newestStatus(const Listener<diagnostic_msgs::DiagnosticArray>& diagnostics)
{
  diagnostic_msgs::DiagnosticStatus newest;
  for (const auto& array : diagnostics.messages())
  {
    for (const diagnostic_msgs::DiagnosticStatus& status : array->status)
    {
      newest = status.name == "detector: marker detection" ? status : newest;
    }
  }
  return newest;
}

inline std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key)
{
  for (const diagnostic_msgs::KeyValue& value : status.values)
  {
    if (value.key == key)
    {
      return value.value;
    }
  }
  return "";
}

}  // namespace ros_test

#endif
