#include "yaml_pose.h"

#include <cmath>

namespace omr
{
namespace
{
constexpr double MAX_POSITION = 50;            // [m]
constexpr double QUATERNION_TOLERANCE = 0.01;  // of its length: digits that were cut off when it was copied

cv::Matx33d readRollPitchYaw(const YamlFile& node, const std::string& expected)
{
  const cv::Vec3d turn = readVector(node, expected, 360) * (CV_PI / 180);
  const cv::Affine3d roll(cv::Vec3d(turn[0], 0, 0));
  const cv::Affine3d pitch(cv::Vec3d(0, turn[1], 0));
  const cv::Affine3d yaw(cv::Vec3d(0, 0, turn[2]));
  return (yaw * pitch * roll).rotation();
}

cv::Matx33d readQuaternion(const YamlFile& node, const std::string& expected)
{
  cv::Vec4d q;
  int i = 0;
  for (const YamlFile& entry : node.list(expected, 4))
  {
    q[i++] = entry.number(expected, -1.01, 1.01);
  }
  if (std::abs(cv::norm(q) - 1) > QUATERNION_TOLERANCE)
  {
    node.fail("expected " + expected + "; its length is " + std::to_string(cv::norm(q)) + ", not 1");
  }
  const cv::Vec3d axis(q[0], q[1], q[2]);
  const double sine = cv::norm(axis);
  const double angle = 2 * std::atan2(sine, q[3]);
  return cv::Affine3d(sine > 0 ? axis * (angle / sine) : axis).rotation();
}
}  // namespace

const char* const POSITION_IN_METRES = "three positions in metres, each -50 to 50";

cv::Vec3d readVector(const YamlFile& node, const std::string& expected, double bound)
{
  cv::Vec3d vector;
  int i = 0;
  for (const YamlFile& entry : node.list(expected, 3))
  {
    vector[i++] = entry.number(expected, -bound, bound);
  }
  return vector;
}

cv::Vec3d readPosition(const YamlFile& node)
{
  return readVector(node, POSITION_IN_METRES, MAX_POSITION);
}

cv::Affine3d readPose(const YamlFile& node)
{
  node.allowOnly({"xyz", "rpy_degrees", "quaternion"}, "a map with 'xyz' and 'rpy_degrees' or 'quaternion'");
  const cv::Vec3d position = readPosition(node.get("xyz", POSITION_IN_METRES));
  cv::Matx33d rotation = cv::Matx33d::eye();
  const std::string degrees = "roll, pitch and yaw in degrees, each -360 to 360";
  const std::string quaternion = "a quaternion x, y, z, w of length 1";
  if (node.has("rpy_degrees"))
  {
    rotation = readRollPitchYaw(node.get("rpy_degrees", degrees), degrees);
  }
  if (node.has("quaternion"))
  {
    const YamlFile value = node.get("quaternion", quaternion);
    if (node.has("rpy_degrees"))
    {
      value.fail("the turn is given twice: keep 'rpy_degrees' or 'quaternion'");
    }
    rotation = readQuaternion(value, quaternion);
  }
  return {rotation, position};
}

}  // namespace omr
