// Nodelets whose parameters make no sense do not start, and the manager with all others in it lives.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <outdoor_omr/TargetArray.h>
#include <ros/package.h>
#include <rosgraph_msgs/Log.h>

#include "nodelet_manager.h"
#include "ros_test.h"

using ros_test::Listener;
using ros_test::newestStatus;
using ros_test::NodeletManager;
using ros_test::waitFor;

namespace
{
const std::string FILES = ros::package::getPath("outdoor_omr") + "/test/ros/";

class BadParameters : public testing::Test
{
 protected:
  void SetUp() override
  {
    ASSERT_TRUE(waitFor([this] { return log_.connected(); }));
    for (const std::string name : {"position", "fusion", "deviation"})
    {
      ros::param::del("/" + name);
    }
  }

  /** It does not start, and the log says this. */
  void expectRefused(const std::string& nodelet, const std::string& complaint)
  {
    const std::size_t before = log_.count();
    const auto is_logged = [&] {
      const auto messages = log_.messages();
      return std::any_of(messages.begin() + static_cast<std::ptrdiff_t>(before), messages.end(),
                         [&](const auto& line) { return line->msg.find(complaint) != std::string::npos; });
    };
    // A manager's first lines are lost while its log finds its listeners: it is asked again.
    EXPECT_TRUE(waitFor([&] {
      EXPECT_FALSE(NodeletManager::load(nodelet)) << complaint;
      return waitFor(is_logged, 1);
    })) << complaint;
    EXPECT_TRUE(NodeletManager::alive());
  }

  NodeletManager manager_;
  Listener<rosgraph_msgs::Log> log_{"/rosout"};
};

// The images are subscribed to when somebody listens, long after the nodelet started.
TEST_F(BadParameters, ofTheDetectorsImages)
{
  ros::param::set("/detector/image_transport", "pigeon");
  ASSERT_TRUE(NodeletManager::load("detector"));
  const Listener<outdoor_omr::TargetArray> targets("/detector/targets");
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const auto status = [&] { return newestStatus(diagnostics); };
  EXPECT_TRUE(waitFor([&] { return status().level == diagnostic_msgs::DiagnosticStatus::ERROR; }));
  EXPECT_EQ(0U, status().message.find("Cannot subscribe to the images: ")) << status().message;
  EXPECT_NE(std::string::npos, status().message.find("pigeon")) << status().message;
}

TEST_F(BadParameters, ofThePosition)
{
  expectRefused("position", "parameter ~parts: expected the path of a parts file");
  ros::param::set("/position/parts", "/nonexistent.yaml");
  expectRefused("position", "cannot read the file '/nonexistent.yaml'");
  ros::param::set("/position/parts", FILES + "cell_goals.yaml");
  expectRefused("position", "there is no key 'goals': expected parts");
  ros::param::set("/position/parts", FILES + "position_parts.yaml");
  ros::param::set("/position/image_kind", "colour");
  expectRefused("position", "parameter ~image_kind: expected raw or rectified, not 'colour'");
  ros::param::set("/position/image_kind", "raw");
  ros::param::set("/position/max_speed", -1);
  expectRefused("position", "parameter ~max_speed: expected a number of 0 to");
  ros::param::set("/position/max_speed", "fast");
  expectRefused("position", "parameter ~max_speed: expected a number of 0 to");
  ros::param::set("/position/max_speed", 2);
  EXPECT_TRUE(NodeletManager::load("position"));
}

TEST_F(BadParameters, ofTheFusion)
{
  expectRefused("fusion", "parameter ~inputs: expected a list of topics");
  ros::param::set("/fusion/inputs", "left/position/parts");
  expectRefused("fusion", "parameter ~inputs: expected a list of topics");
  ros::param::set("/fusion/inputs", std::vector<std::string>{"left/position/parts", "right/position/parts"});
  expectRefused("fusion", "parameter ~frame: expected the TF frame to fuse in");
  ros::param::set("/fusion/frame", "base");
  ros::param::set("/fusion/min_cameras", 3);
  expectRefused("fusion", "parameter ~min_cameras: expected 1 to 2, the number of inputs, not 3");
  ros::param::set("/fusion/min_cameras", 2);
  ros::param::set("/fusion/camera_position_sigma", -0.001);
  expectRefused("fusion", "parameter ~camera_position_sigma: expected a number of 0 to");
  ros::param::set("/fusion/camera_position_sigma", 0.001);
  EXPECT_TRUE(NodeletManager::load("fusion"));
}

TEST_F(BadParameters, ofTheDeviation)
{
  expectRefused("deviation", "parameter ~goals: expected the path of a goals file");
  ros::param::set("/deviation/goals", FILES + "position_parts.yaml");
  expectRefused("deviation", "there is no key 'parts': expected goals");
  ros::param::set("/deviation/goals", FILES + "cell_goals.yaml");
  ros::param::set("/deviation/tf_timeout", 60);
  expectRefused("deviation", "parameter ~tf_timeout: expected a number of 0 to");
  ros::param::set("/deviation/tf_timeout", 0);
  EXPECT_TRUE(NodeletManager::load("deviation"));
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_bad_parameters");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
