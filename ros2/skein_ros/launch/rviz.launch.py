"""RViz 2 in the domain of one UAV of a running fleet (docs/how-to-ros2.md of Skein).

    ros2 launch skein_ros rviz.launch.py uav:=jurong domain:=42
"""
import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, SetEnvironmentVariable
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

# The topics in rviz/uav.rviz.
TOPICS = ["ground_truth/odometry", "cloud_inW", "slf_kf_cloud", "nbr_kf_cloud", "nbr_odom_cloud",
          "detected_interest_points", "octomap"]


def generate_launch_description():
    uav = LaunchConfiguration("uav")
    config = os.path.join(get_package_share_directory("skein_ros"), "rviz", "uav.rviz")
    return LaunchDescription([
        DeclareLaunchArgument("uav", description="name of the UAV"),
        DeclareLaunchArgument("domain", description="its DDS domain: the fleet's first, plus 2, plus its number"),
        SetEnvironmentVariable("ROS_DOMAIN_ID", LaunchConfiguration("domain")),
        Node(package="rviz2", executable="rviz2", arguments=["-d", config], parameters=[{"use_sim_time": True}],
             remappings=[("/uav/" + topic, ["/", uav, "/", topic]) for topic in TOPICS]),
    ])
