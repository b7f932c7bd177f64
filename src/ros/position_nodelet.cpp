#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "caught.h"
#include "checked_nodelet.h"
#include "part_messages.h"
#include "position_diagnostics.h"
#include "reload_service.h"
#include "tracker_parameters.h"

namespace omr
{
namespace
{
std::vector<std::string> namesOf(const std::vector<Part>& parts)
{
  std::vector<std::string> names;
  std::transform(parts.begin(), parts.end(), std::back_inserter(names), [](const Part& part) { return part.name; });
  return names;
}
}  // namespace

/** Markers of an image and the camera's calibration in, positions of parts out. */
class PositionNodelet : public CheckedNodelet
{
 private:
  using CheckerboardArray = outdoor_omr::CheckerboardArray;
  using TargetArray = outdoor_omr::TargetArray;

  // Images that may be at work between the camera and the detector's answer.
  static constexpr int QUEUE = 30;

  void start() override
  {
    ros::NodeHandle& nh = getNodeHandle();
    ros::NodeHandle& private_nh = getPrivateNodeHandle();
    const std::string read = readFile();
    const auto kind = private_nh.param<std::string>("image_kind", "raw");
    if (kind != "raw" && kind != "rectified")
    {
      throw std::invalid_argument("parameter ~image_kind: expected raw or rectified, not '" + kind + "'");
    }
    kind_ = kind == "raw" ? ImageKind::raw : ImageKind::rectified;
    tracker_ = std::make_unique<PartTracker>(readTrackerSettings(private_nh));
    publish_tf_ = private_nh.param("publish_tf", true);
    NODELET_INFO("%s, of %s images", read.c_str(), kind.c_str());
    diagnostics_ = std::make_unique<PositionDiagnostics>(nh, private_nh, getName(), namesOf(parts_));

    publisher_ = private_nh.advertise<outdoor_omr::PartArray>("parts", 1);
    markers_ = private_nh.advertise<visualization_msgs::MarkerArray>("markers", 1);

    checkerboards_.subscribe(nh, "checkerboards", QUEUE);
    targets_.subscribe(nh, "targets", QUEUE);
    camera_info_.subscribe(nh, "camera_info", QUEUE);
    checkerboards_.registerCallback([this](const auto& /*m*/) { diagnostics_->came(PositionInput::checkerboards); });
    targets_.registerCallback([this](const auto& /*m*/) { diagnostics_->came(PositionInput::targets); });
    camera_info_.registerCallback([this](const auto& /*m*/) { diagnostics_->came(PositionInput::camera_info); });
    matched_.setReset(true);  // a bag that begins anew: what waits for a match is of the last round, and in the way
    matched_.connectInput(checkerboards_, targets_, camera_info_);
    matched_.registerCallback(&PositionNodelet::receive, this);
    reload_ = advertiseReload(private_nh, [this] {
      std::string read = readFile();
      diagnostics_->partsAre(namesOf(parts_));
      return read;
    });
  }

  /** Reads the parts file, changes nothing if it throws. @return what was read. */
  std::string readFile()
  {
    const auto file = getPrivateNodeHandle().param<std::string>("parts", "");
    if (file.empty())
    {
      throw std::invalid_argument(
          "parameter ~parts: expected the path of a parts file; config/parts.yaml is an example");
    }
    parts_ = readParts(file);
    return countOf(parts_.size(), "part") + " in " + file;
  }

  void receive(const outdoor_omr::CheckerboardArrayConstPtr& checkerboards,
               const outdoor_omr::TargetArrayConstPtr& targets, const sensor_msgs::CameraInfoConstPtr& camera_info)
  {
    const std::string error = caught([&] { locate(*checkerboards, *targets, *camera_info); });
    if (!error.empty())
    {
      diagnostics_->refused(error);
      if (error != complaint_)
      {
        NODELET_ERROR("No position of parts: %s", error.c_str());
      }
    }
    complaint_ = error;
  }

  void locate(const CheckerboardArray& checkerboards, const TargetArray& targets,
              const sensor_msgs::CameraInfo& camera_info)
  {
    const Camera camera = cameraOf(camera_info);
    const cv::Size size(static_cast<int>(checkerboards.width), static_cast<int>(checkerboards.height));
    if (camera.size() != size)
    {
      throw std::invalid_argument("camera_info is of " + std::to_string(camera.size().width) + " x " +
                                  std::to_string(camera.size().height) + " px, the image has " +
                                  std::to_string(size.width) + " x " + std::to_string(size.height) +
                                  ": calibrate the camera at the size of its images, or set it to the calibrated one "
                                  "(binning and cropping change the size)");
    }
    const std::vector<Sighting> sightings =
        locateParts(fromMessage(checkerboards), fromMessage(targets), parts_, camera);
    outdoor_omr::PartArray message = toMessage(checkerboards.header, sightings);
    track(message, *tracker_);
    publisher_.publish(message);
    if (markers_.getNumSubscribers() > 0)
    {
      markers_.publish(toMarkers(message, parts_));
    }
    for (const outdoor_omr::Part& part : message.parts)
    {
      if (publish_tf_)
      {
        broadcaster_.sendTransform(toTransform(message.header, part, parts_));
      }
    }
    diagnostics_->located(message);
  }

  /** @throws std::invalid_argument naming the topic, for a message that describes no camera. */
  Camera cameraOf(const sensor_msgs::CameraInfo& message) const
  {
    std::optional<Camera> camera;
    const std::string error = caught([&] { camera.emplace(fromMessage(message), kind_); });
    if (!error.empty())
    {
      throw std::invalid_argument(camera_info_.getSubscriber().getTopic() + ": " + error);
    }
    return *camera;
  }

  std::vector<Part> parts_;
  ImageKind kind_ = ImageKind::raw;
  bool publish_tf_ = true;
  std::unique_ptr<PartTracker> tracker_;
  std::string complaint_;  // the last one, which is not repeated
  std::unique_ptr<PositionDiagnostics> diagnostics_;
  ros::Publisher publisher_;
  ros::Publisher markers_;
  tf2_ros::TransformBroadcaster broadcaster_;

  // Destroyed from the last to the first: the synchronizer lets go of its inputs, then these end, before all else.
  ros::ServiceServer reload_;
  message_filters::Subscriber<CheckerboardArray> checkerboards_;
  message_filters::Subscriber<TargetArray> targets_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> camera_info_;
  message_filters::TimeSynchronizer<CheckerboardArray, TargetArray, sensor_msgs::CameraInfo> matched_{QUEUE};
};

}  // namespace omr

PLUGINLIB_EXPORT_CLASS(omr::PositionNodelet, nodelet::Nodelet)
