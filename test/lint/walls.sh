#!/usr/bin/env bash
# The walls between the layers: who may include what (README, "How it is built"). Usage: walls.sh ROOT
set -euo pipefail
cd "$1"
broken=0

# forbid WHAT PATTERN FOLDER...: no file of the folders includes a header that matches.
forbid() {
  local what=$1 pattern=$2
  shift 2
  if grep -rnE "#include *[<\"]($pattern)" "$@"; then
    echo "walls: $* must not use $what"
    broken=1
  fi
}

ros='ros/|nodelet/|pluginlib/|cv_bridge/|image_transport/|dynamic_reconfigure/|diagnostic_updater/|[a-z]*_msgs/'
forbid ROS "$ros" include src/core src/gpu
forbid OpenCL 'CL/' include src/core src/ros src/tools
forbid "the command line" 'CLI/|nlohmann/|iostream' include src/core src/gpu src/ros
exit $broken
