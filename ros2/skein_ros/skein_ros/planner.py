"""The base class of planners in Python, as skein_ros::Planner is in C++."""
import math
from dataclasses import dataclass, field

import numpy as np
import rclpy
import rclpy.node
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Transform, Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import PointCloud, PointCloud2
from skein_msgs.msg import Activity, BoolStamped
from std_msgs.msg import String
from trajectory_msgs.msg import MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

from skein_ros import step

_DEPTH = 64


@dataclass
class Neighbour:
    """Another node in line of sight."""
    node: int  # 0: the ground station; UAV i of the fleet: i + 1
    p_W: np.ndarray


@dataclass
class Inputs:
    """All that has been received up to a step."""
    time_s: float = 0.0  # simulated
    time_left_s: float = None  # of the mission; None before the first take-off
    p_WB: np.ndarray = None
    yaw: float = 0.0
    odometry: Odometry = None
    gimbal: TwistStamped = None  # angles in linear, rates in angular: y pitch, z yaw
    boxes: list = field(default_factory=list)  # each: eight vertices in W, as an array of 8 x 3
    neighbours: list = field(default_factory=list)
    scan: PointCloud2 = None  # of this step, points in W; else None
    detections: PointCloud2 = None  # all interest points that this UAV ever saw, or None
    messages: list = field(default_factory=list)  # from others' say(), of this step

    def sees_station(self):
        return any(neighbour.node == 0 for neighbour in self.neighbours)


def _neighbours(cloud):
    if cloud.point_step < 16:
        return []
    points = np.frombuffer(cloud.data, dtype=np.uint8).reshape(-1, cloud.point_step)[:, :16].copy().view(np.float32)
    return [Neighbour(int(point[3]), point[:3].astype(float)) for point in points]


class Planner(rclpy.node.Node):
    def __init__(self, name="planner", **options):
        super().__init__(name, **options)
        self.uav = uav = step.uav()
        self._inputs = Inputs()
        self._mode = None
        publisher = self.create_publisher
        self._trajectory = publisher(MultiDOFJointTrajectory, f"/{uav}/command/trajectory", _DEPTH)
        self._gimbal = publisher(Twist, f"/{uav}/command/gimbal", _DEPTH)
        self._trigger = publisher(BoolStamped, f"/{uav}/command/camera_trigger", _DEPTH)
        self._radio = publisher(String, "/plan", _DEPTH)
        self._activity = publisher(Activity, f"/{uav}/activity", _DEPTH)
        self._ears = []
        hear = self._listen
        hear(Odometry, f"/{uav}/ground_truth/odometry", self._hear_odometry, _DEPTH)
        hear(TwistStamped, f"/{uav}/gimbal", lambda m: self._set(gimbal=m), _DEPTH)
        hear(Duration, f"/{uav}/mission_duration_remained",
             lambda m: self._set(time_left_s=m.sec + m.nanosec * 1e-9), _DEPTH)
        hear(PointCloud, "/gcs/bounding_box_vertices", self._hear_boxes,
             QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
        hear(PointCloud2, f"/{uav}/nbr_odom_cloud", lambda m: self._set(neighbours=_neighbours(m)), _DEPTH)
        hear(PointCloud2, f"/{uav}/cloud_inW", lambda m: self._set(scan=m), _DEPTH)
        hear(PointCloud2, f"/{uav}/detected_interest_points", lambda m: self._set(detections=m), _DEPTH)
        hear(String, f"/plan/{uav}", lambda m: self._inputs.messages.append(m.data), _DEPTH)
        if step.is_member():
            step.before_answer(self._step)
        else:
            self.create_timer(0.05, self._step)

    def plan(self, inputs):
        """Decides. In the lock-step it is called once a step, 20 times a simulated second, when all that belongs to the
        step has been received; otherwise by a timer. An exception ends the process, and its text is in the log."""
        raise NotImplementedError

    def fly_to(self, p_WB, yaw):
        """The vehicle flies to a place [m, in W], heading to `yaw`. Holds until the next command."""
        self.fly(p_WB, (0.0, 0.0, 0.0), yaw)

    def fly(self, p_WB, v_WB, yaw):
        """The same at a velocity [m/s, in W]."""
        transform, velocity = Transform(), Twist()
        transform.translation.x, transform.translation.y, transform.translation.z = map(float, p_WB)
        transform.rotation.w, transform.rotation.z = math.cos(yaw / 2), math.sin(yaw / 2)
        velocity.linear.x, velocity.linear.y, velocity.linear.z = map(float, v_WB)
        message = MultiDOFJointTrajectory()
        message.header.stamp = self._inputs.odometry.header.stamp
        message.header.frame_id = "world"
        message.points.append(MultiDOFJointTrajectoryPoint(transforms=[transform], velocities=[velocity]))
        self._trajectory.publish(message)

    def aim(self, pitch, yaw):
        """The gimbal turns to these angles, relative to the body: pitch down is positive, yaw to the left."""
        message = Twist()
        message.linear.x, message.linear.y, message.linear.z = 1.0, float(pitch), float(yaw)  # 1: angles
        self._gimbal.publish(message)

    def take_picture(self):
        """The camera takes a picture now, and from now on only when it is told to."""
        message = BoolStamped(data=True)
        message.header.stamp = self._inputs.odometry.header.stamp
        self._trigger.publish(message)

    def say(self, text):
        """By radio, to all nodes in line of sight (/plan)."""
        self._radio.publish(String(data=text))

    def show_activity(self, mode):
        """For people who watch, at each change."""
        if mode == self._mode:
            return
        self._mode = mode
        message = Activity(mode=mode)
        message.header.stamp = self._inputs.odometry.header.stamp
        self._activity.publish(message)

    def _listen(self, message_type, topic, callback, qos):
        """An executor goes around, through all that it could wait for, for each message: a step takes them all at
        once, so it is not told of these subscriptions."""
        subscription = self.create_subscription(message_type, topic, callback, qos)
        self._subscriptions.remove(subscription)
        self._ears.append(subscription)

    def _take_all(self):
        for ear in self._ears:
            with ear.handle:
                while (taken := ear.handle.take_message(ear.msg_type, False)) is not None:
                    ear.callback(taken[0])

    def _set(self, **values):
        for name, value in values.items():
            setattr(self._inputs, name, value)

    def _hear_odometry(self, message):
        p, q = message.pose.pose.position, message.pose.pose.orientation
        self._set(odometry=message, p_WB=np.array([p.x, p.y, p.z]),
                  time_s=message.header.stamp.sec + message.header.stamp.nanosec * 1e-9,
                  yaw=math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)))

    def _hear_boxes(self, message):
        vertices = np.array([[p.x, p.y, p.z] for p in message.points])
        self._set(boxes=list(vertices.reshape(-1, 8, 3)))

    def _step(self):
        self._take_all()
        if self._inputs.odometry is None:
            return
        self.plan(self._inputs)
        self._set(scan=None, messages=[])
