#include <nodelet/loader.h>
#include <ros/ros.h>

/** The position nodelet alone in a process: for systems without a nodelet manager. */
int main(int argc, char** argv)
{
  ros::init(argc, argv, "position");
  nodelet::Loader loader(false);
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), "outdoor_omr/position", ros::names::getRemappings(), arguments))
  {
    return 1;
  }
  ros::spin();
  return 0;
}
