#include <cv_bridge/cv_bridge.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/image_transport.h>

#include <boost/make_shared.hpp>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>

#include "candidate_messages.h"
#include "caught.h"
#include "checked_nodelet.h"
#include "diagnostics.h"
#include "image_input.h"
#include "image_thread.h"
#include "messages.h"
#include "outdoor_omr/detector.h"
#include "outdoor_omr/overlay.h"
#include "parameters.h"

namespace omr
{
/**
 * Images in, markers out.
 *
 * Every callback is short and comes from the one queue of getNodeHandle(); the images are processed in a thread of
 * their own, so that sliders, listeners and diagnostics never wait for one.
 */
class DetectorNodelet : public CheckedNodelet
{
 private:
  using ReconfigureServer = dynamic_reconfigure::Server<outdoor_omr::OmrConfig>;

  void start() override
  {
    ros::NodeHandle& private_nh = getPrivateNodeHandle();
    for (const std::string& complaint : checkParameters(private_nh))
    {
      NODELET_WARN("%s", complaint.c_str());
    }
    detector_ = std::make_unique<Detector>(private_nh.param<std::string>("device", "auto"));
    const auto network = private_nh.param<std::string>("candidate_network", "");
    if (!network.empty())
    {
      detector_->setNetwork(loadMarkerNetwork(network));
    }
    NODELET_INFO("Detecting markers on: %s", detector_->pipeline().device().name.c_str());
    diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), private_nh, getName(), detector_->pipeline());
    image_thread_ = std::make_unique<ImageThread>([this](const auto& image) { process(image); });
    reconfigure_server_ = std::make_unique<ReconfigureServer>(reconfigure_mutex_, private_nh);
    reconfigure_server_->setCallback(
        [this](outdoor_omr::OmrConfig& config, std::uint32_t /*level*/) { reconfigure(config); });

    // A listener may connect before advertise() has returned: connect() waits for this lock.
    const std::lock_guard<std::mutex> lock(connect_mutex_);
    const auto connect = [this](const auto& /*listener*/) { this->connect(); };
    checkerboards_ = private_nh.advertise<outdoor_omr::CheckerboardArray>("checkerboards", 1, connect, connect);
    targets_ = private_nh.advertise<outdoor_omr::TargetArray>("targets", 1, connect, connect);
    candidates_ = private_nh.advertise<outdoor_omr::CandidateArray>("candidates", 1, connect, connect);
    region_of_interest_ =
        private_nh.advertise<sensor_msgs::RegionOfInterest>("region_of_interest", 1, connect, connect);
    overlay_ = image_transport::ImageTransport(private_nh).advertise("overlay", 1, connect, connect);
  }

  /** Subscribes to the images when the first listener comes, and leaves them with the last. */
  void connect()
  {
    const std::string error = caught([this] {
      const std::lock_guard<std::mutex> lock(connect_mutex_);
      const bool listened = checkerboards_.getNumSubscribers() + targets_.getNumSubscribers() +
                                candidates_.getNumSubscribers() + region_of_interest_.getNumSubscribers() +
                                overlay_.getNumSubscribers() >
                            0;
      if (!listened)
      {
        images_.shutdown();
        diagnostics_->subscribed("");
      }
      else if (!images_)
      {
        const image_transport::TransportHints hints("raw", ros::TransportHints(), getPrivateNodeHandle());
        images_ = image_transport::ImageTransport(getNodeHandle())
                      .subscribe("image", 1, &DetectorNodelet::receive, this, hints);
        diagnostics_->subscribed(images_.getTopic());
      }
    });
    if (!error.empty())
    {
      diagnostics_->notSubscribed(error);
      NODELET_ERROR("Cannot subscribe to the images: %s", error.c_str());
    }
  }

  void reconfigure(outdoor_omr::OmrConfig& config)
  {
    Settings changed;
    const std::string error = caught([&] { changed = toSettings(config); });
    const std::lock_guard<std::mutex> lock(settings_mutex_);
    if (error.empty())
    {
      settings_ = changed;
      config_ = config;
    }
    else
    {
      NODELET_ERROR("Parameters refused, the old values stay: %s", error.c_str());
      config = config_;
    }
  }

  void receive(const sensor_msgs::ImageConstPtr& image)
  {
    if (image_thread_->put(image))
    {
      diagnostics_->dropped();
    }
  }

  void process(const sensor_msgs::ImageConstPtr& image)
  {
    const int failures = detector_->pipeline().device().failures;
    const std::string error = caught([&] { detect(image); });
    const DeviceState& device = detector_->pipeline().device();
    diagnostics_->ranOn(device);
    if (device.failures > failures)
    {
      NODELET_WARN_THROTTLE(5, "The device failed: %s; the next images on: %s", device.last_failure.c_str(),
                            device.name.c_str());
    }
    if (!error.empty())
    {
      diagnostics_->refused(error);
      NODELET_WARN_THROTTLE(5, "Image refused: %s", error.c_str());
    }
  }

  void detect(const sensor_msgs::ImageConstPtr& image)
  {
    const bool draw = overlay_.getNumSubscribers() > 0;
    Settings settings = currentSettings();
    settings.overlay_regions = settings.overlay_regions && draw;
    const cv::Mat bgr = toBgr(image);
    const Markers markers = detector_->detect(bgr, settings);
    publish(checkerboards_, toMessage(image->header, bgr.size(), markers.checkerboards, markers.sections));
    publish(targets_, toMessage(image->header, bgr.size(), markers.targets));
    if (settings.candidate_mode == CandidateMode::all)
    {
      publish(candidates_, toMessage(image->header, bgr.size(), markers.candidates));
      publish(region_of_interest_, unreadRegion(bgr.size(), markers.candidates));
    }
    if (draw)
    {
      const cv::Mat picture = drawOverlay(bgr, markers, detector_->regions());
      overlay_.publish(cv_bridge::CvImage(image->header, "bgr8", picture).toImageMsg());
    }
    diagnostics_->processed(markers.times);
  }

  Settings currentSettings()
  {
    const std::lock_guard<std::mutex> lock(settings_mutex_);
    return settings_;
  }

  /** By pointer, so that listeners in the same manager get it without a copy. */
  template <typename Message>
  static void publish(const ros::Publisher& publisher, const Message& message)
  {
    publisher.publish(boost::make_shared<Message>(message));
  }

  std::unique_ptr<Detector> detector_;
  std::unique_ptr<Diagnostics> diagnostics_;

  std::mutex settings_mutex_;
  Settings settings_;
  outdoor_omr::OmrConfig config_;  // what settings_ came from

  std::mutex connect_mutex_;
  ros::Publisher checkerboards_;
  ros::Publisher targets_;
  ros::Publisher candidates_;
  ros::Publisher region_of_interest_;
  image_transport::Publisher overlay_;

  // Destroyed from the last to the first: no more images, no more sliders, then the image at work is finished.
  std::unique_ptr<ImageThread> image_thread_;
  boost::recursive_mutex reconfigure_mutex_;
  std::unique_ptr<ReconfigureServer> reconfigure_server_;
  image_transport::Subscriber images_;
};

}  // namespace omr

PLUGINLIB_EXPORT_CLASS(omr::DetectorNodelet, nodelet::Nodelet)
