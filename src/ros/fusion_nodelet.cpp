#include <outdoor_omr/FusionArray.h>
#include <outdoor_omr/PartArray.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "caught.h"
#include "checked_nodelet.h"
#include "number_parameter.h"
#include "part_fusion.h"
#include "part_messages.h"
#include "pose_messages.h"
#include "reload_service.h"
#include "status_report.h"
#include "tracker_parameters.h"
#include "transform_wait.h"
#include "view_collector.h"

namespace omr
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr double PATIENCE = 5;        // [s] without a camera before a warning
constexpr double LATE_PERIOD = 0.02;  // [s] at which late cameras are given up
}  // namespace

/** Positions of parts from several cameras in, one position of each part out. */
class FusionNodelet : public CheckedNodelet
{
 private:
  void start() override
  {
    ros::NodeHandle& nh = getNodeHandle();
    ros::NodeHandle& private_nh = getPrivateNodeHandle();
    if (!private_nh.getParam("inputs", topics_) || topics_.empty())
    {
      throw std::invalid_argument(
          "parameter ~inputs: expected a list of topics of the cameras' positions, as [left/position/parts, "
          "right/position/parts]");
    }
    frame_ = private_nh.param<std::string>("frame", "");
    if (frame_.empty() || frame_.front() == '/')
    {
      throw std::invalid_argument("parameter ~frame: expected the TF frame to fuse in, as 'base', not '" + frame_ +
                                  "'");
    }
    const std::string read = readFile();
    settings_.sigma.position = readNumber(private_nh, "camera_position_sigma", 0.001, 1);
    settings_.sigma.rotation = readNumber(private_nh, "camera_rotation_sigma", 0.0005, 1);
    settings_.min_cameras = private_nh.param("min_cameras", 1);
    if (settings_.min_cameras < 1 || settings_.min_cameras > static_cast<int>(topics_.size()))
    {
      throw std::invalid_argument("parameter ~min_cameras: expected 1 to " + std::to_string(topics_.size()) +
                                  ", the number of inputs, not " + std::to_string(settings_.min_cameras));
    }
    const double patience = readNumber(private_nh, "patience", 0.1, 10);
    transforms_ =
        std::make_unique<TransformWait>(buffer_, ros::WallDuration(readNumber(private_nh, "tf_timeout", 0.1, 10)));
    tracker_ = std::make_unique<PartTracker>(readTrackerSettings(private_nh));
    publish_tf_ = private_nh.param("publish_tf", true);
    collector_ =
        std::make_unique<ViewCollector>(topics_.size(), readNumber(private_nh, "time_tolerance", 0.02, 10), patience);
    NODELET_INFO("%zu cameras, fused in %s, %s", topics_.size(), frame_.c_str(), read.c_str());

    parts_ = private_nh.advertise<outdoor_omr::PartArray>("parts", 1);
    markers_ = private_nh.advertise<visualization_msgs::MarkerArray>("markers", 1);
    fusions_ = private_nh.advertise<outdoor_omr::FusionArray>("fusions", 1);
    report_ = std::make_unique<StatusReport>(nh, private_nh, getName(), "fusion of cameras", "none",
                                             [this](auto& status) { report(status); });
    late_ = nh.createWallTimer(ros::WallDuration(LATE_PERIOD), [this](const ros::WallTimerEvent& /*event*/) {
      const std::lock_guard<std::mutex> lock(mutex_);
      publish(collector_->takeLate(now()));
    });
    for (std::size_t camera = 0; camera < topics_.size(); ++camera)
    {
      inputs_.push_back(nh.subscribe<outdoor_omr::PartArray>(
          topics_[camera], 10, [this, camera](const outdoor_omr::PartArrayConstPtr& view) {
            const std::lock_guard<std::mutex> lock(mutex_);
            publish(collector_->add(camera, *view, now()));
          }));
    }
    reload_ = advertiseReload(private_nh, [this] { return readFile(); });
  }

  /** Reads the parts file if one is named, changes nothing if it throws. @return what was read. */
  std::string readFile()
  {
    const auto file = getPrivateNodeHandle().param<std::string>("parts", "");
    const std::lock_guard<std::mutex> lock(mutex_);
    descriptions_ = file.empty() ? std::vector<Part>() : readParts(file);
    settings_.copies = copiesOf(descriptions_);
    return file.empty() ? "no parts file" : countOf(descriptions_.size(), "part") + " in " + file;
  }

  double now() const
  {
    return (ros::SteadyTime::now() - start_).toSec();
  }

  void publish(const std::vector<ViewCollector::Collection>& collections)
  {
    for (const ViewCollector::Collection& collection : collections)
    {
      const std::string error = caught([&] { fuseAndPublish(collection); });
      if (!error.empty() && error != complaint_)
      {
        NODELET_ERROR("No position from these cameras: %s", error.c_str());
      }
      complaint_ = error;
    }
  }

