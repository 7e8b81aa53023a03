"""A ROS 2 node that subscribes in a UAV's domain with the settings of an RViz configuration, and to the diagnostics;
reports afterwards what it received.

    uav_viewer.py CONFIG UAV FILE    writes FILE.ready once it has found all topics, FILE (JSON) at the end of the run
"""
import json
import os
import sys

import rclpy
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from octomap_msgs.msg import Octomap
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import PointCloud, PointCloud2
from tf2_msgs.msg import TFMessage
from tidy import remove_port_files

TYPES = {"Odometry": Odometry, "PointCloud": PointCloud, "PointCloud2": PointCloud2, "OccupancyGrid": Octomap}


def seconds(stamp):
    return stamp.sec + 1e-9 * stamp.nanosec


def xyz(p):
    return [p.x, p.y, p.z]


class Viewer(Node):
    def __init__(self, config, uav):
        super().__init__("uav_viewer")
        self.shown = {}  # by topic: the type that its display takes, the type on the wire, samples, frames
        self.frames, self.odometry, self.diagnostics = [], [], []
        for display in config["Visualization Manager"]["Displays"]:
            if "Topic" in display:
                self.show(display, uav)
        many = QoSProfile(depth=5000)  # the fleet is faster than real time
        self.create_subscription(TFMessage, "/tf", self.on_frames, many)
        self.create_subscription(TFMessage, "/tf_static", self.on_frames,
                                 QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
        self.create_subscription(DiagnosticArray, "/diagnostics", self.on_diagnostics, many)
        self.create_subscription(Odometry, f"/{uav}/ground_truth/odometry", self.on_odometry, many)

    def show(self, display, uav):
        topic = display["Topic"]["Value"].replace("/uav/", f"/{uav}/")
        kind = TYPES[display["Class"].split("/")[1]]
        seen = self.shown[topic] = {"samples": 0, "frames": []}
        qos = QoSProfile(depth=display["Topic"]["Depth"])
        qos.durability = DurabilityPolicy[display["Topic"]["Durability Policy"].upper().replace(" ", "_")]
        qos.reliability = ReliabilityPolicy[display["Topic"]["Reliability Policy"].upper()]

        def heard(message):
            seen["samples"] += 1
            if message.header.frame_id not in seen["frames"]:
                seen["frames"].append(message.header.frame_id)

        self.create_subscription(kind, topic, heard, qos)
        package = kind.__module__.split(".")[0]
        seen["type"] = f"{package}/msg/{kind.__name__}"

    def on_frames(self, message):
        for frame in message.transforms:
            self.frames.append([seconds(frame.header.stamp), frame.header.frame_id, frame.child_frame_id,
                                xyz(frame.transform.translation)])

    def on_odometry(self, message):
        self.odometry.append([seconds(message.header.stamp), xyz(message.pose.pose.position)])

    def on_diagnostics(self, array):
        self.diagnostics.append([seconds(array.header.stamp), [
            [status.name, status.level[0] if isinstance(status.level, bytes) else status.level, status.message,
             {pair.key: pair.value for pair in status.values}] for status in array.status]])

    def publishers(self):
        topics = list(self.shown) + ["/tf", "/tf_static", "/diagnostics"]
        return [self.count_publishers(topic) for topic in topics]


def main():
    config, uav, file = sys.argv[1:]
    rclpy.init()
    with open(config, encoding="utf-8") as text:
        node = Viewer(yaml.safe_load(text), uav)
    while min(node.publishers()) == 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    types = dict(node.get_topic_names_and_types())
    for topic, seen in node.shown.items():
        seen["wire"] = types[topic]
    open(file + ".ready", "w", encoding="utf-8").close()
    while max(node.publishers()) > 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    for _ in range(5000):
        rclpy.spin_once(node, timeout_sec=0.0)
    with open(file + ".new", "w", encoding="utf-8") as out:
        json.dump({"shown": node.shown, "frames": node.frames, "odometry": node.odometry,
                   "diagnostics": node.diagnostics}, out)
    os.replace(file + ".new", file)
    rclpy.shutdown()
    remove_port_files()


main()
