#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "transform_wait.h"

using omr::TransformWait;

namespace
{
const ros::WallDuration PATIENCE(1);
constexpr double AT_ONCE = 0.5;  // [s]

class Wait : public testing::Test
{
 protected:
  void send(const std::string& frame, double stamp)
  {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base";
    transform.header.stamp = ros::Time(stamp);
    transform.child_frame_id = frame;
    transform.transform.rotation.w = 1;
    buffer_.setTransform(transform, "test");
  }

  /** @param[out] seconds that it took. @return whether there is one. */
  bool lookup(const std::string& frame, double stamp, double& seconds)
  {
    const auto start = std::chrono::steady_clock::now();
    bool is_there = true;
    try
    {
      wait_.lookup("base", frame, ros::Time(stamp));
    }
    catch (const tf2::TransformException&)
    {
      is_there = false;
    }
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return is_there;
  }

  tf2_ros::Buffer buffer_{ros::Duration(10), false};
  TransformWait wait_{buffer_, PATIENCE};
  double seconds_ = 0;
};

TEST_F(Wait, anUnknownFrameCostsOneWait)
{
  EXPECT_FALSE(lookup("camera", 5, seconds_));
  EXPECT_GE(seconds_, PATIENCE.toSec());
  EXPECT_FALSE(lookup("camera", 5.1, seconds_));
  EXPECT_LT(seconds_, AT_ONCE);
  EXPECT_FALSE(lookup("other", 5.1, seconds_));
  EXPECT_GE(seconds_, PATIENCE.toSec()) << "another frame is waited for";
  send("camera", 5);
  send("camera", 6);
  EXPECT_TRUE(lookup("camera", 5.2, seconds_));
}

TEST_F(Wait, aFrameThatIsSentNoLongerCostsOneWait)
{
  send("plate", 5);
  EXPECT_TRUE(lookup("plate", 5, seconds_));
  EXPECT_FALSE(lookup("plate", 5.03, seconds_));
  EXPECT_GE(seconds_, PATIENCE.toSec());
  for (int i = 2; i < 5; ++i)
  {
    EXPECT_FALSE(lookup("plate", 5 + 0.03 * i, seconds_));
    EXPECT_LT(seconds_, AT_ONCE);
  }
}

TEST_F(Wait, whatIsOnItsWayIsWaitedForAlsoAfterAFailure)
{
  send("arm", 5);
  EXPECT_FALSE(lookup("arm", 6, seconds_));
  send("arm", 6.9);
  std::thread sender([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    send("arm", 7.1);
  });
  EXPECT_TRUE(lookup("arm", 7, seconds_));
  sender.join();
}

TEST_F(Wait, theTimeZeroOfAnUnknownFrameIsRefused)
{
  EXPECT_FALSE(lookup("camera", 0, seconds_));
  EXPECT_FALSE(lookup("camera", 0, seconds_));
  EXPECT_LT(seconds_, AT_ONCE);
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
