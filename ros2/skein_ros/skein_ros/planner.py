"""The base class of planners in Python, the counterpart of skein_ros::Planner in C++."""
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
    time_s: float = 0.0  # simulated time [s]
    time_left_s: float = None  # remaining time of the mission [s]; None before the first takeoff
    p_WB: np.ndarray = None
    yaw: float = 0.0
    odometry: Odometry = None
    gimbal: TwistStamped = None  # linear: angles [rad]; angular: rates [rad/s]; y pitch, z yaw
    boxes: list = field(default_factory=list)  # for each box its eight vertices in W [m], an array of 8 x 3
    neighbours: list = field(default_factory=list)
    scan: PointCloud2 = None  # the LiDAR scan of this step, points in W; else None
    detections: PointCloud2 = None  # all interest points that this UAV has seen so far, or None
    messages: list = field(default_factory=list)  # texts of this step that others sent with say()

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
        """Decides what the UAV does. In the lock-step it is called once per step, 20 times per simulated second, when
        all messages of the step have been received; otherwise by a timer. An exception ends the process; the log has
        its text."""
        raise NotImplementedError

    def fly_to(self, p_WB, yaw):
        """Flies to a place [m, in W], with the heading `yaw` [rad]. The command holds until the next one."""
        self.fly(p_WB, (0.0, 0.0, 0.0), yaw)

    def fly(self, p_WB, v_WB, yaw):
        """The same, passing the place with a velocity [m/s, in W]."""
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
        """Turns the gimbal to angles relative to the body [rad]: positive pitch looks down, positive yaw turns left."""
        message = Twist()
        message.linear.x, message.linear.y, message.linear.z = 1.0, float(pitch), float(yaw)  # 1: angles
        self._gimbal.publish(message)

    def take_picture(self):
        """Takes a picture now. After the first call, the camera takes no pictures by itself any more."""
        message = BoolStamped(data=True)
        message.header.stamp = self._inputs.odometry.header.stamp
        self._trigger.publish(message)

    def say(self, text):
        """Sends a text by radio to all nodes in line of sight (topic /plan)."""
        self._radio.publish(String(data=text))

    def show_activity(self, mode):
        """Reports the UAV's activity, for people who watch. Publishes only changes."""
        if mode == self._mode:
            return
        self._mode = mode
        message = Activity(mode=mode)
        message.header.stamp = self._inputs.odometry.header.stamp
        self._activity.publish(message)

    def _listen(self, message_type, topic, callback, qos):
        """Subscribes to a topic without the executor, which would search all its entities for each message:
        `_take_all()` takes all messages of a step at once."""
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
