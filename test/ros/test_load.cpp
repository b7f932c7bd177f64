// Cameras that send at a rate, a detector each in one process: how old the published results are, how many images
// were answered, how much memory the process took, how long the first result needed. Prints the figures; fails when
// results come out of order or older than the images that wait. scripts/load runs it with other parameters.

#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <outdoor_omr/CheckerboardArray.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "ros_test.h"
#include "scene.h"

using outdoor_omr::CheckerboardArray;
using ros_test::toMessage;
using ros_test::waitFor;
using sensor_msgs::Image;

namespace
{
/** What one camera and its detector did. */
class Camera
{
 public:
  explicit Camera(int index)
      : name_("camera" + std::to_string(index)),
        images_(ros::NodeHandle(name_).advertise<Image>("image", 1)),
        results_(
            ros::NodeHandle().subscribe<CheckerboardArray>(detector() + "/checkerboards", 100, &Camera::receive, this))
  {
  }

  std::string detector() const
  {
    return "/detector_" + name_;
  }

  bool listened() const
  {
    return images_.getNumSubscribers() > 0;
  }

  void publish(const cv::Mat& image)
  {
    images_.publish(toMessage(image, ros::Time(ros::WallTime::now().toSec())));
  }

  /** Ages of the results when they were published [s], in the order of their arrival. */
  std::vector<double> ages() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ages_;
  }

  bool inOrder() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::is_sorted(stamps_.begin(), stamps_.end());
  }

 private:
  void receive(const CheckerboardArray::ConstPtr& result)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stamps_.push_back(result->header.stamp);
    ages_.push_back(ros::WallTime::now().toSec() - result->header.stamp.toSec());
  }

  std::string name_;
  mutable std::mutex mutex_;
  std::vector<double> ages_;
  std::vector<ros::Time> stamps_;
  ros::Publisher images_;
  ros::Subscriber results_;  // the last member: shut down first
};

/** "VmRSS", "VmHWM" of /proc/self/status [MB]. */
double memory(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word)
  {
    if (word == key + ":")
    {
      status >> kilobytes;
    }
  }
  return kilobytes / 1024;
}

/** A file of nothing but pixels, B, G, R. */
cv::Mat readPixels(const std::string& file, const cv::Size& size)
{
  cv::Mat image(size, CV_8UC3);
  std::ifstream stream(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(image.total() * image.elemSize());
  return stream.read(image.ptr<char>(), bytes) ? image : cv::Mat();
}

double quantile(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

template <typename Value>
Value parameter(const std::string& name, const Value& value)
{
  return ros::NodeHandle("~").param<Value>(name, value);
}
}  // namespace

TEST(Load, resultsAreFreshAndInOrder)
{
  const int count = parameter("cameras", 1);
  const cv::Size size(parameter("width", 1920), parameter("height", 1080));
  const double rate = parameter("rate", 30.0);
  const double seconds = parameter("seconds", 5.0);
  const std::string file = parameter<std::string>("image", "");
  const cv::Mat image = file.empty() ? omr::drawBoards(size, {2, 2}, {7, 5}) : readPixels(file, size);
  ASSERT_FALSE(image.empty()) << "cannot read " << file;

  const ros::WallTime start = ros::WallTime::now();
  const double memory_before = memory("VmRSS");
  nodelet::Loader loader(false);
  std::vector<std::unique_ptr<Camera>> cameras;
  for (int i = 0; i < count; ++i)
  {
    cameras.push_back(std::make_unique<Camera>(i));
    const std::string name = "camera" + std::to_string(i);
    ASSERT_TRUE(loader.load(cameras[i]->detector(), "outdoor_omr/detector", {{"/image", "/" + name + "/image"}}, {}));
  }
  ASSERT_TRUE(waitFor([&] {
    return std::all_of(cameras.begin(), cameras.end(), [](const auto& camera) { return camera->listened(); });
  }));
  cameras[0]->publish(image);
  ASSERT_TRUE(waitFor([&] { return !cameras[0]->ages().empty(); }));
  const double first_result = (ros::WallTime::now() - start).toSec();

  const int shots = static_cast<int>(seconds * rate);
  ros::WallRate timer(rate);
  for (int shot = 0; shot < shots; ++shot)
  {
    for (const auto& camera : cameras)
    {
      camera->publish(image);
    }
    timer.sleep();
  }
  ros::WallDuration(1).sleep();

  std::vector<double> ages;
  std::size_t answered = 0;
  for (const auto& camera : cameras)
  {
    EXPECT_TRUE(camera->inOrder());
    const std::vector<double> own = camera->ages();
    ages.insert(ages.end(), own.begin(), own.end());
    answered += own.size();
  }
  answered -= 1;  // the first image
  std::cout << count << " x " << size.width << "x" << size.height << " at " << rate << " Hz: " << answered << " of "
            << shots * count << " images answered; age of the results, ms: median " << 1e3 * quantile(ages, 0.5)
            << ", p99 " << 1e3 * quantile(ages, 0.99) << ", largest " << 1e3 * quantile(ages, 1)
            << "; resident, MB: " << memory("VmRSS") << ", peak " << memory("VmHWM") << ", before the detectors "
            << memory_before << "; first result after " << first_result << " s\n";
  ASSERT_GT(answered, 0U);
  // Only the newest image waits: a result is never older than two images' work, here the longest ones of the run.
  const double work = (seconds + 1) * count / static_cast<double>(answered);
  EXPECT_LT(quantile(ages, 0.5), 2 * work + 1 / rate);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_load");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
