"""Converts between messages, with CARIC's conventions, and the types of `skein.planner`.

Frames W and B; SI units and radians.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import InputError
from ..planner import GimbalCommand, GimbalState, OrientedBox, State, TICKS_PER_SECOND, TrajectoryCommand
from ..planner_config import AgentConfig, Camera, FleetMember, Vector, VectorLike, Vehicle
from . import messages
from .messages import Message

_NANOSECONDS = 10**9
_SCAN = np.dtype({"names": ["x", "y", "z", "intensity"], "formats": ["<f4"] * 4})
_NEIGHBOUR = np.dtype([("p_W", "<f4", 3), ("node", "<f4"), ("t", "<f8"), ("q", "<f4", 4), ("v_B", "<f4", 3),
                       ("w_B", "<f4", 3)])
_DETECTED = np.dtype([("p_W", "<f4", 3), ("score", "<f4"), ("n_W", "<f4", 3), ("order", "<f4")])
#: Type of `Step.detected`.
DETECTED = np.dtype([("p_W", "<f4", 3), ("score", "<f8"), ("order", "<u4"), ("n_W", "<f4", 3)])


@dataclass(slots=True)
class Neighbour:
    """A node in line of sight."""

    node: int  #: 0 the station, 1, 2, ... the fleet
    name: str  #: "gcs", or the name of a UAV
    p_W: Vector
    v_W: Vector


def _rotated(q: Any, v: Any) -> Vector:
    """The vector v, given in B, in W. q is the attitude w, x, y, z, body to world."""
    w, u = q[0], np.asarray(q[1:], float)
    vector = np.asarray(v, float)
    rotated: Vector = vector + 2.0 * np.cross(u, np.cross(u, vector) + w * vector)
    return rotated


def _vector(point: Message) -> Vector:
    return np.array([point.x, point.y, point.z], float)


def state_of(odometry: Message) -> State:
    pose, twist = odometry.pose.pose, odometry.twist.twist
    q = pose.orientation
    q_WB = np.array([q.w, q.x, q.y, q.z])
    return State(_vector(pose.position), q_WB, _rotated(q_WB, _vector(twist.linear)), _vector(twist.angular))


def gimbal_of(twist: Message) -> GimbalState:
    angles, rates = twist.twist.linear, twist.twist.angular
    return GimbalState(angles.y, angles.z, rates.y, rates.z)


def seconds_of(duration: Message) -> float:
    return float(duration.sec + duration.nanosec / _NANOSECONDS)


def tick_of(header: Message) -> int:
    return int(round((header.stamp.sec + header.stamp.nanosec / _NANOSECONDS) * TICKS_PER_SECOND))


def boxes_of(cloud: Message) -> tuple[OrientedBox, ...]:
    """Boxes from their corners, eight per box: the first at -x -y -z along its own axes, then x fastest."""
    corners = np.array([[p.x, p.y, p.z] for p in cloud.points]).reshape(-1, 3)
    boxes = []
    for i in range(len(corners) // 8):
        own = corners[8 * i:8 * i + 8]
        edges = own[[1, 2, 4]] - own[0]
        size = np.linalg.norm(edges, axis=1)
        R_WO = np.eye(3)
        if size.min() > 0.0:  # the corners have single precision: the axes are made orthogonal again
            x = edges[0] / size[0]
            y = edges[1] - x * (x @ edges[1])
            y /= np.linalg.norm(y)
            z = np.cross(x, y)
            R_WO = np.column_stack([x, y, z if z @ edges[2] >= 0.0 else -z])
        boxes.append(OrientedBox(f"box{i + 1}", 0.5 * (own[0] + own[7]), size, R_WO))
    return tuple(boxes)


def _points(cloud: Message, layout: np.dtype[Any]) -> npt.NDArray[np.void]:
    """The points of a cloud; an empty array if the cloud has another layout."""
    if cloud.point_step != layout.itemsize or len(cloud.data) % layout.itemsize:
        return np.zeros(0, layout)
    return np.frombuffer(cloud.data.tobytes(), layout)


def cloud_points(cloud: Message) -> npt.NDArray[np.float32]:
    """(N, 3): the points of a scan or a key frame, in W."""
    points = _points(cloud, _SCAN)
    return np.column_stack([points["x"], points["y"], points["z"]])


def source_of(cloud: Message) -> int | None:
    """Number of the node whose LiDAR made a key frame; None if unknown."""
    points = _points(cloud, _SCAN)
    return _whole(float(points["intensity"][-1])) if len(points) else None


def _whole(number: float) -> int | None:
    return int(number) if math.isfinite(number) and number >= 0 and number == int(number) else None


def neighbours_of(cloud: Message, names: tuple[str, ...]) -> tuple[Neighbour, ...]:
    """The nodes in line of sight. `names`: of all nodes, the station first."""
    found = []
    for point in _points(cloud, _NEIGHBOUR):
        node = _whole(float(point["node"]))
        if node is None or node >= len(names):
            continue
        x, y, z, w = (float(number) for number in point["q"])
        found.append(Neighbour(node, names[node], np.array(point["p_W"], float),
                               _rotated((w, x, y, z), point["v_B"])))
    return tuple(found)


def detected_of(clouds: list[Message]) -> npt.NDArray[np.void]:
    points = np.concatenate([_points(cloud, _DETECTED) for cloud in clouds] or [np.zeros(0, _DETECTED)])
    points = points[(points["order"] >= 0) & (points["order"] < 2**32)]
    detected = np.zeros(len(points), DETECTED)
    for name in ("p_W", "score", "order", "n_W"):
        detected[name] = points[name]
    return detected


# ---- commands ----------------------------------------------------------------------------------------------------


def finite(value: VectorLike, what: str) -> Vector:
    """`value` as a vector of three finite numbers. Raises InputError. `what`: name of the value, for the message."""
    try:
        vector = np.array(value, float)
    except (TypeError, ValueError):
        raise InputError(f"{what}: must be three numbers, not {value!r}") from None
    if vector.shape != (3,) or not np.all(np.isfinite(vector)):
        raise InputError(f"{what}: must be three finite numbers, not {value!r}")
    return vector


def number(value: Any, what: str) -> float:
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
        raise InputError(f"{what}: must be a number, not {value!r}")
    try:
        as_float = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: must be a number, not {value!r}") from None
    if not math.isfinite(as_float):
        raise InputError(f"{what}: must be finite, not {value!r}")
    return as_float


def header_at(tick: int, frame: str = "world") -> Message:
    nanoseconds = tick * (_NANOSECONDS // TICKS_PER_SECOND)
    stamp = messages.new("builtin_interfaces/msg/Time", sec=nanoseconds // _NANOSECONDS,
                         nanosec=nanoseconds % _NANOSECONDS)
    return messages.new("std_msgs/msg/Header", stamp=stamp, frame_id=frame)


def _set(point: Message, vector: Vector) -> None:
    point.x, point.y, point.z = (float(number) for number in vector)


def trajectory_at(tick: int, command: TrajectoryCommand) -> Message:
    transform = messages.new("geometry_msgs/msg/Transform")
    velocity, acceleration = messages.new("geometry_msgs/msg/Twist"), messages.new("geometry_msgs/msg/Twist")
    yaw = number(command.yaw, "yaw")
    _set(transform.translation, finite(command.p_WB, "p_WB"))
    transform.rotation.z, transform.rotation.w = math.sin(0.5 * yaw), math.cos(0.5 * yaw)
    _set(velocity.linear, finite(command.v_WB, "v_WB"))
    velocity.angular.z = number(command.yaw_rate, "yaw_rate")
    _set(acceleration.linear, finite(command.a_WB, "a_WB"))
    point = messages.new("trajectory_msgs/msg/MultiDOFJointTrajectoryPoint", transforms=[transform],
                         velocities=[velocity], accelerations=[acceleration])
    return messages.new("trajectory_msgs/msg/MultiDOFJointTrajectory", header=header_at(tick), points=[point])


def gimbal_command(command: GimbalCommand) -> Message:
    twist = messages.new("geometry_msgs/msg/Twist")
    pitch, yaw = number(command.pitch, "pitch"), number(command.yaw, "yaw")
    if command.mode == "angle":
        _set(twist.linear, np.array([1.0, pitch, yaw]))
    elif command.mode == "rate":
        twist.linear.x = -1.0
        _set(twist.angular, np.array([0.0, pitch, yaw]))
    elif command.mode != "freeze":
        raise InputError(f"mode: must be 'angle', 'rate' or 'freeze', not {command.mode!r}")
    return twist


def aim_at(p_W: Vector, state: State, vehicle: Vehicle) -> GimbalCommand:
    """Gimbal angles that put p_W into the centre of the image, as far as the gimbal's limits allow."""
    ahead = p_W - state.p_WB - state.R_WB @ vehicle.camera.p_BC
    pitch = math.atan2(-ahead[2], math.hypot(ahead[0], ahead[1]))
    yaw = math.remainder(math.atan2(ahead[1], ahead[0]) - state.yaw, math.tau)
    limits = vehicle.gimbal_pitch_limit, vehicle.gimbal_yaw_limit
    return GimbalCommand("angle", *(max(-limit, min(limit, angle)) for angle, limit in zip((pitch, yaw), limits)))


def config_of(raw: Mapping[str, Any]) -> AgentConfig:
    """The AgentConfig from the module's dictionary. At the ground station `index` is -1, and `vehicle` is None."""
    fleet = tuple(FleetMember(**(one | {"p_WB_start": np.array(one["p_WB_start"])})) for one in raw["fleet"])
    vehicle: Any = None
    if raw["vehicle"] is not None:
        camera = raw["vehicle"]["camera"]
        vehicle = Vehicle(**(raw["vehicle"] | {"camera": Camera(**(camera | {"p_BC": np.array(camera["p_BC"])}))}))
    index = -1 if raw["index"] is None else raw["index"]
    return AgentConfig(**(raw | {"index": index, "fleet": fleet, "vehicle": vehicle,
                                 "station_position": np.array(raw["station_position"])}))
