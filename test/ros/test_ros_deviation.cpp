#include <gtest/gtest.h>
#include <outdoor_omr/DeviationArray.h>
#include <outdoor_omr/PartArray.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <cmath>

#include "pose_messages.h"
#include "reload.h"
#include "ros_test.h"

using outdoor_omr::Deviation;
using outdoor_omr::DeviationArray;
using outdoor_omr::Part;
using outdoor_omr::PartArray;
using ros_test::Listener;
using ros_test::newestStatus;
using ros_test::waitFor;

namespace
{
/** A part that is uncertain by 0.1 mm and 0.1 mrad. */
Part partAt(const std::string& name, double x, double y, double z)
{
  Part part;
  part.name = name;
  part.pose =
      omr::toMessage(omr::PoseEstimate{cv::Affine3d::Identity().translate({x, y, z}), cv::Matx66d::eye() * 1e-8});
  return part;
}

class DeviationNodelet : public testing::Test
{
 protected:
  void SetUp() override
  {
    ASSERT_TRUE(waitFor([this] { return parts_.getNumSubscribers() > 0 && deviations_.connected(); }));
  }

  /** What is said of these parts; empty if nothing. */
  std::vector<Deviation> answer(const PartArray& parts)
  {
    const std::size_t before = deviations_.count();
    PartArray message = parts;
    message.header.stamp = ros::Time::now();
    message.header.frame_id = "camera";
    parts_.publish(message);
    if (!waitFor([&] { return deviations_.count() > before; }))
    {
      return {};
    }
    return deviations_.messages().back()->deviations;
  }

  /** Before the only test that sends a transform to the base. */
  static void sendBase()
  {
    static tf2_ros::StaticTransformBroadcaster broadcaster;
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base";
    transform.child_frame_id = "camera";
    transform.transform.translation.z = 1;
    transform.transform.rotation.w = 1;
    broadcaster.sendTransform(transform);
  }

  ros::NodeHandle nh_;
  ros::Publisher parts_ = nh_.advertise<PartArray>("/parts", 1);
  Listener<DeviationArray> deviations_{"/deviation/deviations"};
};

TEST_F(DeviationNodelet, measuresInAnotherPartsFrameWithTheUncertaintyOfBoth)
{
  PartArray parts;
  parts.parts = {partAt("pipe", 0, 0, 1), partAt("plate", 0.501, 0.001, 1)};
  const std::vector<Deviation> deviations = answer(parts);
  ASSERT_EQ(deviations.size(), 2U);
  const Deviation& plate = deviations[0];
  EXPECT_EQ(plate.part, "plate");
  EXPECT_EQ(plate.frame_id, "pipe");
  EXPECT_EQ(plate.verdict, Deviation::WITHIN);
  EXPECT_EQ(plate.reason, "");
  EXPECT_NEAR(plate.translation_mm.x, 1, 1e-6);
  EXPECT_NEAR(plate.translation_mm.y, 1, 1e-6);
  EXPECT_NEAR(plate.distance_mm, std::sqrt(2.), 1e-6);
  EXPECT_NEAR(plate.angle_deg, 0, 1e-6);
  EXPECT_EQ(plate.tolerance_mm, 3);
  // Both positions, 0.1 mm each, and the pipe's turn at 0.5 m: 0.15 mm in the worst direction.
  EXPECT_NEAR(plate.distance_uncertainty_mm, 0.15 * std::sqrt(7.815), 0.001);

  const Deviation& pipe = deviations[1];
  EXPECT_EQ(pipe.verdict, Deviation::UNKNOWN);
  EXPECT_NE(pipe.reason.find("base"), std::string::npos) << pipe.reason;
  EXPECT_TRUE(std::isnan(pipe.distance_mm));
}

TEST_F(DeviationNodelet, saysWhyItDoesNotKnow)
{
  EXPECT_EQ(answer(PartArray()).at(0).reason, "'plate' is not in view");

  PartArray alone;
  alone.parts = {partAt("plate", 0, 0, 1)};
  EXPECT_NE(answer(alone).at(0).reason.find("pipe"), std::string::npos);

  PartArray ambiguous = alone;
  ambiguous.ambiguous.resize(1);
  ambiguous.ambiguous[0].candidates = {partAt("pipe", 0, 0, 1), partAt("pipe", 0.2, 0, 1)};
  EXPECT_EQ(answer(ambiguous).at(0).reason, "'pipe' is ambiguous: several parts or poses fit what is seen");

  PartArray copies;
  copies.parts = {partAt("pipe", 0, 0, 1), partAt("plate", 0.5, 0, 1), partAt("plate", 0.9, 0, 1)};
  EXPECT_EQ(answer(copies).at(0).reason, "several copies of 'plate' are in view, and the goal is for one");

  PartArray broken;
  broken.parts = {partAt("pipe", 0, 0, 1), partAt("plate", 0.5, 0, 1)};
  broken.parts[1].pose.pose.orientation.w = 0;
  const Deviation deviation = answer(broken).at(0);
  EXPECT_EQ(deviation.verdict, Deviation::UNKNOWN);
  EXPECT_NE(deviation.reason.find("quaternion"), std::string::npos) << deviation.reason;
}

TEST_F(DeviationNodelet, tellsTheOperatorWhatIsNotMeasuredAndWhy)
{
  const Listener<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  const auto message = [&] { return newestStatus(diagnostics, "deviation: deviation of parts").message; };
  EXPECT_TRUE(waitFor([&] {
    answer(PartArray());
    return message() == "0 of 2 parts measured: 'plate' is not in view; 'pipe' is not in view.";
  })) << message();
  EXPECT_TRUE(waitFor([&] { return message().find("No parts on /parts for ") == 0; })) << message();
}

TEST_F(DeviationNodelet, takesTheWayToTheGoalsFrameFromTf)
{
  sendBase();
  PartArray parts;
  parts.parts = {partAt("pipe", 0.01, 0, 1)};
  std::vector<Deviation> deviations;
  ASSERT_TRUE(waitFor([&] {
    deviations = answer(parts);
    return deviations.size() == 2 && deviations[1].verdict != Deviation::UNKNOWN;
  }));
  EXPECT_EQ(deviations[1].verdict, Deviation::OUTSIDE);
  EXPECT_NEAR(deviations[1].translation_mm.x, 10, 1e-6);
  EXPECT_NEAR(deviations[1].translation_mm.z, 0, 1e-6);
}
TEST_F(DeviationNodelet, isFromTheGoalsFileAsReloaded)
{
  const ros_test::ReloadedFile file("/deviation", "goals");
  const std::string goal = "goals:\n- part: plate\n  frame: camera\n  pose: {xyz: [0, 0, 1]}\n  tolerance_degrees: 1\n";
  std_srvs::TriggerResponse response = file.reload(goal + "  tolerance_mm: 0\n");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(0U, response.message.find(file.path() + ":6: goals[0].tolerance_mm: expected")) << response.message;
  PartArray parts;
  parts.parts = {partAt("plate", 0.001, 0, 1)};
  EXPECT_EQ(2U, answer(parts).size());

  response = file.reload(goal + "  tolerance_mm: 5\n");
  EXPECT_TRUE(response.success);
  EXPECT_EQ("1 goal in " + file.path(), response.message);
  const std::vector<Deviation> deviations = answer(parts);
  ASSERT_EQ(1U, deviations.size());
  EXPECT_EQ("camera", deviations[0].frame_id);
  EXPECT_EQ(Deviation::WITHIN, deviations[0].verdict);
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_ros_deviation");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
