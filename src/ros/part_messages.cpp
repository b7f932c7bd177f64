#include "part_messages.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>

#include "pose_messages.h"

namespace omr
{
namespace
{
using visualization_msgs::Marker;

outdoor_omr::Part toMessage(const PartPose& located)
{
  outdoor_omr::Part message;
  message.name = located.part;
  message.pose = toMessage(PoseEstimate{located.pose.camera_part, located.pose.covariance});
  message.checkerboards.assign(located.checkerboards.begin(), located.checkerboards.end());
  message.targets.assign(located.targets.begin(), located.targets.end());
  message.points = static_cast<std::uint32_t>(std::count(located.pose.used.begin(), located.pose.used.end(), true));
  message.reprojection_error = static_cast<float>(located.pose.rms_error);
  return message;
}

std_msgs::ColorRGBA color(float red, float green, float blue, float alpha)
{
  std_msgs::ColorRGBA message;
  message.r = red;
  message.g = green;
  message.b = blue;
  message.a = alpha;
  return message;
}

Marker marker(const outdoor_omr::PartArray& parts, const outdoor_omr::Part& part, const char* what, int type)
{
  Marker result;
  result.header = parts.header;
  result.ns = part.name + "_" + std::to_string(part.copy) + "/" + what;
  result.type = type;
  result.action = Marker::ADD;
  result.pose = part.pose.pose;
  result.color = color(1, 1, 0, 1);
  return result;
}

/** The outer edges of the board, along the surface, in the frame of the part [m]. */
std::vector<cv::Point3d> outlineOf(const PartCheckerboard& board)
{
  // The inner corners of a board that is two squares larger are the corners of this one's squares.
  PartCheckerboard larger = board;
  larger.rows += 2;
  larger.cols += 2;
  const std::vector<cv::Point3d> nodes = innerCorners(larger);
  const int rows = board.rows + 1;
  const int cols = board.cols + 1;
  std::vector<cv::Point3d> outline;
  const auto add = [&](int row, int col) { outline.push_back(nodes[row * cols + col]); };
  for (int col = 0; col < cols; ++col)
  {
    add(0, col);
  }
  for (int row = 1; row < rows; ++row)
  {
    add(row, cols - 1);
  }
  for (int col = cols - 2; col >= 0; --col)
  {
    add(rows - 1, col);
  }
  for (int row = rows - 2; row >= 0; --row)
  {
    add(row, 0);
  }
  return outline;
}

Marker ellipsoidOf(const outdoor_omr::PartArray& parts, const outdoor_omr::Part& part)
{
  constexpr double LEAST = 1e-6;  // [m]; rviz refuses flat spheres
  cv::Matx33d covariance;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      covariance(i, j) = part.pose.covariance[6 * i + j];
    }
  }
  cv::Vec3d variances;
  cv::Matx33d axes;  // rows
  cv::eigen(covariance, variances, axes);
  if (cv::determinant(axes) < 0)
  {
    axes = axes * -1;
  }
  Marker result = marker(parts, part, "covariance", Marker::SPHERE);
  result.pose.orientation = toQuaternion(axes.t());
  const auto diameter = [&](int i) { return LEAST + 2 * std::sqrt(CHI_SQUARE_95 * std::max(0., variances[i])); };
  result.scale.x = diameter(0);
  result.scale.y = diameter(1);
  result.scale.z = diameter(2);
  result.color = color(1, 0, 1, 0.5F);
  return result;
}

Checkerboard toBoard(const outdoor_omr::Checkerboard& from)
{
  Checkerboard board;
  board.rows = static_cast<int>(from.rows);
  board.cols = static_cast<int>(from.cols);
  const std::size_t count = from.rows > 0 && from.cols > 0 ? (from.rows - 1) * std::size_t{from.cols - 1} : 0;
  if (count == 0 || from.inner_corners.size() != count || from.inner_corners_seen.size() != count)
  {
    throw std::invalid_argument("a checkerboard of " + std::to_string(from.rows) + " x " + std::to_string(from.cols) +
                                " squares with " + std::to_string(from.inner_corners.size()) + " inner corners and " +
                                std::to_string(from.inner_corners_seen.size()) + " flags of them");
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!std::isfinite(from.inner_corners[i].x + from.inner_corners[i].y))
    {
      throw std::invalid_argument("a checkerboard with an inner corner that is no number");
    }
    board.inner_corners.emplace_back(from.inner_corners[i].x, from.inner_corners[i].y);
    board.inner_corners_seen.push_back(from.inner_corners_seen[i] != 0);
  }
  for (std::size_t i = 0; i < board.corners.size(); ++i)
  {
    board.corners[i] = {from.corners[i].x, from.corners[i].y};
  }
  board.size_certain = from.size_certain != 0;
  return board;
}
}  // namespace

CameraInfo fromMessage(const sensor_msgs::CameraInfo& message)
{
  CameraInfo info;
  info.width = static_cast<int>(message.width);
  info.height = static_cast<int>(message.height);
  info.distortion_model = message.distortion_model;
  info.D = message.D;
  std::copy(message.K.begin(), message.K.end(), info.K.begin());
  std::copy(message.P.begin(), message.P.end(), info.P.begin());
  return info;
}

