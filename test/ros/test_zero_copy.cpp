// In one process, camera and detector share the image: the detector is the last to let it go. A copy would leave the
// publisher's own as the last.

#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>

#include <atomic>
#include <thread>

#include "ros_test.h"

using outdoor_omr::TargetArray;
using ros_test::Listener;
using ros_test::waitFor;
using sensor_msgs::Image;

TEST(ZeroCopy, detectorHoldsTheImageThatWasPublished)
{
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/detector", "outdoor_omr/detector", {}, {}));
  const ros::Publisher camera = ros::NodeHandle().advertise<Image>("image", 1);
  const Listener<TargetArray> targets("detector/targets");
  ASSERT_TRUE(waitFor([&] { return camera.getNumSubscribers() > 0; }));

  std::atomic<int> freed_here{0};
  std::atomic<int> freed_elsewhere{0};
  const auto here = std::this_thread::get_id();
  for (std::size_t shot = 1; shot <= 10; ++shot)
  {
    // Large, so that the detector is still at work when this thread lets go.
    const auto pixels = ros_test::toMessage(ros_test::scene(cv::Size(1920, 1080)), ros::Time(shot));
    boost::shared_ptr<Image> image(new Image(*pixels), [&](const Image* freed) {
      ++(std::this_thread::get_id() == here ? freed_here : freed_elsewhere);
      delete freed;
    });
    camera.publish(image);
    image.reset();
    ASSERT_TRUE(
        waitFor([&] { return targets.count() == shot && freed_here + freed_elsewhere == static_cast<int>(shot); }));
  }
  EXPECT_EQ(10, freed_elsewhere);
  EXPECT_EQ(0, freed_here);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_zero_copy");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
