"""What a planner in Python knows before the flight, and its parameters. `skein.planner` exports all of these names.

Frames: W world (east, north, up), B body (forward, left, up). SI units and radians unless a name says otherwise.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Union

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]  #: three numbers
#: What a planner may pass as a vector.
VectorLike = Union[Vector, Sequence[float]]


@dataclass(slots=True)
class FleetMember:
    name: str
    role: Literal["explorer", "photographer"]
    p_WB_start: Vector  #: nominal start, on the ground
    body_radius_m: float
    max_speed_mps: float


@dataclass(slots=True)
class Camera:
    hfov: float
    vfov: float
    exposure_s: float
    trigger_interval_s: float
    focal_length_m: float
    pixel_size_m: float
    p_BC: Vector  #: position in B, so it moves when the body tilts


@dataclass(slots=True)
class Vehicle:
    """The own vehicle."""

    name: str
    max_speed_mps: float
    max_acceleration_mps2: float
    max_yaw_rate: float  #: [rad/s]
    lidar_range_m: tuple[float, float] | None  #: least and greatest range; None: no LiDAR
    camera: Camera
    gimbal_pitch_limit: float
    gimbal_yaw_limit: float
    gimbal_rate_limit: float


@dataclass(slots=True)
class AgentConfig:
    """The rules of the mission, the own vehicle and the fleet, but not the scene or the interest points."""

    index: int  #: index of the own UAV in `fleet`
    name: str
    fleet: tuple[FleetMember, ...]  #: the same on every UAV
    vehicle: Vehicle
    desired_mm_per_pixel: float
    duration_s: float
    exchange_period_s: float
    station_position: Vector

    def me(self) -> FleetMember:
        return self.fleet[self.index]


def parameter(default: Any = dataclasses.MISSING, *, at_least: float = -math.inf, at_most: float = math.inf) -> Any:
    """A parameter of a `Config` with its bounds: `standoff_m: float = parameter(4.0, at_least=3.0)`. The user must set
    a parameter that has no default."""
    return dataclasses.field(default=default, metadata={"at_least": at_least, "at_most": at_most})


@dataclass(slots=True)
class FlightConfig:
    """Parameters of the flight core; uav_agent/flight_core/flight_config.hpp has their meaning and bounds. If a
    planner's `Config` has a field of this type, its keys are parameters, like the planner's own."""

    error_m: float = 0.33
    light_error_m: float = 0.23
    error_per_mps_s: float = 0.03
    tight_halo_m: float = 0.35
    tight_mps: float = 0.8
    ground_m: float = 1.0
    floor_m: float = 2.0
    peer_margin_m: float = 0.6
    peer_memory_s: float = 20.0
    approach_mps: float = 5.0
    climb_mps: float = 3.0
    ahead_s: float = 1.5
    unknown_cost: float = 1.5
    stall_s: float = 4.0
    look_s: float = 8.0
    refused_s: float = 40.0
    alone_s: float = 45.0
    alone_mps: float = 1.5
    yield_s: float = 5.0
    reacts: bool = True
    drift_sigmas: float = 2.0
    wind_error_s: float = 0.03
    gust_slows_s_m: float = 0.15
    land_mps: float = 1.0
    deliver_every_s: float = 240.0
    return_margin_s: float = 12.0
    hazard_per_h: float = 1.0
