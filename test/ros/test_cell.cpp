// A bag of two cameras that see one plate, replayed in simulated time through the whole chain, up to TF.

#include <gtest/gtest.h>
#include <outdoor_omr/DeviationArray.h>
#include <outdoor_omr/FusionArray.h>
#include <outdoor_omr/PartArray.h>
#include <rosbag/bag.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>

#include "board_view.h"
#include "child_process.h"
#include "own_folder.h"
#include "pose_messages.h"
#include "reload.h"
#include "ros_test.h"

using outdoor_omr::Deviation;
using outdoor_omr::DeviationArray;
using outdoor_omr::FusionArray;
using outdoor_omr::PartArray;
using ros_test::Listener;
using ros_test::waitFor;

namespace
{
constexpr int FRAMES = 6;  // of each phase
const ros::Time AGREEING(1000);
const ros::Time CONTRADICTING(1010);

/** The plate lies in the base's origin, its z away from the cameras, 0.9 m before each of them. */
cv::Affine3d baseCamera(const std::string& name)
{
  const cv::Affine3d turn(cv::Vec3d(0.1, name == "left" ? 0.5 : -0.4, 0.2));
  return {turn.rotation(), turn * cv::Vec3d(0.02, -0.03, -0.9)};
}

geometry_msgs::TransformStamped toTransform(const std::string& name)
{
  const cv::Affine3d pose = baseCamera(name);
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "base";
  transform.child_frame_id = name + "_optical_frame";
  transform.transform.translation = omr::toVector(pose.translation());
  transform.transform.rotation = omr::toQuaternion(pose.rotation());
  return transform;
}

/** What the cameras take while the plate lies in its place; the right one's picture shows it off by `offset`. */
void writePhase(rosbag::Bag& bag, const ros::Time& start, const cv::Vec3d& offset)
{
  for (const std::string name : {"left", "right"})
  {
    const cv::Affine3d base_plate = cv::Affine3d::Identity().translate(name == "right" ? offset : cv::Vec3d());
    const cv::Mat picture = ros_test::view(7, 10, baseCamera(name).inv() * base_plate);
    for (int frame = 0; frame < FRAMES; ++frame)
    {
      const ros::Time stamp = start + ros::Duration(0.4 * frame);
      const sensor_msgs::ImagePtr image = ros_test::toMessage(picture, stamp);
      image->header.frame_id = name + "_optical_frame";
      sensor_msgs::CameraInfo info = ros_test::cameraInfo();
      info.header = image->header;
      bag.write("/" + name + "/camera_info", stamp, info);
      bag.write("/" + name + "/image_raw", stamp, *image);
    }
  }
}

/** The messages of one phase that `holds` says yes to. */
template <typename Message, typename Condition>
std::vector<boost::shared_ptr<const Message>> ofPhase(const Listener<Message>& listener, const ros::Time& start,
                                                      const Condition& holds)
{
  std::vector<boost::shared_ptr<const Message>> chosen;
  for (const auto& message : listener.messages())
  {
    const ros::Duration since = message->header.stamp - start;
    if (since >= ros::Duration(0) && since < ros::Duration(5) && holds(*message))
    {
      chosen.push_back(message);
    }
  }
  return chosen;
}

TEST(Cell, fromABagOfTwoCamerasToTheDeviationOfAPlate)
{
  const std::string file = omr::test::ownPath("cell.bag");
  {
    rosbag::Bag bag(file, rosbag::bagmode::Write);
    writePhase(bag, AGREEING, {0, 0, 0});
    writePhase(bag, CONTRADICTING, {0.04, 0, 0});
  }
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform({toTransform("left"), toTransform("right")});
  tf2_ros::Buffer buffer(ros::Duration(60));
  const tf2_ros::TransformListener listener(buffer);
  const Listener<PartArray> parts("fusion/parts");
  const Listener<FusionArray> fusions("fusion/fusions");
  const Listener<DeviationArray> deviations("deviation/deviations");
  ASSERT_TRUE(waitFor([&] { return parts.connected() && fusions.connected() && deviations.connected(); }));
  ros_test::ChildProcess player({"rosbag", "play", "--quiet", "--clock", "--wait-for-subscribers", file});

  // Both cameras carry the plate, to a millimetre of the truth.
  const auto by_both = [](const FusionArray& array) {
    return array.parts.size() == 1 && array.parts[0].frame_ids.size() == 2;
  };
  ASSERT_TRUE(waitFor([&] { return !ofPhase(fusions, AGREEING, by_both).empty(); }, 40));
  const auto fusion = ofPhase(fusions, AGREEING, by_both).front();
  EXPECT_TRUE(fusion->parts[0].agree);
  EXPECT_EQ(fusion->parts[0].degrees_of_freedom, 6U);
  EXPECT_EQ(fusion->header.frame_id, "base");
  const ros::Time stamp = fusion->header.stamp;
  const auto at_stamp = [&](const auto& array) { return array.header.stamp == stamp; };
  ASSERT_TRUE(waitFor([&] { return !ofPhase(parts, AGREEING, at_stamp).empty(); }));
  const auto located = ofPhase(parts, AGREEING, at_stamp).front();
  ASSERT_EQ(located->parts.size(), 1U);
  EXPECT_EQ(located->parts[0].points, 2 * 54U);
  EXPECT_LT(cv::norm(omr::fromMessage(located->parts[0].pose).pose.translation()), 0.001);

  // So does TF, at the time of the image.
  ASSERT_TRUE(waitFor([&] { return buffer.canTransform("base", "plate", stamp); }));
  const cv::Affine3d in_tf = omr::fromMessage(buffer.lookupTransform("base", "plate", stamp).transform);
  EXPECT_LT(cv::norm(in_tf.translation()), 0.001);
  EXPECT_LT(cv::norm(in_tf.rvec()), 0.005);

  ASSERT_TRUE(waitFor([&] { return !ofPhase(deviations, AGREEING, at_stamp).empty(); }));
  const auto deviation = ofPhase(deviations, AGREEING, at_stamp).front();
  ASSERT_EQ(deviation->deviations.size(), 2U);
  EXPECT_EQ(deviation->deviations[0].part, "plate");
  EXPECT_EQ(deviation->deviations[0].verdict, Deviation::WITHIN) << deviation->deviations[0];
  EXPECT_NEAR(deviation->deviations[0].translation_mm.x, -1, 0.5);
  EXPECT_EQ(deviation->deviations[1].verdict, Deviation::UNKNOWN);
  EXPECT_EQ(deviation->deviations[1].reason, "'sign' is not in view");
  EXPECT_TRUE(std::isnan(deviation->deviations[1].distance_mm));

  // A camera that says otherwise by 40 mm: no average, both poses, no deviation.
  ASSERT_TRUE(waitFor([&] { return !ofPhase(fusions, CONTRADICTING, by_both).empty(); }, 40));
  const auto refused = ofPhase(fusions, CONTRADICTING, by_both).front();
  EXPECT_FALSE(refused->parts[0].agree);
  const auto at_refusal = [&](const auto& array) { return array.header.stamp == refused->header.stamp; };
  ASSERT_TRUE(waitFor([&] { return !ofPhase(deviations, CONTRADICTING, at_refusal).empty(); }));
  const auto contradicted = ofPhase(parts, CONTRADICTING, at_refusal).front();
  EXPECT_TRUE(contradicted->parts.empty());
  ASSERT_EQ(contradicted->ambiguous.size(), 1U);
  EXPECT_EQ(contradicted->ambiguous[0].candidates.size(), 2U);
  const Deviation unknown = ofPhase(deviations, CONTRADICTING, at_refusal).front()->deviations[0];
  EXPECT_EQ(unknown.verdict, Deviation::UNKNOWN);
  EXPECT_EQ(unknown.reason, "'plate' is ambiguous: several parts or poses fit what is seen");
}

TEST(Cell, everyReaderOfThePartsFileReadsItAnew)
{
  for (const std::string node : {"/left/position", "/right/position", "/fusion"})
  {
    ASSERT_TRUE(waitFor([&] { return ros::service::exists(node + "/reload", false); }));
    const ros_test::ReloadedFile file(node, "parts");
    std_srvs::TriggerResponse response = file.reload("parts: plate\n");
    EXPECT_FALSE(response.success);
    EXPECT_EQ(0U, response.message.find(file.path() + ":1: parts: expected")) << response.message;
    response = file.reload("parts:\n- name: lid\n  checkerboards:\n  - {rows: 7, cols: 10, square: 0.03}\n");
    EXPECT_TRUE(response.success);
    EXPECT_EQ("1 part in " + file.path(), response.message);
  }
}

// As when a bag is paused: nothing that waits in simulated time would ever return.
TEST(Cell, waitForAMissingTransformEndsWhileTheClockStandsStill)
{
  const Listener<DeviationArray> deviations("deviation/deviations");
  ros::Publisher parts = ros::NodeHandle().advertise<PartArray>("fusion/parts", 1);
  ASSERT_TRUE(waitFor([&] { return deviations.connected() && parts.getNumSubscribers() > 0; }));
  PartArray message;
  message.header.frame_id = "nowhere";
  message.parts.resize(1);
  message.parts[0].name = "plate";
  message.parts[0].pose.pose.orientation.w = 1;
  parts.publish(message);
  // The cameras' last images may be on their way still.
  const auto is_answer = [](const auto& array) {
    const Deviation& deviation = array->deviations[0];
    return deviation.reason.find("nowhere") != std::string::npos && deviation.verdict == Deviation::UNKNOWN;
  };
  EXPECT_TRUE(waitFor([&] {
    const auto messages = deviations.messages();
    return std::any_of(messages.begin(), messages.end(), is_answer);
  }));
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_cell");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
