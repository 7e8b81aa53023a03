"""The interface of a planner written in Python: `skein run --planner py:my_planner.py[:Class][:key=value,...]`.

A planner is one class, derived from `Planner`, with `plan(inputs) -> PlannerOutput`. It flies inside its UAV's agent
as a planner in C++ does, with the names of `uav_agent/api/planner.hpp`. What it returns may depend only on its inputs
and on its own past; it bounds its effort by counts, never by time (docs/how-to-python.md has more).

Frames: W world (east, north, up; the ground at z = 0), B body (forward, left, up). SI units and radians. Vectors are
arrays of three float64. What `inputs` gives as arrays of its own may be kept. Clouds are views of the agent's memory,
and maps are asked, during the call only: a planner that keeps a view is ended with a message that says which.
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
           "GimbalAim", "GimbalCommand", "GimbalState", "Goal", "GoneError", "Hold", "KeyFrame", "Motion",
           "OccupancyMap", "OrientedBox", "Outcome", "Path", "Peer", "Planner", "PlannerInput", "PlannerOutput",
           "RadioMessage", "Scan", "Setpoint", "Space", "State", "TICKS_PER_SECOND", "TrackingState",
           "TrajectoryCommand", "Vector", "VectorLike", "Vehicle", "Waypoint", "WorldMap", "parameter"]

TICKS_PER_SECOND = 400
_ZERO = (0.0, 0.0, 0.0)


class GoneError(Error):
    """The call is over to which this belonged: `plan()` has returned. Copy what you keep."""


class Space(enum.IntEnum):
    """What a cube of `WorldMap` is."""

    unknown = 0
    free = 1
    occupied = 2


# ---- what a planner asks for by way of motion --------------------------------------------------------------------


@dataclass(slots=True)
class Setpoint:
    """A point to fly to now: it goes to the flight controller as it is, clamped to the vehicle's limits."""

    p_WB: VectorLike
    yaw: float = 0.0
    v_WB: VectorLike = _ZERO
    a_WB: VectorLike = _ZERO


@dataclass(slots=True)
class Waypoint:
    p_WB: VectorLike
    speed_mps: float = 1.0  #: not exceeded on the leg that ends here


@dataclass(slots=True)
class Path:
    """A polyline to follow from the present set-point on; replaces any path before. The UAV stops at its end."""

    waypoints: Sequence[Waypoint]


@dataclass(slots=True)
class Hold:
    """Brake as hard as the limits allow, then stay."""


@dataclass(slots=True)
class TrajectoryCommand:
    """Goes to the flight controller as it is, in this exchange and no other (docs/rules.md, P1 to P3)."""

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
#: A point in W to keep in the image's centre, a command as it is, or None: carry on.
GimbalAim = Union[GimbalCommand, VectorLike, None]


@dataclass(slots=True)
class Goal:
    """Something that a planner wants: to be at a place, or to fly along a line from there."""

    id: int                    #: its planner's name for it
    way: Sequence[Waypoint]    #: at least one
    yaw: float | None = None   #: of the body, from the first waypoint on
    gimbal: GimbalAim = None   #: from when it is taken up


@dataclass(slots=True)
class RadioMessage:
    """A message between planners. Radio tells nobody who sent."""

    topic: str  #: that the scenario lets this UAV send on; "/plan" always
    text: str   #: any bytes but NUL: what is no UTF-8 is escaped as `surrogateescape` does
    source: int | None = None  #: of a received one, if it is known: 0 the station, 1, 2, ... the fleet


@dataclass(slots=True)
class PlannerOutput:
    """What a planner wants in this exchange. Nothing said is "carry on"."""

    motion: Motion = None
    yaw: float | None = None  #: body yaw to turn to; only with a Path or Hold
    gimbal: GimbalAim = None
    trigger: bool = False     #: ask for a capture; only where the camera is in manual mode
    radio: Sequence[RadioMessage] = ()
    goals: Sequence[Goal] | None = None  #: what it likes best first; only with `Planner.flight()`. None: as before
    heard_maps: Sequence[bytes] = ()     #: what others said of their maps (`OccupancyMap.octomap_bytes()`)
    going_to_W: VectorLike | None = None
    no_way: str = ""                     #: why it found no way in this exchange
    waits_for: str | int | None = None   #: a UAV, by its name or its index in the fleet
    debug: Mapping[str, float] = dataclasses.field(default_factory=dict)  #: values of `Planner.debug_names()`


# ---- what a planner is given -------------------------------------------------------------------------------------


@dataclass(slots=True)
class State:
    """Of the own body."""

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
    """How far the tracker has come with the last Path."""

    setpoint: Setpoint  #: where the next path begins
    leg: int            #: index of the waypoint being flown to; their number when done
    done: bool          #: at rest at the end of the path, or no path
    airborne: bool      #: a first motion was commanded


@dataclass(slots=True)
class OrientedBox:
    """Around a structure, loosely."""

    name: str
    center: Vector
    size: Vector  #: full edge lengths along its own axes
    R_WO: npt.NDArray[np.float64]

    def contains(self, p_W: VectorLike, margin: float = 0.0) -> bool:
        return bool(np.all(np.abs(self.R_WO.T @ (np.asarray(p_W) - self.center)) <= 0.5 * self.size + margin))


