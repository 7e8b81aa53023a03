"""The interface of a planner written in Python: `skein run --planner py:my_planner.py[:Class][:key=value,...]`.

A planner is one class, derived from `Planner`, with `plan(inputs) -> PlannerOutput`. It runs inside its UAV's agent, as
a planner in C++ does, and uses the names of `uav_agent/api/planner.hpp`. Its output may depend only on its present and
past inputs. It bounds its effort by counts, never by time (docs/how-to-python.md has more).

Frames: W world (east, north, up; the ground at z = 0), B body (forward, left, up). SI units and radians. Vectors are
arrays of three float64. A planner may keep the vectors in `inputs`. Point clouds are views of the agent's memory; they
and the maps are valid during the call only. If a planner keeps a view, its agent ends with a message that names it.
"""

from __future__ import annotations

import dataclasses
import enum
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np
import numpy.typing as npt

from .errors import Error
from .maps import FreeSpace, OccupancyMap, WorldMap
from .planner_config import (AgentConfig, Camera, FleetMember, FlightConfig, Vector, VectorLike, Vehicle, parameter)

__all__ = ["AgentConfig", "BeamScan", "Camera", "Firing", "FleetMember", "FlightConfig", "FlightState", "FreeSpace",
           "GimbalAim", "GimbalCommand", "GimbalState", "Goal", "GoneError", "Hold", "KeyFrame", "LinkQuality",
           "Motion", "OccupancyMap", "OrientedBox", "Outcome", "Path", "Peer", "Planner", "PlannerInput",
           "PlannerOutput", "RadioMessage", "Scan", "Setpoint", "Space", "Stake", "State", "TICKS_PER_SECOND",
           "TrackingState", "TrajectoryCommand", "Vector", "VectorLike", "Vehicle", "Waypoint", "WorldMap",
           "parameter"]

TICKS_PER_SECOND = 400
_ZERO = (0.0, 0.0, 0.0)


class GoneError(Error):
    """This input belonged to a call of `plan()` that has returned. Copy what you want to keep."""


class Space(enum.IntEnum):
    """State of a cube of the `WorldMap`."""

    unknown = 0
    free = 1
    occupied = 2


# ---- motions that a planner can request --------------------------------------------------------------------------


@dataclass(slots=True)
class Setpoint:
    """A setpoint for the flight controller, sent without smoothing in every exchange until the next motion. Only
    velocity and acceleration are clamped, to the tracker's limits."""

    p_WB: VectorLike
    yaw: float = 0.0
    v_WB: VectorLike = _ZERO
    a_WB: VectorLike = _ZERO


@dataclass(slots=True)
class Waypoint:
    p_WB: VectorLike
    speed_mps: float = 1.0  #: maximum speed on the leg that ends here


@dataclass(slots=True)
class Path:
    """A polyline to follow from the present setpoint on; it replaces any earlier path. The UAV stops at its end."""

    waypoints: Sequence[Waypoint]


@dataclass(slots=True)
class Hold:
    """Brake as hard as the tracker's limits allow, then hover."""


@dataclass(slots=True)
class TrajectoryCommand:
    """A command that goes to the flight controller unchanged, in this exchange only (docs/rules.md, P1 to P3)."""

    p_WB: VectorLike = _ZERO
    v_WB: VectorLike = _ZERO
    a_WB: VectorLike = _ZERO
    yaw: float = 0.0
    yaw_rate: float = 0.0


@dataclass(slots=True)
class GimbalCommand:
    """Angles [rad] or rates [rad/s], by `mode`. Positive yaw turns left, positive pitch looks down."""

    mode: Literal["angle", "rate", "freeze"] = "freeze"
    pitch: float = 0.0
    yaw: float = 0.0


Motion = Union[Setpoint, Path, Hold, TrajectoryCommand, None]
#: Aim of the camera: a point in W to keep in the centre of the image, a gimbal command, or None: the last aim stays.
GimbalAim = Union[GimbalCommand, VectorLike, None]


@dataclass(slots=True)
class Goal:
    """What the planner wants: to be at a place, or to fly along a line of waypoints that begins there."""

    id: int                    #: the planner's own number
    way: Sequence[Waypoint]    #: at least one; the flight core searches a path to the first one
    yaw: float | None = None   #: of the body in W, from 4 m before the first waypoint on; None: any
    gimbal: GimbalAim = None   #: applied when the flight core sets out to the goal


@dataclass(slots=True)
class Stake:
    """The value of the UAV's work: the flight core weighs the loss of captures against the time of a delivery."""

    value: float       #: score that would be lost with the UAV: of captures that the station lacks [points]
    gain_per_s: float  #: score that the planner's present route promises [points/s]


@dataclass(slots=True)
class RadioMessage:
    """A message between planners. The radio does not identify the sender."""

    topic: str  #: one on which the scenario lets this UAV send; "/plan" always is one
    text: str   #: any bytes but NUL; bytes that are not UTF-8 are escaped by `surrogateescape`
    source: int | None = None  #: sender of a received message, if known: 0 the station, 1, 2, ... the fleet


