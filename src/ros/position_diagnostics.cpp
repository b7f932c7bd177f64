#include "position_diagnostics.h"

#include <set>
#include <vector>

namespace omr
{
namespace
{
using diagnostic_msgs::DiagnosticStatus;

constexpr double PATIENCE = 5.0;  // [s] without a message before a warning

/** Of each sighting what it can be, and how many poses are left. */
std::string namesOf(const std::vector<outdoor_omr::Sighting>& sightings)
{
  std::string names;
  for (const outdoor_omr::Sighting& sighting : sightings)
  {
    std::set<std::string> parts;
    for (const outdoor_omr::Part& candidate : sighting.candidates)
    {
      parts.insert(candidate.name);
    }
    names += names.empty() ? "" : ", ";
    for (const std::string& part : parts)
    {
      names += (part == *parts.begin() ? "" : " or ") + part;
    }
    names += " (" + std::to_string(sighting.candidates.size()) + " poses)";
  }
  return names;
}

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
}  // namespace

PositionDiagnostics::PositionDiagnostics(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh,
                                         const std::string& name)
    : markers_topics_(nh.resolveName("checkerboards") + " and " + nh.resolveName("targets")),
      camera_info_topic_(nh.resolveName("camera_info")),
      report_(nh, private_nh, name, "position of parts", "none", [this](auto& status) { report(status); })
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

void PositionDiagnostics::located(const outdoor_omr::PartArray& parts)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++images_;
  last_match_ = Clock::now();
  refusal_.clear();
  parts_ = static_cast<int>(parts.parts.size());
  ambiguous_ = static_cast<int>(parts.ambiguous.size());
  ambiguous_names_ = namesOf(parts.ambiguous);
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
    status.summaryf(DiagnosticStatus::WARN, "No message on %s for %.0f s: does the detector get images?",
                    markers_topics_.c_str(), secondsSince(last_markers_));
  }
  else if (secondsSince(last_camera_info_) > PATIENCE)
  {
    status.summaryf(
        DiagnosticStatus::ERROR,
        "No camera_info on %s for %.0f s, so no part has a position: does the camera's driver publish there?",
        camera_info_topic_.c_str(), secondsSince(last_camera_info_));
  }
  else if (secondsSince(last_match_) > PATIENCE)
  {
    status.summaryf(
        DiagnosticStatus::ERROR,
        "For %.0f s no camera_info on %s has had the stamp of an image: is it of another camera, or stamped "
        "anew on its way?",
        secondsSince(last_match_), camera_info_topic_.c_str());
  }
  else if (!refusal_.empty())
  {
    status.summaryf(DiagnosticStatus::ERROR, "%s", refusal_.c_str());
  }
  else if (ambiguous_ > 0)
  {
    status.summaryf(DiagnosticStatus::WARN,
                    "Parts: %d. Ambiguous: %s. Another marker of the part in view tells which, as a target beside the "
                    "board.",
                    parts_, ambiguous_names_.c_str());
  }
  else
  {
    status.summaryf(DiagnosticStatus::OK, "Parts: %d.", parts_);
  }
}

}  // namespace omr
