"""A ROS 2 node without Skein's packages, outside the lock-step: it makes its UAV climb.

    free_node.py UAV FILE HEIGHT_M COMMANDS [stall|reject]

HEIGHT_M counts from where the node found the UAV. The node sends a command for each odometry message until the UAV is
there, but at least COMMANDS, and a message on /plan for every tenth command. Then it writes the number of messages that
it published, by topic, to FILE (JSON), and stays silent until it has no subscriber left.
With COMMANDS 0 it never ends. After forty commands it writes FILE.ready.
  stall   after twenty commands the node is silent for a simulated second; then sends ten at once, with their old stamps
  reject  five of its commands contain NaN
"""
import json
import math
import os
import sys

import rclpy
from geometry_msgs.msg import Transform
from nav_msgs.msg import Odometry
from std_msgs.msg import String
from tidy import remove_port_files
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

STALL_S, HELD_BACK = 1.0, 10


def stamp_s(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def write(file, text):
    with open(file + ".new", "w", encoding="utf-8") as out:
        out.write(text)
    os.replace(file + ".new", file)


class Free:
    def __init__(self, node, uav, file, height_m, commands, oddity):
        self.node, self.file, self.height_m, self.commands, self.oddity = node, file, height_m, commands, oddity
        self.trajectories = node.create_publisher(MultiDOFJointTrajectory, f"/{uav}/command/trajectory", 100)
        self.radio = node.create_publisher(String, "/plan", 100)
        node.create_subscription(Odometry, f"/{uav}/ground_truth/odometry", self.on_odometry, 10)
        self.published = {"trajectory": 0, "plan": 0}
        self.start, self.held_back, self.done = None, [], False

    def on_odometry(self, odometry):
        position = odometry.pose.pose.position
        if self.start is None:
            self.start = [position.x, position.y, position.z]
        if self.trajectories.get_subscription_count() < 2 or self.radio.get_subscription_count() < 2:
            return  # waits for two subscribers: the fleet's own program and the stand-in
        goal_z = self.start[2] + self.height_m
        if self.done:
            return
        if self.commands and self.published["trajectory"] >= self.commands and abs(position.z - goal_z) < 0.5:
            self.done = True
            write(self.file, json.dumps(self.published))
            return
        self.command(odometry, goal_z)

    def command(self, odometry, goal_z):
        count = self.published["trajectory"]
        message = MultiDOFJointTrajectory()
        message.header.stamp = odometry.header.stamp
        rejected = self.oddity == "reject" and 20 <= count < 25
        target = Transform()
        target.translation.x = math.nan if rejected else self.start[0]
        target.translation.y, target.translation.z = self.start[1], goal_z
        message.points.append(MultiDOFJointTrajectoryPoint(transforms=[target]))
        if self.oddity == "stall" and count == 20:
            if len(self.held_back) < HELD_BACK:
                self.held_back.append(message)
            if stamp_s(odometry) < stamp_s(self.held_back[0]) + STALL_S:
                return
            for late in self.held_back:
                self.publish(late)
        self.publish(message)

    def publish(self, message):
        self.trajectories.publish(message)
        self.published["trajectory"] += 1
        if self.published["trajectory"] % 10 == 0:
            self.radio.publish(String(data=f"command {self.published['trajectory']}"))
            self.published["plan"] += 1
        if self.published["trajectory"] == 40:
            write(self.file + ".ready", "")


def main():
    uav, file, height_m, commands = sys.argv[1:5]
    rclpy.init()
    node = rclpy.create_node("free")
    free = Free(node, uav, file, float(height_m), int(commands), sys.argv[5] if len(sys.argv) > 5 else "")
    while free.trajectories.get_subscription_count() < 2:
        rclpy.spin_once(node, timeout_sec=0.05)
    while free.trajectories.get_subscription_count() > 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    rclpy.shutdown()
    remove_port_files()


main()