@dataclass(slots=True)
class PlannerOutput:
    """What a planner wants in this exchange. An empty output means "carry on"."""

    motion: Motion = None
    yaw: float | None = None  #: body yaw to turn to; only on a Path or Hold
    gimbal: GimbalAim = None
    trigger: bool = False     #: take a picture now; the first trigger ends the camera's automatic rhythm for good
    radio: Sequence[RadioMessage] = ()
    goals: Sequence[Goal] | None = None  #: best first; only with `Planner.flight()`. None: the last list stays
    stake: Stake | None = None  #: only with `Planner.flight()`. None: the flight core delivers captures by time
    heard_maps: Sequence[bytes] = ()     #: maps received from other UAVs (`OccupancyMap.octomap_bytes()`)
    going_to_W: VectorLike | None = None  #: where it is about to fly: other UAVs send map updates about the way first
    no_way: str = ""                     #: why it found no path in this exchange
    waits_for: str | int | None = None   #: the UAV for which it waits: name, or index in the fleet
    debug: Mapping[str, float] = dataclasses.field(default_factory=dict)  #: by name, of `Planner.debug_names()`


# ---- inputs of a planner -----------------------------------------------------------------------------------------


@dataclass(slots=True)
class State:
    """State of the own body, by its odometry."""

    p_WB: Vector
    q_WB: Vector    #: attitude, body to world: w, x, y, z
    v_WB: Vector    #: in W
    w_WB_B: Vector  #: angular velocity, in B

    @property
    def R_WB(self) -> npt.NDArray[np.float64]:
        w, x, y, z = self.q_WB
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    @property
    def yaw(self) -> float:
        w, x, y, z = self.q_WB
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


@dataclass(slots=True)
class GimbalState:
    pitch: float
    yaw: float
    pitch_rate: float
    yaw_rate: float


@dataclass(slots=True)
class TrackingState:
    """Progress of the tracker along the last Path."""

    setpoint: Setpoint  #: where the next path would begin
    leg: int            #: index of the waypoint that the UAV flies to; the number of waypoints when done
    done: bool          #: at rest at the end of the path, or there is no path
    airborne: bool      #: a first motion was commanded


@dataclass(slots=True)
class OrientedBox:
    """A loose box around a structure."""

    name: str
    center: Vector  #: in W
    size: Vector  #: full edge lengths along its own axes
    R_WO: npt.NDArray[np.float64]  #: (3, 3), from the box's axes to W

    def contains(self, p_W: VectorLike, margin: float = 0.0) -> bool:
        return bool(np.all(np.abs(self.R_WO.T @ (np.asarray(p_W) - self.center)) <= 0.5 * self.size + margin))


@dataclass(slots=True)
class LinkQuality:
    """Quality of an open radio link, in scenarios with path loss."""

    received_dbm: float  #: power that arrives
    rate_bit_s: float    #: for the fleet's messages from this UAV to the other end


@dataclass(slots=True)
class Peer:
    """Another UAV, as this UAV knows it from when it was in line of sight."""

    uav: int  #: index in the fleet
    name: str
    p_W: Vector        #: position when last seen; before that, its nominal start
    v_W: Vector
    a_W: Vector
    seen: int | None   #: tick at which it was last in line of sight; None: never
    visible: bool      #: in line of sight in this exchange
    left_start: bool   #: was seen to leave its start; False if the scenario's odometry is exact
    deviation_m: Vector  #: standard deviation of p_W's error per axis, as far as the conditions tell; 0: exact
    link: LinkQuality | None  #: None: it is not in line of sight, or the scenario has no path loss


@dataclass(slots=True)
class KeyFrame:
    points_W: npt.NDArray[np.float32]  #: (N, 3), a view
    p_WS: Vector | None  #: position of the sensor, if known
    source: int | None   #: node whose LiDAR made it, if known: 1, 2, ... the fleet


@dataclass(slots=True)
class Scan:
    tick: int
    points_W: npt.NDArray[np.float32]  #: (N, 3), a view


@dataclass(slots=True)
class Firing:
    """Columns of a scan that the LiDAR fired at the same tick: from first_column up to that of the next firing."""

    first_column: int
    tick: int
    X_WL: npt.NDArray[np.float64]  #: (4, 4), pose of the LiDAR
    error_m: float    #: bound of the error of X_WL that interpolation adds to that of the odometry
    error_rad: float  #: the same of its rotation


@dataclass(slots=True)
class BeamScan:
    tick: int
    doubt: Literal["none", "no_servo", "no_pose", "misfit"]  #: if not "none", all beams are unknown
    beams: npt.NDArray[np.void]  #: (rings, columns), a view: `state` (0 unknown, 1 none, 2 range, 3 uav) and `range_m`
    fired: tuple[Firing, ...]  #: in order of columns
    points: int  #: number of returns


