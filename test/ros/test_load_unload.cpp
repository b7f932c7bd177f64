// Loads and unloads the detector again and again while images arrive and listeners listen: the manager must live.

#include <gtest/gtest.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>

#include <atomic>
#include <thread>

#include "nodelet_manager.h"
#include "ros_test.h"

using outdoor_omr::TargetArray;
using ros_test::Listener;
using ros_test::NodeletManager;
using ros_test::waitFor;
using sensor_msgs::Image;

namespace
{
constexpr int CYCLES = 50;

/** Publishes an image every 10 ms, faster than the detector takes them, as long as it lives. */
class Traffic
{
 public:
  Traffic() : publisher_(ros::NodeHandle().advertise<Image>("image", 1)), thread_([this] { run(); })
  {
  }

  ~Traffic()
  {
    end_ = true;
    thread_.join();
  }

 private:
  void run()
  {
    const cv::Mat image = ros_test::scene(cv::Size(640, 480));
    for (int shot = 1; !end_; ++shot)
    {
      publisher_.publish(ros_test::toMessage(image, ros::Time(shot)));
      ros::WallDuration(0.01).sleep();
    }
  }

  ros::Publisher publisher_;
  std::atomic<bool> end_{false};
  std::thread thread_;
};
}  // namespace

TEST(LoadUnload, managerLivesThroughFiftyCyclesUnderTraffic)
{
  NodeletManager manager;
  const Traffic traffic;
  const Listener<Image> overlay("detector/overlay");
  const Listener<TargetArray> targets("detector/targets");
  for (int cycle = 0; cycle < CYCLES; ++cycle)
  {
    const std::size_t before = targets.count();
    ASSERT_TRUE(NodeletManager::load()) << "cycle " << cycle;
    // Every other time it goes while the first image may be at work, else while images flow.
    if (cycle % 2 == 0)
    {
      ASSERT_TRUE(waitFor([&] { return targets.count() > before + 1; })) << "cycle " << cycle;
    }
    ASSERT_TRUE(NodeletManager::unload()) << "cycle " << cycle;
  }
  EXPECT_TRUE(NodeletManager::alive());
  ASSERT_TRUE(NodeletManager::load());
  EXPECT_EQ(0, manager.interrupt()) << "the manager did not end cleanly with a detector at work";
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_load_unload");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
