# Sourced by the scripts beside it: one environment to build, test and run in.
# shellcheck shell=bash

OMR_ROOT="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
OMR_BUILD="$OMR_ROOT/build"

# Debian's ROS packages serve Debian's python3 only. Where another one (pyenv, conda) comes first on PATH, configuring
# and every ROS tool end in "No module named catkin_pkg".
export PATH="/usr/bin:$PATH"

# Ubuntu has ROS under /opt/ros, Debian under /usr.
if [ -f /opt/ros/noetic/setup.bash ]; then
  set +u
  . /opt/ros/noetic/setup.bash
  set -u
fi

# Without a network the machine's own name may not resolve, and no node finds another.
export ROS_HOSTNAME="${ROS_HOSTNAME:-127.0.0.1}"

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# Puts this package's programs on PATH, its messages and launch files within reach of roslaunch and rosbag. (rosrun
# finds nothing in a build folder that lies inside the package; in a catkin workspace it does.)
use_build() {
  set +u
  . "$OMR_BUILD/devel/setup.bash"
  set -u
  export PATH="$OMR_BUILD/devel/lib/outdoor_omr:$PATH"
}
