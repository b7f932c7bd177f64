#include "part_fusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "pose_messages.h"

namespace omr
{
namespace
{
/** One camera's pose of a part, in the shared frame. */
struct SeenPart
{
  std::size_t camera = 0;
  std::string frame_id;  // of the camera
  outdoor_omr::Part part;
  PoseEstimate estimate;
};

SeenPart see(std::size_t camera, const CameraView& view, const outdoor_omr::Part& part, const CameraSigma& sigma)
{
  SeenPart seen{camera, view.parts.header.frame_id, part, {}};
  seen.estimate = inSharedFrame(fromMessage(part.pose), view.frame_camera, sigma);
  seen.part.pose = toMessage(seen.estimate);
  seen.part.id = 0;  // of the camera's own tracking
  seen.part.checkerboards.clear();
  seen.part.targets.clear();
  return seen;
}

/** One part of all that carried its pose. */
outdoor_omr::Part joined(const std::vector<SeenPart>& seen, const FusedPose& fused)
{
  outdoor_omr::Part part = seen.front().part;
  part.pose = toMessage(fused.estimate);
  part.points = 0;
  double squares = 0;
  for (const SeenPart& one : seen)
  {
    part.points += one.part.points;
    squares += one.part.points * std::pow(one.part.reprojection_error, 2);
  }
  part.reprojection_error = static_cast<float>(std::sqrt(squares / std::max(1U, part.points)));
  return part;
}

outdoor_omr::Fusion reportOf(const std::vector<SeenPart>& seen, const FusedPose& fused)
{
  outdoor_omr::Fusion report;
  report.part = seen.front().part.name;
  for (std::size_t i = 0; i < seen.size(); ++i)
  {
    const cv::Vec6d& step = fused.residuals[i];
    report.frame_ids.push_back(seen[i].frame_id);
    report.distances_mm.push_back(1000 * cv::norm(cv::Vec3d(step[0], step[1], step[2])));
    report.angles_deg.push_back(180 / CV_PI * cv::norm(cv::Vec3d(step[3], step[4], step[5])));
  }
  report.chi_square = fused.chi_square;
  report.degrees_of_freedom = static_cast<std::uint32_t>(fused.degrees_of_freedom);
  report.agree = static_cast<std::uint8_t>(fused.agree);
  return report;
}

/** What cameras see of one thing, and what they say together. */
struct Group
{
  std::vector<SeenPart> seen;
  FusedPose fused;
};

FusedPose fuseSeen(const std::vector<SeenPart>& seen)
{
  std::vector<PoseEstimate> estimates;
  std::transform(seen.begin(), seen.end(), std::back_inserter(estimates),
                 [](const SeenPart& one) { return one.estimate; });
  return fuse(estimates);
}

/** The copies of a part: each pose joins the one that it agrees with best, of those that its camera is not in yet. */
std::vector<Group> groupsOf(const std::vector<SeenPart>& seen)
{
  std::vector<Group> groups;
  for (const SeenPart& one : seen)
  {
    Group* best = nullptr;
    FusedPose best_fused;
    double least = std::numeric_limits<double>::infinity();
    for (Group& group : groups)
    {
      if (std::any_of(group.seen.begin(), group.seen.end(),
                      [&](const SeenPart& other) { return other.camera == one.camera; }))
      {
        continue;
      }
      std::vector<SeenPart> together = group.seen;
      together.push_back(one);
      const FusedPose fused = fuseSeen(together);
      const double gained = fused.chi_square - group.fused.chi_square;
      if (fused.agree && gained < least)
      {
        best = &group;
        best_fused = fused;
        least = gained;
      }
    }
    if (best != nullptr)
    {
      best->seen.push_back(one);
      best->fused = best_fused;
    }
    else
    {
      groups.push_back({{one}, fuseSeen({one})});
    }
  }
  return groups;
}

/** Whether the groups can be so many things. */
bool canBe(const std::vector<Group>& groups, const Copies& copies)
{
  const bool agree = std::all_of(groups.begin(), groups.end(), [](const Group& group) { return group.fused.agree; });
  if (!agree || groups.size() > static_cast<std::size_t>(copies.count))
  {
    return false;
  }
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      const cv::Vec3d between =
          groups[i].fused.estimate.pose.translation() - groups[k].fused.estimate.pose.translation();
      if (cv::norm(between) < copies.apart)
      {
        return false;
      }
    }
  }
  return true;
}

Copies copiesOf(const std::string& name, const FusionSettings& settings)
{
  const auto found = settings.copies.find(name);
  return found == settings.copies.end() ? Copies() : found->second;
}
}  // namespace

std::map<std::string, Copies> copiesOf(const std::vector<Part>& parts)
{
  std::map<std::string, Copies> result;
  for (const Part& part : parts)
  {
    double side = std::numeric_limits<double>::infinity();
    for (const PartCheckerboard& board : part.checkerboards)
    {
      side = std::min(side, board.rows * board.square);
    }
    result[part.name] = {part.copies, side};
  }
  return result;
}

FusedViews fuseViews(const std::vector<CameraView>& views, const std_msgs::Header& header,
                     const FusionSettings& settings)
{
  FusedViews answer;
  answer.parts.header = answer.report.header = header;
  std::map<std::string, std::vector<SeenPart>> certain;
  for (std::size_t camera = 0; camera < views.size(); ++camera)
  {
    for (const outdoor_omr::Part& part : views[camera].parts.parts)
    {
      certain[part.name].push_back(see(camera, views[camera], part, settings.sigma));
    }
  }
  for (const auto& [name, seen] : certain)
  {
    const Copies copies = copiesOf(name, settings);
    const std::vector<Group> groups = copies.count > 1 ? groupsOf(seen) : std::vector<Group>{{seen, fuseSeen(seen)}};
    if (canBe(groups, copies))
    {
      for (const Group& group : groups)
      {
        answer.report.parts.push_back(reportOf(group.seen, group.fused));
        if (static_cast<int>(group.seen.size()) >= settings.min_cameras)
        {
          answer.parts.parts.push_back(joined(group.seen, group.fused));
        }
      }
      continue;
    }
    answer.report.parts.push_back(reportOf(seen, fuseSeen(seen)));
    answer.report.parts.back().agree = 0;
    answer.parts.ambiguous.emplace_back();
    for (const SeenPart& one : seen)
    {
      answer.parts.ambiguous.back().candidates.push_back(one.part);
    }
  }
  for (std::size_t camera = 0; camera < views.size(); ++camera)
  {
    const CameraView& view = views[camera];
    for (const outdoor_omr::Sighting& sighting : view.parts.ambiguous)
    {
      outdoor_omr::Sighting shared;
      for (const outdoor_omr::Part& candidate : sighting.candidates)
      {
        if (certain.count(candidate.name) == 0)
        {
          shared.candidates.push_back(see(camera, view, candidate, settings.sigma).part);
        }
      }
      if (!shared.candidates.empty())
      {
        answer.parts.ambiguous.push_back(shared);
      }
    }
  }
  return answer;
}

}  // namespace omr
