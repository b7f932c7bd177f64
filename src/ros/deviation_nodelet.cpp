#include <outdoor_omr/DeviationArray.h>
#include <outdoor_omr/PartArray.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "caught.h"
#include "checked_nodelet.h"
#include "number_parameter.h"
#include "outdoor_omr/deviation.h"
#include "pose_messages.h"
#include "reload_service.h"
#include "status_report.h"
#include "transform_wait.h"

namespace omr
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr double DEGREES = 180 / CV_PI;
constexpr double MILLIMETRES = 1000;
constexpr double PATIENCE = 5;      // [s] without a message before a warning
constexpr double MAX_TIMEOUT = 10;  // [s]

/** A deviation of which nothing is known yet. */
outdoor_omr::Deviation unknown(const Goal& goal)
{
  constexpr double NOT_KNOWN = std::numeric_limits<double>::quiet_NaN();
  outdoor_omr::Deviation message;
  message.part = goal.part;
  message.frame_id = goal.frame;
  message.translation_mm = message.rotation_deg = toVector(cv::Vec3d::all(NOT_KNOWN));
  message.distance_mm = message.angle_deg = NOT_KNOWN;
  message.distance_uncertainty_mm = message.angle_uncertainty_deg = NOT_KNOWN;
  message.tolerance_mm = goal.position_tolerance * MILLIMETRES;
  message.tolerance_deg = goal.rotation_tolerance * DEGREES;
  message.verdict = outdoor_omr::Deviation::UNKNOWN;
  return message;
}

std::uint8_t toMessage(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::within:
      return outdoor_omr::Deviation::WITHIN;
    case Verdict::outside:
      return outdoor_omr::Deviation::OUTSIDE;
    case Verdict::undecided:
      break;
  }
  return outdoor_omr::Deviation::UNDECIDED;
}

bool isAmbiguous(const std::string& name, const outdoor_omr::PartArray& parts)
{
  const auto is_it = [&](const outdoor_omr::Part& part) { return part.name == name; };
  return std::any_of(parts.ambiguous.begin(), parts.ambiguous.end(), [&](const outdoor_omr::Sighting& sighting) {
    return std::any_of(sighting.candidates.begin(), sighting.candidates.end(), is_it);
  });
}

/** Whether the image shows the part, certain or not. */
bool isSeen(const std::string& name, const outdoor_omr::PartArray& parts)
{
  return isAmbiguous(name, parts) || std::any_of(parts.parts.begin(), parts.parts.end(),
                                                 [&](const outdoor_omr::Part& part) { return part.name == name; });
}

/** The part of that name. @throws std::runtime_error saying why there is none, or not one only. */
const outdoor_omr::Part& onlyOne(const std::string& name, const outdoor_omr::PartArray& parts)
{
  const auto is_it = [&](const outdoor_omr::Part& part) { return part.name == name; };
  const auto count = std::count_if(parts.parts.begin(), parts.parts.end(), is_it);
  if (count > 1)
  {
    throw std::runtime_error("several copies of '" + name + "' are in view, and the goal is for one");
  }
  if (count == 1)
  {
    return *std::find_if(parts.parts.begin(), parts.parts.end(), is_it);
  }
  throw std::runtime_error(
      "'" + name + "' is " +
      (isAmbiguous(name, parts) ? "ambiguous: several parts or poses fit what is seen" : "not in view"));
}
}  // namespace

/** Positions of parts in, deviations from their goals out. */
class DeviationNodelet : public CheckedNodelet
{
 private:
  void start() override
  {
    ros::NodeHandle& nh = getNodeHandle();
    ros::NodeHandle& private_nh = getPrivateNodeHandle();
    const std::string read = readFile();
    transforms_ = std::make_unique<TransformWait>(
        buffer_, ros::WallDuration(readNumber(private_nh, "tf_timeout", 0.1, MAX_TIMEOUT)));
    NODELET_INFO("%s", read.c_str());
    report_ = std::make_unique<StatusReport>(nh, private_nh, getName(), "deviation of parts", "none",
                                             [this](auto& status) { report(status); });
    publisher_ = private_nh.advertise<outdoor_omr::DeviationArray>("deviations", 1);
    parts_ = nh.subscribe<outdoor_omr::PartArray>(
        "parts", 10, [this](const outdoor_omr::PartArrayConstPtr& parts) { receive(*parts); });
    reload_ = advertiseReload(private_nh, [this] { return readFile(); });
  }