@dataclass(slots=True)
class Peer:
    """Another UAV, as far as line of sight tells."""

    uav: int  #: index in the fleet
    name: str
    p_W: Vector        #: when last seen; the nominal start before
    v_W: Vector
    a_W: Vector
    seen: int | None   #: tick
    visible: bool      #: in line of sight at this step


@dataclass(slots=True)
class KeyFrame:
    points_W: npt.NDArray[np.float32]  #: (N, 3), a view
    p_WS: Vector | None  #: the sensor's position, if the message tells
    source: int | None   #: 0 the station, 1, 2, ... the fleet


@dataclass(slots=True)
class Scan:
    tick: int
    points_W: npt.NDArray[np.float32]  #: (N, 3), a view


@dataclass(slots=True)
class Firing:
    """Columns of a scan that were fired together."""

    first_column: int
    tick: int
    X_WL: npt.NDArray[np.float64]  #: (4, 4)
    error_m: float
    error_rad: float


@dataclass(slots=True)
class BeamScan:
    tick: int
    doubt: Literal["none", "no_servo", "no_pose", "misfit"]
    beams: npt.NDArray[np.void]  #: (rings, columns), a view: `state` (0 unknown, 1 none, 2 range, 3 uav) and `range_m`
    fired: tuple[Firing, ...]
    points: int


@dataclass(slots=True)
class Outcome:
    id: int
    kind: Literal["reached", "no_way", "blocked"]
    leg: int
    reason: str


@dataclass(slots=True)
class FlightState:
    """What the flight core is about."""

    working: bool       #: in the air, and free to fly to goals
    idle: bool          #: working, and no goal is left
    goal: int | None
    on_way: bool
    leg: int
    outcomes: tuple[Outcome, ...]  #: since the exchange before


class PlannerInput:
    """What one exchange brings. Fields are converted when they are read first, so that what is not asked for costs
    nothing. For tests of one's own: `PlannerInput(k=0, tick=0, state=State(...), ...)`."""

    __slots__ = ("_source", "k", "tick", "state", "gimbal", "tracking", "map", "boxes", "peers", "mission_remaining_s",
                 "station_linked", "undelivered_captures", "detected", "radio", "key_frames", "scans", "beam_scans",
                 "world_map", "scanned", "flight", "space", "position_sigma_m", "yaw_sigma", "battery_charge", "wind_W")

    _source: Any
    k: int     #: exchange
    tick: int  #: simulated time, 400 a second
    state: State
    gimbal: GimbalState
    tracking: TrackingState
    map: OccupancyMap
    boxes: tuple[OrientedBox, ...]  #: empty until received
    peers: tuple[Peer, ...]         #: all other UAVs, in fleet order
    mission_remaining_s: float | None  #: None before the first take-off
    station_linked: bool               #: direct link at this step
    undelivered_captures: int
    detected: npt.NDArray[np.void]  #: in this step's pictures, a view: `p_W`, `n_W` (3 float32), `score`, `order`
    radio: tuple[RadioMessage, ...]
    key_frames: tuple[KeyFrame, ...]
    scans: tuple[Scan, ...]           #: only if `wants_scans()`
    beam_scans: tuple[BeamScan, ...]  #: only if `wants_beams()`
    world_map: WorldMap | None        #: only if `wants_world_map()` or `flight()`
    scanned: bool
    flight: FlightState      #: only if `flight()`
    space: FreeSpace | None  #: where it may choose to fly; only if `flight()`
    position_sigma_m: npt.NDArray[np.float64]  #: deviation of `state`'s position by axis; 0: it is exact
    yaw_sigma: float                           #: of its yaw [rad]
    battery_charge: float | None               #: share that is left; None: this world has no batteries
    wind_W: npt.NDArray[np.float64] | None     #: estimated velocity of the air [m/s]; None: there is no wind

    def __init__(self, **fields: Any) -> None:
        self._source = None
        for name, value in fields.items():
            setattr(self, name, value)

    if not TYPE_CHECKING:  # there, a field that is none is a mistake

        def __getattr__(self, name: str) -> Any:
            """Of a field that was not read before."""
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
    """Base of all planners. A `Config` of its own, a dataclass, has its parameters."""

    @dataclass
    class Config:
        """No parameters."""

    def __init__(self, config: Any, agent: AgentConfig) -> None:
        """Before the first exchange. A planner's own may take less: nothing, or the config alone."""
        self.config = config
        self.agent = agent

    def plan(self, inputs: PlannerInput) -> PlannerOutput | None:
        """Once per exchange of 50 ms, also before take-off. None is "carry on"."""
        raise NotImplementedError

    def flight(self) -> FlightConfig | None:
        """How it flies, if the flight core flies it (`PlannerOutput.goals`); asked once, before the first exchange."""
        return None

    def wants_scans(self) -> bool:
        """Whether it looks at the LiDAR's scans; asked once. They cost most of a run's time."""
        return False

    def wants_beams(self) -> bool:
        """Whether it looks at the beams of the scans, those without a return among them; asked once."""
        return False

    def wants_world_map(self) -> bool:
        """Whether it looks at the map of what beams have proved; asked once."""
        return False

    def debug_names(self) -> Sequence[str]:
        """Names of the values that it publishes as `PlannerOutput.debug`; asked once."""
        return ()