std::vector<Checkerboard> fromMessage(const outdoor_omr::CheckerboardArray& message)
{
  std::vector<Checkerboard> boards;
  std::transform(message.checkerboards.begin(), message.checkerboards.end(), std::back_inserter(boards), toBoard);
  std::transform(message.sections.begin(), message.sections.end(), std::back_inserter(boards), toBoard);
  return boards;
}

std::vector<Target> fromMessage(const outdoor_omr::TargetArray& message)
{
  std::vector<Target> targets;
  for (const outdoor_omr::Target& from : message.targets)
  {
    Target target;
    target.colors = from.colors;
    target.center = {from.center.x, from.center.y};
    if (!std::isfinite(target.center.x + target.center.y))
    {
      throw std::invalid_argument("a target whose centre is no number");
    }
    if (!std::isfinite(from.outermost_deviation) || from.outermost_deviation < 0)
    {
      throw std::invalid_argument("a target whose outermost_deviation is " + std::to_string(from.outermost_deviation) +
                                  " px: expected 0, not known, or more");
    }
    target.outermost_deviation = from.outermost_deviation;
    for (const outdoor_omr::Ellipse& ring : from.rings)
    {
      target.rings.emplace_back(cv::Point2f(ring.center.x, ring.center.y), cv::Size2f(ring.major_axis, ring.minor_axis),
                                static_cast<float>(ring.angle * 180 / CV_PI));
    }
    targets.push_back(target);
  }
  return targets;
}

outdoor_omr::PartArray toMessage(const std_msgs::Header& header, const std::vector<Sighting>& sightings)
{
  outdoor_omr::PartArray message;
  message.header = header;
  for (const Sighting& sighting : sightings)
  {
    if (sighting.certain())
    {
      message.parts.push_back(toMessage(sighting.candidates.front()));
      continue;
    }
    message.ambiguous.emplace_back();
    for (const PartPose& candidate : sighting.candidates)
    {
      message.ambiguous.back().candidates.push_back(toMessage(candidate));
    }
  }
  return message;
}

void track(outdoor_omr::PartArray& parts, PartTracker& tracker)
{
  std::vector<TrackedPart> tracked;
  for (const outdoor_omr::Part& part : parts.parts)
  {
    tracked.push_back({part.name, fromMessage(part.pose), 0, 0});
  }
  tracker.track(tracked, parts.header.stamp.toSec());
  for (std::size_t i = 0; i < tracked.size(); ++i)
  {
    parts.parts[i].id = tracked[i].id;
    parts.parts[i].copy = tracked[i].copy;
    parts.parts[i].pose = toMessage(tracked[i].estimate);
  }
}

std::string frameOf(const outdoor_omr::Part& part, const std::vector<Part>& descriptions)
{
  const auto has_copies = [&](const Part& candidate) { return candidate.name == part.name && candidate.copies > 1; };
  const bool numbered = std::any_of(descriptions.begin(), descriptions.end(), has_copies);
  return numbered ? part.name + "_" + std::to_string(part.copy) : part.name;
}

geometry_msgs::TransformStamped toTransform(const std_msgs::Header& header, const outdoor_omr::Part& part,
                                            const std::vector<Part>& descriptions)
{
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = frameOf(part, descriptions);
  transform.transform.translation.x = part.pose.pose.position.x;
  transform.transform.translation.y = part.pose.pose.position.y;
  transform.transform.translation.z = part.pose.pose.position.z;
  transform.transform.rotation = part.pose.pose.orientation;
  return transform;
}

visualization_msgs::MarkerArray toMarkers(const outdoor_omr::PartArray& parts, const std::vector<Part>& descriptions)
{
  visualization_msgs::MarkerArray message;
  message.markers.emplace_back();
  message.markers.back().header = parts.header;
  message.markers.back().action = Marker::DELETEALL;
  for (const outdoor_omr::Part& part : parts.parts)
  {
    const auto description = std::find_if(descriptions.begin(), descriptions.end(),
                                          [&](const Part& candidate) { return candidate.name == part.name; });
    if (description == descriptions.end())
    {
      continue;
    }
    double size = 0;  // of the part's largest board [m]
    for (const PartCheckerboard& board : description->checkerboards)
    {
      size = std::max(size, board.cols * board.square);
    }
    Marker outline = marker(parts, part, "outline", Marker::LINE_STRIP);
    outline.scale.x = 0.01 * size;
    for (const PartCheckerboard& board : description->checkerboards)
    {
      outline.id = static_cast<int>(&board - description->checkerboards.data());
      outline.points.clear();
      for (const cv::Point3d& point : outlineOf(board))
      {
        outline.points.push_back(toPoint(point));
      }
      message.markers.push_back(outline);
    }
    Marker axes = marker(parts, part, "axes", Marker::LINE_LIST);
    axes.scale.x = 0.02 * size;
    for (int axis = 0; axis < 3; ++axis)
    {
      cv::Vec3d tip(0, 0, 0);
      tip[axis] = 0.5 * size;
      axes.points.push_back(toPoint({0, 0, 0}));
      axes.points.push_back(toPoint(tip));
      axes.colors.insert(axes.colors.end(), 2, color(axis == 0, axis == 1, axis == 2, 1));
    }
    message.markers.push_back(axes);
    Marker name = marker(parts, part, "name", Marker::TEXT_VIEW_FACING);
    name.text = frameOf(part, descriptions);
    name.scale.z = 0.15 * size;
    message.markers.push_back(name);
    message.markers.push_back(ellipsoidOf(parts, part));
  }
  return message;
}

}  // namespace omr
