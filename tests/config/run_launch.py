"""Prints what a launch file would start, without ROS's launch packages: stand-ins for their modules record each call.
Prints one line of JSON.

    run_launch.py FILE      arguments of the launch file appear as {"argument": NAME}
"""
import json
import runpy
import sys
import types


class Called:
    """Stands in for any action or substitution: a call returns its name and its arguments."""

    def __init__(self, name):
        self.name = name

    def __call__(self, *args, **kwargs):
        return {self.name: [list(args), kwargs]}


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(members)


module("ament_index_python")
module("ament_index_python.packages", get_package_share_directory=lambda package: "share/" + package)
module("launch", LaunchDescription=lambda actions: actions)
module("launch.actions", **{name: Called(name) for name in ("DeclareLaunchArgument", "SetEnvironmentVariable")})
module("launch.substitutions", LaunchConfiguration=lambda name: {"argument": name})
module("launch_ros")
module("launch_ros.actions", Node=Called("Node"))
print(json.dumps(runpy.run_path(sys.argv[1])["generate_launch_description"]()))
