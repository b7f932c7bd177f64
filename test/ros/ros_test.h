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

inline void drawCheckerboard(cv::Mat& image, const cv::Point& corner, int rows, int cols, int square)
{
  for (int i = 0; i < rows * cols; ++i)
  {
    const cv::Rect box(corner + cv::Point(i % cols, i / cols) * square, cv::Size(square, square));
    cv::rectangle(image, box, cv::Scalar::all((i % cols + i / cols) % 2 == 0 ? 20 : 235), cv::FILLED);
  }
}

/** White paper with a large board of 6 x 9 squares, a faint small one of 5 x 7 and a target of five rings, slightly
 * blurred and noisy as a camera sees them. */
inline cv::Mat markerScene()
{
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(235));
  drawCheckerboard(image, {40, 40}, 6, 9, 28);
  drawCheckerboard(image, {420, 360}, 5, 7, 5);
  const cv::Scalar colors[] = {{30, 30, 190}, {235, 235, 235}, {20, 20, 20}, {60, 150, 40}, {170, 60, 30}};
  for (int ring = 0; ring < 5; ++ring)
  {
    cv::circle(image, {480, 180}, 100 - 20 * ring, colors[ring], cv::FILLED);
  }
  cv::GaussianBlur(image, image, cv::Size(), 0.7);
  cv::Mat noise(image.size(), CV_16SC3);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, 0, 3);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
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

/** The newest status of that name; empty before the first. */
inline diagnostic_msgs::DiagnosticStatus newestStatus(const Listener<diagnostic_msgs::DiagnosticArray>& diagnostics,
                                                      const std::string& name = "detector: marker detection")
{
  diagnostic_msgs::DiagnosticStatus newest;
  for (const auto& array : diagnostics.messages())
  {
    for (const diagnostic_msgs::DiagnosticStatus& status : array->status)
    {
      newest = status.name == name ? status : newest;
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
