#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <outdoor_omr/CheckerboardArray.h>
#include <outdoor_omr/PartArray.h>
#include <outdoor_omr/TargetArray.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/affine.hpp>

#include "board_view.h"
#include "reload.h"
#include "ros_test.h"

using outdoor_omr::PartArray;
using ros_test::cameraInfo;
using ros_test::Listener;
using ros_test::newestStatus;
using ros_test::toMessage;
using ros_test::valueOf;
using ros_test::view;
using ros_test::waitFor;

namespace
{
const char* const STATUS = "position: position of parts";

class Position : public testing::Test
{
 protected:
  void SetUp() override
  {
    ASSERT_TRUE(waitFor([this] {
      return image_.getNumSubscribers() > 0 && camera_info_.getNumSubscribers() > 0 && parts_.connected() &&
             markers_.connected();
    })) << "detector or position nodelet did not start";
  }

  /** Shows a picture with its camera_info. */
  void show(const cv::Mat& picture, sensor_msgs::CameraInfo info)
  {
    const sensor_msgs::ImagePtr image = toMessage(picture, ros::Time(ros::WallTime::now().toSec()));
    info.header = image->header;
    camera_info_.publish(info);
    image_.publish(image);
  }

  /** Shows it until there is an answer. @return the last one; empty if none comes. */
  PartArray locate(const cv::Mat& picture)
  {
    const std::size_t before = parts_.count();
    if (!waitFor([&] {
          show(picture, cameraInfo());
          return waitFor([&] { return parts_.count() > before; }, 2);
        }))
    {
      return {};
    }
    return *parts_.messages().back();
  }

  /** Repeats a step until the position nodelet's diagnostics contain the text. @return the last ones; empty: never. */
  std::string lastDiagnosticsUntil(const std::string& text, const std::function<void()>& step)
  {
    std::string last;
    const bool came = waitFor([&] {
      step();
      waitFor([] { return false; }, 0.5);
      last = newestStatus(diagnostics_, STATUS).message;
      return last.find(text) != std::string::npos;
    });
    EXPECT_TRUE(came) << last;
    return came ? last : "";
  }

  /** Shows it until the position nodelet's diagnostics contain the text. @return the last ones. */
  std::string diagnosticsAfter(const cv::Mat& picture, const sensor_msgs::CameraInfo& info, const std::string& text)
  {
    return lastDiagnosticsUntil(text, [&] { show(picture, info); });
  }

