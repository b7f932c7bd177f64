#include <nodelet/loader.h>
#include <ros/ros.h>

/** One nodelet alone in a process, for systems without a nodelet manager. The build names it. */
int main(int argc, char** argv)
{
  ros::init(argc, argv, OUTDOOR_OMR_NODELET);
  nodelet::Loader loader(false);
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), "outdoor_omr/" OUTDOOR_OMR_NODELET, ros::names::getRemappings(),
                   arguments))
  {
    return 1;
  }
  ros::spin();
  return 0;
}
