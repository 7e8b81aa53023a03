"""A ROS 2 node outside the lock-step. It sends commands to a UAV and radio messages until it has no subscriber left.

    commander.py UAV FILE     writes FILE.ready once both of its topics have a subscriber
"""
import sys

import rclpy
from geometry_msgs.msg import Transform
from std_msgs.msg import String
from tidy import remove_port_files
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

uav, file = sys.argv[1:]
rclpy.init()
node = rclpy.create_node("commander")
trajectories = node.create_publisher(MultiDOFJointTrajectory, f"/{uav}/command/trajectory", 10)
radio = node.create_publisher(String, "/plan", 10)
command = MultiDOFJointTrajectory()
target = Transform()
target.translation.x = 1000.0
command.points.append(MultiDOFJointTrajectoryPoint(transforms=[target]))


def send():
    trajectories.publish(command)
    radio.publish(String(data="hello"))
    if trajectories.get_subscription_count() > 0 and radio.get_subscription_count() > 0:
        open(file + ".ready", "w", encoding="utf-8").close()


node.create_timer(0.02, send)
while trajectories.get_subscription_count() == 0:
    rclpy.spin_once(node)
while trajectories.get_subscription_count() > 0:
    rclpy.spin_once(node)
rclpy.shutdown()
remove_port_files()