  ros::NodeHandle nh_;
  ros::Publisher image_ = nh_.advertise<sensor_msgs::Image>("/camera/image", 1);
  ros::Publisher camera_info_ = nh_.advertise<sensor_msgs::CameraInfo>("/camera/camera_info", 1);
  Listener<PartArray> parts_{"/position/parts"};
  Listener<visualization_msgs::MarkerArray> markers_{"/position/markers"};
  Listener<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
};

const cv::Affine3d POSE(cv::Vec3d(0.3, -0.5, 0.2), cv::Vec3d(0.05, -0.03, 0.9));

TEST_F(Position, ofAPlateAsMessageTransformAndMarkers)
{
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const cv::Mat picture = view(7, 10, POSE);
  PartArray answer;
  ASSERT_TRUE(waitFor([&] {  // the listener may connect after the first answers
    answer = locate(picture);
    return waitFor([&] { return buffer.canTransform("camera", "plate", answer.header.stamp); }, 0.5);
  }));
  ASSERT_EQ(1U, answer.parts.size());
  EXPECT_TRUE(answer.ambiguous.empty());
  const outdoor_omr::Part& part = answer.parts.front();
  EXPECT_EQ("plate", part.name);
  EXPECT_EQ("camera", answer.header.frame_id);
  EXPECT_EQ(std::vector<std::uint32_t>{0}, part.checkerboards);
  EXPECT_EQ(54U, part.points);
  EXPECT_LT(part.reprojection_error, 0.3);
  EXPECT_NEAR(0.05, part.pose.pose.position.x, 0.0005);
  EXPECT_NEAR(-0.03, part.pose.pose.position.y, 0.0005);
  EXPECT_NEAR(0.9, part.pose.pose.position.z, 0.001);
  EXPECT_GT(part.pose.covariance[0], 0);
  EXPECT_LT(std::sqrt(part.pose.covariance[14]), 0.001);

  const auto transform = buffer.lookupTransform("camera", "plate", answer.header.stamp).transform;
  EXPECT_NEAR(0.9, transform.translation.z, 0.001);
  const geometry_msgs::Quaternion& q = transform.rotation;
  const double angle = cv::norm(POSE.rvec());
  const cv::Vec3d axis = POSE.rvec() * (1 / angle);
  const double cosine = std::cos(angle / 2) * q.w + std::sin(angle / 2) * axis.dot(cv::Vec3d(q.x, q.y, q.z));
  EXPECT_LT(2 * std::acos(std::min(1., std::abs(cosine))), 0.2 * CV_PI / 180);

  ASSERT_TRUE(waitFor([&] { return markers_.count() > 0; }));
  // Deleting the old ones, outline, axes, name, ellipsoid.
  EXPECT_EQ(5U, markers_.messages().back()->markers.size());
}

TEST_F(Position, thatIsAmbiguousIsReportedAsSuchAndNotInTf)
{
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  const PartArray answer = locate(view(7, 9, POSE));
  EXPECT_TRUE(answer.parts.empty());
  ASSERT_EQ(1U, answer.ambiguous.size());
  EXPECT_EQ(2U, answer.ambiguous.front().candidates.size());
  const cv::Mat plate = view(7, 10, POSE);
  ASSERT_TRUE(waitFor([&] {  // comes after what the first would have sent
    return locate(plate).parts.size() == 1 && buffer.canTransform("camera", "plate", ros::Time(0));
  }));
  EXPECT_FALSE(buffer.canTransform("camera", "sign", ros::Time(0)));
}

TEST_F(Position, thatIsAmbiguousIsNamedWithTheWayOut)
{
  const std::string text = "Ambiguous: sign (2 poses). Another marker of the part";
  EXPECT_NE(std::string::npos, diagnosticsAfter(view(7, 9, POSE), cameraInfo(), text).find(text));
}

TEST_F(Position, ofAPartThatIsDescribedWronglyIsWarnedOf)
{
  const cv::Mat picture = view(7, 10, POSE);
  const ros_test::ReloadedFile file("/position", "parts");
  const std::string board = "parts:\n- name: lid\n  checkerboards:\n  - {rows: 7, cols: 10, square: 0.03";
  EXPECT_TRUE(file.reload(board + ", surface: {cylinder: 1}}\n").success);
  const std::string text = "Parts: 1. lid: reprojection error ";
  EXPECT_EQ(0U, diagnosticsAfter(picture, cameraInfo(), text).find(text));
  EXPECT_EQ(diagnostic_msgs::DiagnosticStatus::WARN, newestStatus(diagnostics_, STATUS).level);
  EXPECT_TRUE(file.reload(board + "}\n").success);
  EXPECT_TRUE(waitFor([&] {
    show(picture, cameraInfo());
    return newestStatus(diagnostics_, STATUS).message == "Parts: 1.";
  }));
  EXPECT_EQ(diagnostic_msgs::DiagnosticStatus::OK, newestStatus(diagnostics_, STATUS).level);
}

TEST_F(Position, isNotGivenWithoutACalibration)
{
  const cv::Mat picture = view(7, 10, POSE);
  ASSERT_EQ(1U, locate(picture).parts.size());
  EXPECT_EQ("Parts: 1.", diagnosticsAfter(picture, cameraInfo(), "Parts: 1."));
  const std::size_t before = parts_.count();

  sensor_msgs::CameraInfo uncalibrated = cameraInfo();
  uncalibrated.K.fill(0);
  EXPECT_NE(std::string::npos, diagnosticsAfter(picture, uncalibrated, "not calibrated").find("not calibrated"));

  sensor_msgs::CameraInfo other = cameraInfo();
  other.width = 1600;
  other.height = 1200;
  const std::string size = "camera_info is of 1600 x 1200 px, the image has 800 x 600";
  EXPECT_EQ(0U, diagnosticsAfter(picture, other, size).find(size + ": calibrate"));

  sensor_msgs::CameraInfo unknown = cameraInfo();
  unknown.distortion_model = "barrel";
  EXPECT_NE(std::string::npos, diagnosticsAfter(picture, unknown, "barrel").find("barrel"));
  EXPECT_EQ(before, parts_.count());

  EXPECT_EQ("Parts: 1.", diagnosticsAfter(picture, cameraInfo(), "Parts: 1."));
}

TEST_F(Position, saysWhenCameraInfoIsMissingOrStale)
{
  const cv::Mat picture = view(7, 10, POSE);
  const std::size_t before = parts_.count();
  EXPECT_NE("", lastDiagnosticsUntil("No camera_info on /camera/camera_info for", [&] {
              image_.publish(toMessage(picture, ros::Time(ros::WallTime::now().toSec())));
            }));
  EXPECT_NE("", lastDiagnosticsUntil("no camera_info on /camera/camera_info has had the stamp of an image", [&] {
              const sensor_msgs::ImagePtr image = toMessage(picture, ros::Time(ros::WallTime::now().toSec()));
              sensor_msgs::CameraInfo stale = cameraInfo();
              stale.header = image->header;
              stale.header.stamp -= ros::Duration(100);
              camera_info_.publish(stale);
              image_.publish(image);
            }));
  EXPECT_EQ(before, parts_.count());
}
TEST_F(Position, saysWhichOfTheMarkersTopicsIsSilent)
{
  const auto only = [&](auto message, const std::string& topic) {
    ros::Publisher publisher = nh_.advertise<decltype(message)>(topic, 1);
    return [=, message = message]() mutable {
      message.header.stamp = ros::Time(ros::WallTime::now().toSec());
      publisher.publish(message);
      camera_info_.publish(cameraInfo());
    };
  };
  EXPECT_NE("", lastDiagnosticsUntil("No message on /detector/targets for",
                                     only(outdoor_omr::CheckerboardArray(), "/detector/checkerboards")));
  EXPECT_NE("", lastDiagnosticsUntil("No message on /detector/checkerboards for",
                                     only(outdoor_omr::TargetArray(), "/detector/targets")));
  EXPECT_NE("", lastDiagnosticsUntil("No message on /detector/checkerboards and /detector/targets for", [] {}));
}

TEST_F(Position, isOfThePartsFileAsReloaded)
{
  const cv::Mat picture = view(7, 10, POSE);
  const ros_test::ReloadedFile file("/position", "parts");
  std_srvs::TriggerResponse response =
      file.reload("parts:\n- name: lid\n  checkerboards:\n  - {rows: 7, cols: 10, square: 30}\n");
  EXPECT_FALSE(response.success);
  EXPECT_EQ(file.path() +
                ":4: parts[0].checkerboards[0].square: expected the side of a square in metres, 0.001 to 1, not '30'; "
                "what was read before stays in force",
            response.message);
  PartArray answer = locate(picture);
  ASSERT_EQ(1U, answer.parts.size());
  EXPECT_EQ("plate", answer.parts.front().name);

  response = file.reload("parts:\n- name: lid\n  checkerboards:\n  - {rows: 7, cols: 10, square: 0.03}\n");
  EXPECT_TRUE(response.success);
  EXPECT_EQ("1 part in " + file.path(), response.message);
  const auto last_pose = [&] { return valueOf(newestStatus(diagnostics_, STATUS), "Last pose of lid"); };
  EXPECT_TRUE(waitFor([&] { return last_pose() == "never"; })) << last_pose();
  answer = locate(picture);
  ASSERT_EQ(1U, answer.parts.size());
  EXPECT_EQ("lid", answer.parts.front().name);
  EXPECT_TRUE(waitFor([&] { return last_pose().find(" s ago") != std::string::npos; })) << last_pose();
}
}  // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_position");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