@dataclass(slots=True)
class Outcome:
    id: int  #: `Goal.id`
    kind: Literal["reached", "no_way", "blocked"]  #: no_way: first waypoint not reached; blocked: stopped beyond it
    leg: int  #: if blocked: index in `Goal.way` of the waypoint that the UAV did not reach
    reason: str  #: for a log


@dataclass(slots=True)
class FlightState:
    """State of the flight core."""

    working: bool       #: it flies to goals now; otherwise (takeoff, recovery, ...) they wait
    idle: bool          #: working, and no goal of the last list is left
    goal: int | None    #: id of the goal being flown; only while working
    on_way: bool        #: the UAV has reached the first waypoint and flies along `Goal.way`
    leg: int            #: while on_way: index of the waypoint that it flies to
    outcomes: tuple[Outcome, ...]  #: of goals that ended since the last exchange with `working`


class PlannerInput:
    """The inputs of one exchange. The agent converts a field when the planner first reads it, so that unused fields
    cost nothing. For your own tests: `PlannerInput(k=0, tick=0, state=State(...), ...)`."""

    __slots__ = ("_source", "k", "tick", "state", "gimbal", "tracking", "map", "boxes", "peers", "mission_remaining_s",
                 "station_linked", "undelivered_captures", "detected", "radio", "key_frames", "scans", "beam_scans",
                 "world_map", "scanned", "flight", "space", "position_sigma_m", "yaw_sigma", "battery_charge", "wind_W",
                 "station_link")

    _source: Any
    k: int     #: number of the exchange
    tick: int  #: simulated time, in ticks of 2.5 ms
    state: State
    gimbal: GimbalState
    tracking: TrackingState
    map: OccupancyMap
    boxes: tuple[OrientedBox, ...]  #: empty until received
    peers: tuple[Peer, ...]         #: all other UAVs, in fleet order
    mission_remaining_s: float | None  #: None before the first takeoff of the fleet
    station_linked: bool               #: direct link to the station in this exchange
    undelivered_captures: int          #: of this UAV, not yet acknowledged by the station
    detected: npt.NDArray[np.void]  #: in this step's pictures, a view: `p_W`, `n_W` (3 float32), `score`, `order`
    radio: tuple[RadioMessage, ...]
    key_frames: tuple[KeyFrame, ...]
    scans: tuple[Scan, ...]           #: only if `wants_scans()`
    beam_scans: tuple[BeamScan, ...]  #: only if `wants_beams()`
    world_map: WorldMap | None        #: only if `wants_world_map()` or `flight()`
    scanned: bool            #: a scan of the own LiDAR arrived
    flight: FlightState      #: only if `flight()`
    space: FreeSpace | None  #: where it may plan paths; only if `flight()`
    position_sigma_m: npt.NDArray[np.float64]  #: standard deviation of the position in `state`, per axis; 0: exact
    yaw_sigma: float                           #: standard deviation of its yaw [rad]
    battery_charge: float | None               #: remaining share; None: the scenario has no batteries
    wind_W: npt.NDArray[np.float64] | None     #: estimated wind velocity [m/s]; None: no wind
    station_link: LinkQuality | None  #: None: no link to the station, or no path loss

    def __init__(self, **fields: Any) -> None:
        self._source = None
        for name, value in fields.items():
            setattr(self, name, value)

    if not TYPE_CHECKING:  # type checkers must reject unknown fields

        def __getattr__(self, name: str) -> Any:
            """Converts a field at its first use."""
            if name not in PlannerInput.__slots__:
                raise AttributeError(f"a planner's inputs have no '{name}'; they have " + ", ".join(self.__slots__[1:]))
            if name == "_source" or self._source is None:
                raise AttributeError(f"these inputs were made without '{name}'")
            value = self._source.read(name)
            setattr(self, name, value)
            return value

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return self.tick / TICKS_PER_SECOND


class Planner:
    """Base of all planners. A derived class may define its own dataclass `Config`, whose fields are its parameters."""

    @dataclass
    class Config:
        """No parameters."""

    def __init__(self, config: Any, agent: AgentConfig) -> None:
        """Called before the first exchange. The constructor of a derived class may also take nothing, or the config
        alone."""
        self.config = config
        self.agent = agent

    def plan(self, inputs: PlannerInput) -> PlannerOutput | None:
        """Called once per exchange of 50 ms, also before takeoff. None means "carry on"."""
        raise NotImplementedError

    def flight(self) -> FlightConfig | None:
        """Parameters of the flight core, if it is to fly this UAV to `PlannerOutput.goals`; None: no flight core.
        Called once, before the first exchange."""
        return None

    def wants_scans(self) -> bool:
        """Whether the planner reads the LiDAR's scans. Called once. Scans take most of a run's time."""
        return False

    def wants_beams(self) -> bool:
        """Whether the planner reads the beams of all scans, including beams without a return. Called once."""
        return False

    def wants_world_map(self) -> bool:
        """Whether the planner reads the world map, which is built from all beams. Called once."""
        return False

    def debug_names(self) -> Sequence[str]:
        """Names of the values that the planner publishes as `PlannerOutput.debug`. Called once."""
        return ()
