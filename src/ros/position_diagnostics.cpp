#include "position_diagnostics.h"

namespace omr
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr double PATIENCE = 5.0;  // [s] without a message before a warning

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}  // namespace

PositionDiagnostics::PositionDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                                         const std::string& name)
    : report_(nh, private_nh, name, "position of parts", "none", [this](auto& status) { report(status); })
{
}

void PositionDiagnostics::markersCame()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  last_markers_ = Clock::now();
}

void PositionDiagnostics::cameraInfoCame()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  last_camera_info_ = Clock::now();
}

void PositionDiagnostics::located(int parts, int ambiguous)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++images_;
  last_match_ = Clock::now();
  refusal_.clear();
  parts_ = parts;
  ambiguous_ = ambiguous;
}

void PositionDiagnostics::refused(const std::string& reason)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_;
  last_match_ = Clock::now();
  refusal_ = reason;
  parts_ = ambiguous_ = 0;
}

void PositionDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  summarize(status);
  status.add("Images located", images_);
  status.add("Images refused", refused_);
  status.add("Last refusal", refusal_);
  status.add("Parts in the last image", parts_);
  status.add("Ambiguous in the last image", ambiguous_);
}

void PositionDiagnostics::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const
{
  if (secondsSince(last_markers_) > PATIENCE)
  {
    status.summaryf(DiagnosticStatus::WARN, "No checkerboards or targets for %.0f s.", secondsSince(last_markers_));
  }
  else if (secondsSince(last_camera_info_) > PATIENCE)
  {
    status.summaryf(DiagnosticStatus::ERROR, "No camera_info for %.0f s: no part has a position.",
                    secondsSince(last_camera_info_));
  }
  else if (secondsSince(last_match_) > PATIENCE)
  {
    status.summaryf(DiagnosticStatus::ERROR,
                    "For %.0f s no camera_info has had the stamp of an image: is it of another camera?",
                    secondsSince(last_match_));
  }
  else if (!refusal_.empty())
  {
    status.summaryf(DiagnosticStatus::ERROR, "%s", refusal_.c_str());
  }
  else if (ambiguous_ > 0)
  {
    status.summaryf(DiagnosticStatus::WARN, "Parts: %d, ambiguous sightings: %d.", parts_, ambiguous_);
  }
  else
  {
    status.summaryf(DiagnosticStatus::OK, "Parts: %d.", parts_);
  }
}

}  // namespace omr
