#!/bin/sh
# Builds the packages of this workspace with CMake alone, where there is no colcon; in a shell in which ROS 2 is set up.
#   build.sh PREFIX [PACKAGE...]     installs into PREFIX, by default all of them; then: . PREFIX/setup.sh
set -eu
here=$(cd "$(dirname "$0")" && pwd)
prefix=$(mkdir -p "${1:?where to install}" && cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- skein_msgs skein_ros skein_ros_examples
export AMENT_PREFIX_PATH="$prefix:${AMENT_PREFIX_PATH:?source the setup file of a ROS 2 first}"
export CMAKE_PREFIX_PATH="$prefix:${CMAKE_PREFIX_PATH:-}"
python=$(python3 -c 'import sys; print("local/lib/python%d.%d/dist-packages" % sys.version_info[:2])')
for package in "$@"; do
  build="$prefix/build/$package"
  { cmake -G Ninja -S "$here/$package" -B "$build" -DCMAKE_INSTALL_PREFIX="$prefix" &&
    cmake --build "$build" --target install; } >"$prefix/build.log" || { cat "$prefix/build.log"; exit 1; }
done
cat >"$prefix/setup.sh" <<END
export AMENT_PREFIX_PATH="$prefix:\$AMENT_PREFIX_PATH"
export CMAKE_PREFIX_PATH="$prefix:\${CMAKE_PREFIX_PATH:-}"
export LD_LIBRARY_PATH="$prefix/lib:\${LD_LIBRARY_PATH:-}"
export PYTHONPATH="$prefix/$python:\${PYTHONPATH:-}"
END
