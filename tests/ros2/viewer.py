"""A ROS 2 node that subscribes in a run's world domain with the settings of RViz 2, and reports afterwards what it
received.

    viewer.py FILE      writes FILE.ready once it has found all topics, FILE (JSON) at the end of the run
"""
import json
import os
import sys

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import PointCloud2
from tf2_msgs.msg import TFMessage
from tidy import remove_port_files
from visualization_msgs.msg import Marker, MarkerArray


def xyz(p):
    return [p.x, p.y, p.z]


class Viewer(Node):
    def __init__(self):
        super().__init__("viewer")
        self.frames, self.fleet, self.markers, self.clouds = [], [], [], []
        moving = QoSProfile(depth=5000)  # the fleet is faster than real time, and no message may be missed
        static = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.topics = []
        for kind, topic, heard, qos in [(TFMessage, "/tf", self.on_frames, moving),
                                        (TFMessage, "/tf_static", self.on_frames, static),
                                        (MarkerArray, "/viz/fleet", self.on_fleet, moving),
                                        (MarkerArray, "/viz/frusta", self.on_array, moving),
                                        (MarkerArray, "/viz/paths", self.on_array, moving),
                                        (Marker, "/viz/links", self.on_marker, moving),
                                        (Marker, "/viz/structure", self.on_marker, static),
                                        (Marker, "/viz/boxes", self.on_marker, static),
                                        (PointCloud2, "/viz/map", self.on_cloud, static),
                                        (PointCloud2, "/viz/scored", self.on_cloud, static)]:
            self.create_subscription(kind, topic, heard, qos)
            self.topics.append(topic)

    def on_frames(self, message):
        for frame in message.transforms:
            stamp = frame.header.stamp.sec + 1e-9 * frame.header.stamp.nanosec
            self.frames.append([stamp, frame.header.frame_id, frame.child_frame_id, xyz(frame.transform.translation)])

    def on_fleet(self, array):
        self.fleet = [[marker.text, xyz(marker.pose.position)] for marker in array.markers]
        self.on_array(array)

    def on_array(self, array):
        for marker in array.markers:
            self.on_marker(marker)

    def on_marker(self, marker):
        self.markers.append({
            "frame": marker.header.frame_id, "name": marker.ns, "type": marker.type, "points": len(marker.points),
            "colors": len(marker.colors), "alpha": marker.color.a, "scale": xyz(marker.scale),
            "rest": [marker.texture_resource, marker.texture.format, list(marker.texture.data),
                     len(marker.uv_coordinates), marker.mesh_resource, marker.mesh_file.filename,
                     list(marker.mesh_file.data), marker.mesh_use_embedded_materials]})

    def on_cloud(self, cloud):
        self.clouds.append([cloud.width, [field.name for field in cloud.fields]])

    def publishers(self):
        return [self.count_publishers(topic) for topic in self.topics]


def main():
    file = sys.argv[1]
    rclpy.init()
    node = Viewer()
    while min(node.publishers()) == 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    types = dict(node.get_topic_names_and_types())
    open(file + ".ready", "w", encoding="utf-8").close()
    while max(node.publishers()) > 0:
        rclpy.spin_once(node, timeout_sec=0.05)
    for _ in range(5000):
        rclpy.spin_once(node, timeout_sec=0.0)
    with open(file + ".new", "w", encoding="utf-8") as out:
        json.dump({"frames": node.frames, "fleet": node.fleet, "markers": node.markers, "clouds": node.clouds,
                   "types": types}, out)
    os.replace(file + ".new", file)
    rclpy.shutdown()
    remove_port_files()


main()
