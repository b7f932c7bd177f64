// The detector from outside, as its users see it: one source, run against the node and against the nodelet.

#include <gtest/gtest.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>
#include <topic_tools/shape_shifter.h>

#include "ros_test.h"

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;
using outdoor_omr::CheckerboardArray;
using outdoor_omr::TargetArray;
using ros_test::Listener;
using ros_test::newestStatus;
using ros_test::valueOf;
using ros_test::waitFor;
using sensor_msgs::Image;

namespace
{
/** A camera whose topic the detector subscribes to as soon as somebody listens. */
class Camera
{
 public:
  Camera() : publisher_(ros::NodeHandle().advertise<Image>("image", 10))
  {
  }

  bool watched() const
  {
    return publisher_.getNumSubscribers() > 0;
  }

  sensor_msgs::ImagePtr shoot(const cv::Mat& image = ros_test::scene())
  {
    auto message = ros_test::toMessage(image, ros::Time(1000, ++shots_));
    publisher_.publish(message);
    return message;
  }

 private:
  ros::Publisher publisher_;
  int shots_ = 0;
};

template <typename Message>
void expectSameHeader(const Image& image, const Message& message)
{
  EXPECT_EQ(image.header.stamp, message.header.stamp);
  EXPECT_EQ(image.header.frame_id, message.header.frame_id);
  EXPECT_EQ(image.width, message.width);
  EXPECT_EQ(image.height, message.height);
}

}  // namespace

TEST(Detector, publishesOneMessageForEveryImageWithItsHeader)
{
  Camera camera;
  Listener<CheckerboardArray> checkerboards("detector/checkerboards");
  Listener<TargetArray> targets("detector/targets");
  Listener<Image> overlay("detector/overlay");
  ASSERT_TRUE(waitFor(
      [&] { return camera.watched() && checkerboards.connected() && targets.connected() && overlay.connected(); }));
  for (std::size_t shot = 1; shot <= 5; ++shot)
  {
    const auto image = camera.shoot(ros_test::scene(cv::Size(200 + 20 * static_cast<int>(shot), 160)));
    ASSERT_TRUE(waitFor([&] {
      return checkerboards.count() == shot && targets.count() == shot && overlay.count() == shot;
    })) << "image "
        << shot;
    expectSameHeader(*image, *checkerboards.messages().back());
    expectSameHeader(*image, *targets.messages().back());
    expectSameHeader(*image, *overlay.messages().back());
    EXPECT_EQ("bgr8", overlay.messages().back()->encoding);
    EXPECT_EQ(image->data.size(), overlay.messages().back()->data.size());
  }
}

TEST(Detector, asksForImagesOnlyWhileSomebodyListens)
{
  Camera camera;
  ASSERT_FALSE(waitFor([&] { return camera.watched(); }, 1)) << "subscribed although nobody listens";
  for (const std::string output : {"checkerboards", "targets", "overlay"})
  {
    {
      const Listener<topic_tools::ShapeShifter> listener("detector/" + output);
      EXPECT_TRUE(waitFor([&] { return camera.watched(); })) << output;
    }
    EXPECT_TRUE(waitFor([&] { return !camera.watched(); })) << output;
  }
}

TEST(Detector, keepsWorkingWhenOneOfTwoListenersLeaves)
{
  Camera camera;
  Listener<CheckerboardArray> checkerboards("detector/checkerboards");
  {
    Listener<TargetArray> targets("detector/targets");
    ASSERT_TRUE(waitFor([&] { return camera.watched() && checkerboards.connected() && targets.connected(); }));
  }
  EXPECT_FALSE(waitFor([&] { return !camera.watched(); }, 1));
  camera.shoot();
  EXPECT_TRUE(waitFor([&] { return checkerboards.count() == 1; }));
}

TEST(Detector, tellsHowItFares)
{
  Listener<DiagnosticArray> diagnostics("/diagnostics");
  const auto status = [&] { return newestStatus(diagnostics); };
  ASSERT_TRUE(waitFor([&] { return status().message == "Idle: nobody listens."; })) << status().message;
  EXPECT_FALSE(status().hardware_id.empty());
  EXPECT_EQ(status().hardware_id, valueOf(status(), "Device"));

  Camera camera;
  Listener<TargetArray> targets("detector/targets");
  ASSERT_TRUE(waitFor([&] { return camera.watched() && targets.connected(); }));
  const int before = std::stoi(valueOf(status(), "Images processed"));
  camera.shoot();
  ASSERT_TRUE(waitFor([&] { return valueOf(status(), "Images processed") == std::to_string(before + 1); }));
  EXPECT_EQ("/image", valueOf(status(), "Image topic"));
  EXPECT_EQ("0", valueOf(status(), "Images refused"));
  EXPECT_GT(std::stod(valueOf(status(), "Time of all steps [ms]")), 0);

  ASSERT_TRUE(waitFor([&] { return status().message.find("No image on /image for ") == 0; })) << status().message;
  EXPECT_EQ(DiagnosticStatus::WARN, status().level);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_detector");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