  void fuseAndPublish(const ViewCollector::Collection& collection)
  {
    std::vector<CameraView> cameras;
    std_msgs::Header header;
    header.frame_id = frame_;
    header.stamp = collection.stamp;
    unplaced_.clear();
    for (const outdoor_omr::PartArray& view : collection.views)
    {
      // A camera that TF cannot place costs what it alone sees.
      const std::string error = caught([&] { cameras.push_back({view, placeOf(view.header)}); });
      unplaced_ += (error.empty() || unplaced_.empty() ? "" : "; ") + error;
    }
    if (cameras.empty())
    {
      throw std::runtime_error(unplaced_);
    }
    FusedViews fused = fuseViews(cameras, header, settings_);
    track(fused.parts, *tracker_);
    parts_.publish(fused.parts);
    fusions_.publish(fused.report);
    if (markers_.getNumSubscribers() > 0)
    {
      markers_.publish(toMarkers(fused.parts, descriptions_));
    }
    if (publish_tf_)
    {
      for (const outdoor_omr::Part& part : fused.parts.parts)
      {
        broadcaster_.sendTransform(toTransform(header, part, descriptions_));
      }
    }
    last_ = fused;
  }

  cv::Affine3d placeOf(const std_msgs::Header& camera)
  {
    if (camera.frame_id == frame_)
    {
      return cv::Affine3d::Identity();
    }
    return fromMessage(transforms_->lookup(frame_, camera.frame_id, camera.stamp).transform);
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string silent;
    std::string too_late;
    bool is_any_heard = false;
    for (std::size_t camera = 0; camera < topics_.size(); ++camera)
    {
      const double silence = collector_->silence(camera, now());
      const bool is_too_late = silence <= PATIENCE && collector_->isTooLate(camera);
      status.addf(topics_[camera], "%.1f s ago%s", silence, is_too_late ? ", too late" : "");
      is_any_heard = is_any_heard || silence <= PATIENCE;
      silent += silence > PATIENCE ? " " + topics_[camera] : "";
      too_late += is_too_late ? " " + topics_[camera] : "";
    }
    std::string contradicted;
    std::string too_few;
    for (const outdoor_omr::Fusion& fusion : last_.report.parts)
    {
      status.addf(fusion.part, "%zu cameras, chi square %.1f of %u degrees of freedom", fusion.frame_ids.size(),
                  fusion.chi_square, fusion.degrees_of_freedom);
      contradicted += fusion.agree == 0 ? " " + fusion.part : "";
      too_few += static_cast<int>(fusion.frame_ids.size()) < settings_.min_cameras ? " " + fusion.part : "";
    }
    // What cameras said last is not said for ever once all are silent.
    if (is_any_heard && (!complaint_.empty() || !unplaced_.empty()))
    {
      status.summary(DiagnosticStatus::ERROR, complaint_.empty() ? unplaced_ : complaint_);
    }
    else if (is_any_heard && !contradicted.empty())
    {
      status.summary(DiagnosticStatus::ERROR, "Cameras contradict each other on" + contradicted +
                                                  ": has one been moved? is its transform right?");
    }
    else if (is_any_heard && !too_few.empty())
    {
      status.summaryf(DiagnosticStatus::WARN, "Seen by fewer than %d cameras, not published:%s", settings_.min_cameras,
                      too_few.c_str());
    }
    else if (!too_late.empty())
    {
      status.summary(DiagnosticStatus::WARN, "Not fused, as the views came too late:" + too_late +
                                                 ". Is ~patience too short, or do the computers' clocks differ?");
    }
    else if (!silent.empty())
    {
      status.summary(DiagnosticStatus::WARN, "Nothing for 5 s from" + silent);
    }
    else
    {
      status.summaryf(DiagnosticStatus::OK, "Parts: %zu.", last_.parts.parts.size());
    }
  }

  std::vector<std::string> topics_;
  std::string frame_;
  std::vector<Part> descriptions_;  // for the markers; empty: they show nothing
  FusionSettings settings_;
  bool publish_tf_ = true;
  const ros::SteadyTime start_ = ros::SteadyTime::now();

  std::mutex mutex_;
  std::unique_ptr<ViewCollector> collector_;
  std::string complaint_;  // of the last collection, not repeated
  std::string unplaced_;   // what TF said of cameras in the last collection
  FusedViews last_;
  std::unique_ptr<PartTracker> tracker_;

  ros::Publisher parts_;
  ros::Publisher fusions_;
  ros::Publisher markers_;
  tf2_ros::TransformBroadcaster broadcaster_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};
  std::unique_ptr<TransformWait> transforms_;

  // Destroyed first: no callback outlives what it uses.
  std::unique_ptr<StatusReport> report_;
  ros::WallTimer late_;
  ros::ServiceServer reload_;
  std::vector<ros::Subscriber> inputs_;
};

}  // namespace omr

PLUGINLIB_EXPORT_CLASS(omr::FusionNodelet, nodelet::Nodelet)
