#include "part_fusion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "pose_messages.h"

namespace omr
{
namespace
{
/** One camera's pose of a part, in the shared frame. */
struct SeenPart
{
  std::string frame_id;  // of the camera
  outdoor_omr::Part part;
  PoseEstimate estimate;
};

SeenPart see(const CameraView& view, const outdoor_omr::Part& part, const CameraSigma& sigma)
{
  SeenPart seen{view.parts.header.frame_id, part, {}};
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
}  // namespace

FusedViews fuseViews(const std::vector<CameraView>& views, const std_msgs::Header& header,
                     const FusionSettings& settings)
{
  FusedViews answer;
  answer.parts.header = answer.report.header = header;
  std::map<std::string, std::vector<SeenPart>> certain;
  for (const CameraView& view : views)
  {
    for (const outdoor_omr::Part& part : view.parts.parts)
    {
      certain[part.name].push_back(see(view, part, settings.sigma));
    }
  }
  for (const auto& [name, seen] : certain)
  {
    std::vector<PoseEstimate> estimates;
    std::transform(seen.begin(), seen.end(), std::back_inserter(estimates),
                   [](const SeenPart& one) { return one.estimate; });
    const FusedPose fused = fuse(estimates);
    answer.report.parts.push_back(reportOf(seen, fused));
    if (fused.agree)
    {
      if (static_cast<int>(seen.size()) >= settings.min_cameras)
      {
        answer.parts.parts.push_back(joined(seen, fused));
      }
      continue;
    }
    answer.parts.ambiguous.emplace_back();
    for (const SeenPart& one : seen)
    {
      answer.parts.ambiguous.back().candidates.push_back(one.part);
    }
  }
  for (const CameraView& view : views)
  {
    for (const outdoor_omr::Sighting& sighting : view.parts.ambiguous)
    {
      outdoor_omr::Sighting shared;
      for (const outdoor_omr::Part& candidate : sighting.candidates)
      {
        if (certain.count(candidate.name) == 0)
        {
          shared.candidates.push_back(see(view, candidate, settings.sigma).part);
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
