#!/usr/bin/env bash
# Every shell script of the repository goes through shellcheck. Usage: shell.sh ROOT
set -euo pipefail
cd "$1"
mapfile -t scripts < <(grep -rlE '^(#!/usr/bin/env bash|# shellcheck shell=bash)$' .ci scripts test)
# SC1091: what ROS and the build generate is not there to be followed.
shellcheck --external-sources --source-path=SCRIPTDIR --exclude=SC1091 "${scripts[@]}"
