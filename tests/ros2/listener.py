"""A ROS 2 node that subscribes to a UAV's topics as any node would, and reports afterwards what it received.

    listener.py UAV FILE      writes FILE.ready once it has found the UAV's topics, FILE (JSON) at the end of the run
"""
import json
import os
import sys

import rclpy
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import PointCloud2
from tidy import remove_port_files


class Listener(Node):
    def __init__(self, uav):
        super().__init__("listener")
        self.odometry, self.clouds, self.clocks = [], [], 0
        self.topics = [f"/{uav}/ground_truth/odometry", f"/{uav}/cloud_inW", "/clock"]
        deep = QoSProfile(depth=5000)  # the fleet is faster than real time, and no message may be missed
        self.create_subscription(Odometry, self.topics[0], self.on_odometry, deep)
        self.create_subscription(PointCloud2, self.topics[1], self.on_cloud, deep)
        self.create_subscription(Clock, self.topics[2], self.on_clock, deep)

    def on_odometry(self, odometry):
        p = odometry.pose.pose.position
        self.odometry.append([stamp(odometry), p.x, p.y, p.z])

    def on_cloud(self, cloud):
        self.clouds.append([stamp(cloud), cloud.width, [field.name for field in cloud.fields]])

    def on_clock(self, _):
        self.clocks += 1

    def publishers(self):
        return [self.count_publishers(topic) for topic in self.topics]


def stamp(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def write(file, text):
    with open(file + ".new", "w", encoding="utf-8") as out:
        out.write(text)
    os.replace(file + ".new", file)


def main():
    uav, file = sys.argv[1:]
    rclpy.init()
    node = Listener(uav)
    while min(node.publishers()) == 0 or node.count_subscribers(f"/{uav}/command/trajectory") == 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    types = dict(node.get_topic_names_and_types())
    write(file + ".ready", "")
    while max(node.publishers()) > 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    for _ in range(5000):
        rclpy.spin_once(node, timeout_sec=0.0)
    write(file, json.dumps({"odometry": node.odometry, "clouds": node.clouds, "clocks": node.clocks, "types": types}))
    rclpy.shutdown()
    remove_port_files()


main()
