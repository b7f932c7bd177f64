#include "parts_json.h"

#include <algorithm>
#include <cmath>

namespace omr
{
namespace
{
using Json = nlohmann::ordered_json;

/** x, y, z, w */
Json quaternion(const cv::Affine3d& pose)
{
  const cv::Vec3d turn = pose.rvec();
  const double angle = cv::norm(turn);
  const cv::Vec3d axis = angle > 0 ? turn * (std::sin(angle / 2) / angle) : turn;
  return {axis[0], axis[1], axis[2], std::cos(angle / 2)};
}

Json toJson(const PartPose& part)
{
  const cv::Affine3d& pose = part.pose.camera_part;
  const cv::Vec3d position = pose.translation();
  const auto used = std::count(part.pose.used.begin(), part.pose.used.end(), true);
  return {{"name", part.part},
          {"position", {position[0], position[1], position[2]}},
          {"orientation", quaternion(pose)},
          {"covariance", std::vector<double>(part.pose.covariance.val, part.pose.covariance.val + 36)},
          {"reprojection_error", part.pose.rms_error},
          {"points", used},
          {"outliers", part.pose.used.size() - used},
          {"checkerboards", part.checkerboards},
          {"targets", part.targets}};
}
}  // namespace

Json toJson(const std::string& image, const cv::Size& size, double milliseconds, const std::vector<Sighting>& sightings)
{
  Json parts = Json::array();
  Json ambiguous = Json::array();
  for (const Sighting& sighting : sightings)
  {
    Json candidates = Json::array();
    for (const PartPose& candidate : sighting.candidates)
    {
      candidates.push_back(toJson(candidate));
    }
    if (sighting.certain())
    {
      parts.push_back(candidates.front());
    }
    else
    {
      ambiguous.push_back(candidates);
    }
  }
  return {{"image", image},        {"width", size.width},
          {"height", size.height}, {"time_ms", std::round(milliseconds * 1000) / 1000},
          {"parts", parts},        {"ambiguous", ambiguous}};
}

}  // namespace omr