  /** Reads the goals file, changes nothing if it throws. @return what was read. */
  std::string readFile()
  {
    const auto file = getPrivateNodeHandle().param<std::string>("goals", "");
    if (file.empty())
    {
      throw std::invalid_argument(
          "parameter ~goals: expected the path of a goals file; config/goals.yaml is an example");
    }
    goals_ = readGoals(file);
    return countOf(goals_.size(), "goal") + " in " + file;
  }

  void receive(const outdoor_omr::PartArray& parts)
  {
    const std::string error = caught([&] { publish(parts); });
    NODELET_ERROR_COND(!error.empty(), "No deviation of parts: %s", error.c_str());
  }

  void publish(const outdoor_omr::PartArray& parts)
  {
    outdoor_omr::DeviationArray message;
    message.header = parts.header;
    for (const Goal& goal : goals_)
    {
      outdoor_omr::Deviation deviation = unknown(goal);
      // A part whose frame TF does not know costs its own deviation, not that of the others.
      deviation.reason = caught([&] { measure(goal, parts, deviation); });
      message.deviations.push_back(deviation);
    }
    publisher_.publish(message);
    const std::lock_guard<std::mutex> lock(mutex_);
    last_ = message;
    last_time_ = ros::SteadyTime::now();
  }

  void measure(const Goal& goal, const outdoor_omr::PartArray& parts, outdoor_omr::Deviation& message)
  {
    const outdoor_omr::Part& part = onlyOne(goal.part, parts);
    const Deviation deviation = deviationFrom(goal, inFrameOf(goal, fromMessage(part.pose), parts));
    message.translation_mm = toVector(deviation.translation * MILLIMETRES);
    message.distance_mm = cv::norm(deviation.translation) * MILLIMETRES;
    message.rotation_deg = toVector(deviation.rotation * DEGREES);
    message.angle_deg = cv::norm(deviation.rotation) * DEGREES;
    message.distance_uncertainty_mm = deviation.position_uncertainty * MILLIMETRES;
    message.angle_uncertainty_deg = deviation.rotation_uncertainty * DEGREES;
    message.verdict = toMessage(deviation.verdict);
  }

  /** The estimate in the frame of the goal. */
  PoseEstimate inFrameOf(const Goal& goal, const PoseEstimate& estimate, const outdoor_omr::PartArray& parts)
  {
    if (goal.frame == parts.header.frame_id)
    {
      return estimate;
    }
    if (isSeen(goal.frame, parts))
    {
      // In the same image: TF would lose how uncertain that part is.
      return relativeTo(fromMessage(onlyOne(goal.frame, parts).pose), estimate);
    }
    const geometry_msgs::TransformStamped transform =
        transforms_->lookup(goal.frame, parts.header.frame_id, parts.header.stamp);
    return transformed(estimate, fromMessage(transform.transform));
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double silence = (ros::SteadyTime::now() - last_time_).toSec();
    int measured = 0;
    std::string reasons;
    for (const outdoor_omr::Deviation& deviation : last_.deviations)
    {
      measured += deviation.verdict != outdoor_omr::Deviation::UNKNOWN ? 1 : 0;
      reasons += deviation.reason.empty() ? "" : (reasons.empty() ? ": " : "; ") + deviation.reason;
      status.add(deviation.part, deviation.reason.empty() ? std::to_string(deviation.distance_mm) + " mm, " +
                                                                std::to_string(deviation.angle_deg) + " degrees"
                                                          : deviation.reason);
    }
    if (silence > PATIENCE)
    {
      status.summaryf(DiagnosticStatus::WARN,
                      "No parts on %s for %.0f s: does a position or fusion node publish there?",
                      parts_.getTopic().c_str(), silence);
      return;
    }
    status.summaryf(measured < static_cast<int>(goals_.size()) ? DiagnosticStatus::WARN : DiagnosticStatus::OK,
                    "%d of %zu parts measured%s.", measured, goals_.size(), reasons.c_str());
  }

  std::vector<Goal> goals_;
  std::mutex mutex_;
  outdoor_omr::DeviationArray last_;
  ros::SteadyTime last_time_ = ros::SteadyTime::now();
  ros::Publisher publisher_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_};  // has a thread of its own: a wait for TF does not keep TF away
  std::unique_ptr<TransformWait> transforms_;

  // Destroyed first: no callback outlives what it uses.
  std::unique_ptr<StatusReport> report_;
  ros::ServiceServer reload_;
  ros::Subscriber parts_;
};

}  // namespace omr

PLUGINLIB_EXPORT_CLASS(omr::DeviationNodelet, nodelet::Nodelet)
