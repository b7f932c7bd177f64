#include "outdoor_omr/goals.h"

#include <algorithm>

#include "yaml_file.h"
#include "yaml_pose.h"

namespace omr
{
namespace
{
constexpr double MIN_TOLERANCE_MM = 0.001;
constexpr double MAX_TOLERANCE_MM = 1000;
constexpr double MIN_TOLERANCE_DEGREES = 0.001;
constexpr double MAX_TOLERANCE_DEGREES = 180;

Goal readGoal(const YamlFile& node)
{
  node.allowOnly({"part", "frame", "pose", "tolerance_mm", "tolerance_degrees"},
                 "a map with 'part', 'frame', 'pose', 'tolerance_mm' and 'tolerance_degrees'");
  Goal goal;
  const std::string part = "the name of a part, as in the parts file";
  goal.part = node.get("part", part).text(part);
  const std::string frame = "the TF frame that the pose is in";
  const YamlFile frame_node = node.get("frame", frame);
  goal.frame = frame_node.text(frame);
  if (goal.frame.front() == '/')
  {
    frame_node.fail("'" + goal.frame + "': frames of tf2 do not begin with /");
  }
  if (goal.frame == goal.part)
  {
    frame_node.fail("'" + goal.frame + "' is the part itself: expected " + frame);
  }
  goal.pose = readPose(node.get("pose", "a map with 'xyz' and 'rpy_degrees' or 'quaternion'"));
  const std::string millimetres = "the largest distance from the goal in millimetres, 0.001 to 1000";
  goal.position_tolerance =
      node.get("tolerance_mm", millimetres).number(millimetres, MIN_TOLERANCE_MM, MAX_TOLERANCE_MM) / 1000;
  const std::string degrees = "the largest turn away from the goal in degrees, 0.001 to 180";
  goal.rotation_tolerance =
      node.get("tolerance_degrees", degrees).number(degrees, MIN_TOLERANCE_DEGREES, MAX_TOLERANCE_DEGREES) * CV_PI /
      180;
  return goal;
}
}  // namespace

std::vector<Goal> readGoals(const std::string& file)
{
  const YamlFile root = YamlFile::load(file);
  root.allowOnly({"goals"}, "a map with the key 'goals'");
  const std::string expected = "a list of one goal or more";
  const YamlFile list = root.get("goals", expected);
  std::vector<Goal> goals;
  for (const YamlFile& entry : list.list(expected))
  {
    Goal goal = readGoal(entry);
    if (std::any_of(goals.begin(), goals.end(), [&](const Goal& other) { return other.part == goal.part; }))
    {
      entry.get("part", "a name").fail("the part '" + goal.part + "' has a goal already");
    }
    goals.push_back(std::move(goal));
  }
  if (goals.empty())
  {
    list.fail("expected " + expected);
  }
  return goals;
}

}  // namespace omr
