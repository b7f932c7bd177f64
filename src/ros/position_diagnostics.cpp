#include "position_diagnostics.h"

#include <algorithm>
#include <set>
#include <utility>

#include "outdoor_omr/locate.h"

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
                                         const std::string& name, const std::vector<std::string>& parts)
    : topics_{nh.resolveName("checkerboards"), nh.resolveName("targets"), nh.resolveName("camera_info")},
      report_(nh, private_nh, name, "position of parts", "none", [this](auto& status) { report(status); })
{
  partsAre(parts);
}

void PositionDiagnostics::partsAre(const std::vector<std::string>& parts)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::map<std::string, std::optional<Clock::time_point>> seen;
  for (const std::string& part : parts)
  {
    seen[part] = seen_[part];
  }
  seen_ = std::move(seen);
}

void PositionDiagnostics::came(PositionInput input)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  last_.at(static_cast<std::size_t>(input)) = Clock::now();
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
  misfits_.clear();
  for (const outdoor_omr::Part& part : parts.parts)
  {
    seen_[part.name] = last_match_;
    const std::string misfit = misfitOf(part.name, part.reprojection_error);
    misfits_ += (misfits_.empty() || misfit.empty() ? "" : "; ") + misfit;
  }
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
  for (const auto& [part, time] : seen_)
  {
    if (time)
    {
      status.addf("Last pose of " + part, "%.1f s ago", secondsSince(*time));
    }
    else
    {
      status.add("Last pose of " + part, "never");
    }
  }
}

double PositionDiagnostics::silence(PositionInput input) const
{
  return secondsSince(last_.at(static_cast<std::size_t>(input)));
}

const std::string& PositionDiagnostics::topicOf(PositionInput input) const
{
  return topics_.at(static_cast<std::size_t>(input));
}

void PositionDiagnostics::summarize(diagnostic_updater::DiagnosticStatusWrapper& status) const
{
  using Input = PositionInput;
  const bool boards_lack = silence(Input::checkerboards) > PATIENCE;
  const bool targets_lack = silence(Input::targets) > PATIENCE;
  if (boards_lack && targets_lack)
  {
    status.summaryf(DiagnosticStatus::WARN, "No message on %s and %s for %.0f s: does the detector get images?",
                    topicOf(Input::checkerboards).c_str(), topicOf(Input::targets).c_str(),
                    std::min(silence(Input::checkerboards), silence(Input::targets)));
  }
  else if (boards_lack || targets_lack)
  {
    const Input silent = boards_lack ? Input::checkerboards : Input::targets;
    const Input other = boards_lack ? Input::targets : Input::checkerboards;
    status.summaryf(DiagnosticStatus::ERROR,
                    "No message on %s for %.0f s, but on %s, so no part has a position: are both of one detector?",
                    topicOf(silent).c_str(), silence(silent), topicOf(other).c_str());
  }
  else if (silence(Input::camera_info) > PATIENCE)
  {
    status.summaryf(
        DiagnosticStatus::ERROR,
        "No camera_info on %s for %.0f s, so no part has a position: does the camera's driver publish there?",
        topicOf(Input::camera_info).c_str(), silence(Input::camera_info));
  }
  else if (secondsSince(last_match_) > PATIENCE)
  {
    status.summaryf(
        DiagnosticStatus::ERROR,
        "For %.0f s no camera_info on %s has had the stamp of an image: is it of another camera, or stamped "
        "anew on its way?",
        secondsSince(last_match_), topicOf(Input::camera_info).c_str());
  }
  else if (!refusal_.empty())
  {
    status.summaryf(DiagnosticStatus::ERROR, "%s", refusal_.c_str());
  }
  else
  {
    const bool fine = ambiguous_ == 0 && misfits_.empty();
    std::string text = "Parts: " + std::to_string(parts_) + ".";
    if (ambiguous_ > 0)
    {
      text += " Ambiguous: " + ambiguous_names_ +
              ". Another marker of the part in view tells which, as a target beside the board.";
    }
    text += misfits_.empty() ? "" : " " + misfits_ + ".";
    status.summary(fine ? DiagnosticStatus::OK : DiagnosticStatus::WARN, text);
  }
}

}  // namespace omr
