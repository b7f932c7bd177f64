// A bag with broken images among good ones is replayed into the detector: it lives, processes the good ones and counts
// the others.

#include <gtest/gtest.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/TargetArray.h>
#include <rosbag/bag.h>

#include <set>

#include "nodelet_manager.h"
#include "own_folder.h"
#include "ros_test.h"

using diagnostic_msgs::DiagnosticArray;
using outdoor_omr::TargetArray;
using ros_test::Listener;
using ros_test::newestStatus;
using ros_test::NodeletManager;
using ros_test::valueOf;
using ros_test::waitFor;
using sensor_msgs::Image;

namespace
{
const std::vector<std::function<void(Image&)>> FAULTS = {
    [](Image& image) { image.step -= 1; },
    [](Image& image) { image.step += 1; },
    [](Image& image) { image.step = 0; },
    [](Image& image) { image.data.resize(image.data.size() / 2); },
    [](Image& image) { image.data.clear(); },
    [](Image& image) { image.encoding = "nonsense"; },
    [](Image& image) { image.encoding = ""; },
    [](Image& image) { image.encoding = "32FC3"; },
    [](Image& image) { image.width = image.height = image.step = 0; },
    [](Image& image) { image.width = image.height = image.step = 0xffffffff; },
    [](Image& image) { image.height *= 2; },
};

/** Writes a good image before, between and after the broken ones. @return the stamps of the good ones. */
std::set<ros::Time> writeBag(const std::string& file)
{
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  std::set<ros::Time> good;
  ros::Time stamp(1000);
  const auto write = [&](const std::function<void(Image&)>& fault) {
    stamp += ros::Duration(0.15);
    const auto image = ros_test::toMessage(ros_test::scene(), stamp);
    fault(*image);
    bag.write("/image", stamp, *image);
  };
  const auto writeGood = [&] {
    write([](Image& /*image*/) {});
    good.insert(stamp);
  };
  for (const auto& fault : FAULTS)
  {
    writeGood();
    write(fault);
  }
  writeGood();
  return good;
}
}  // namespace

TEST(BrokenImages, areCountedAndTheGoodOnesProcessed)
{
  const std::string file = omr::test::ownPath("broken_images.bag");
  const std::set<ros::Time> good = writeBag(file);
  NodeletManager manager;
  ASSERT_TRUE(NodeletManager::load());
  const Listener<DiagnosticArray> diagnostics("/diagnostics");
  const Listener<TargetArray> targets("detector/targets");
  ASSERT_TRUE(waitFor([&] { return targets.connected(); }));
  ros_test::ChildProcess player({"rosbag", "play", "--quiet", "--wait-for-subscribers", file});
  ASSERT_EQ(0, player.wait());

  const auto value = [&](const std::string& key) { return valueOf(newestStatus(diagnostics), key); };
  EXPECT_TRUE(waitFor([&] { return value("Images refused") == std::to_string(FAULTS.size()); }))
      << value("Images refused") << " refused, last: " << value("Last refusal");
  EXPECT_TRUE(waitFor([&] { return value("Images processed") == std::to_string(good.size()); }))
      << value("Images processed") << " processed";
  EXPECT_NE(std::string::npos, value("Last refusal").find("data has ")) << value("Last refusal");
  std::set<ros::Time> seen;
  for (const auto& message : targets.messages())
  {
    seen.insert(message->header.stamp);
  }
  EXPECT_EQ(good, seen);
  EXPECT_EQ(0, manager.interrupt());
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_broken_images");
  ros::NodeHandle nh;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
