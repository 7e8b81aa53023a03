"""The true state of a stepped fleet and its world. No UAV knows it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .worker import Worker

Array = np.ndarray[Any, np.dtype[Any]]
_PHASES = ("waiting", "flying", "ended")
_POINT = np.dtype([("position", "f8", 3), ("normal", "f8", 3), ("delivered", "f8"), ("earned", "f8"), ("seen", "?")])
_BOX = np.dtype([("name", "U64"), ("center", "f8", 3), ("size", "f8", 3), ("attitude", "f8", 4)])


class Truth:
    """The world at the present step. Frame W, SI units. Arrays have a row for each UAV, in the order of `uavs`."""

    def __init__(self, worker: Worker, uavs: tuple[str, ...]) -> None:
        self._worker = worker
        self.uavs = uavs

    def _number(self, name: str) -> Any:
        return self._worker.views["truth." + name][()]

    def _rows(self, name: str) -> Array:
        rows: Array = self._worker.views["truth." + name].copy()
        return rows

    @property
    def step(self) -> int:
        """Number of exchanges so far."""
        return int(self._number("step"))

    @property
    def time_s(self) -> float:
        return float(self._number("time_s"))

    @property
    def mission(self) -> str:
        """"waiting" for the first take-off, "flying" or "ended"."""
        return _PHASES[int(self._number("mission"))]

    @property
    def score(self) -> float:
        """The score of the delivered captures, as the station counts it."""
        return float(self._number("score"))

    @property
    def score_earned(self) -> float:
        """The score if all captures were delivered."""
        return float(self._number("score_earned"))

    @property
    def points_detected(self) -> int:
        return int(self._number("points_detected"))

    @property
    def position(self) -> Array:
        """(n, 3) [m]"""
        return self._rows("position")

    @property
    def attitude(self) -> Array:
        """(n, 4): w, x, y, z, body to world"""
        return self._rows("attitude")

    @property
    def velocity(self) -> Array:
        """(n, 3) [m/s]"""
        return self._rows("velocity")

    @property
    def angular_velocity(self) -> Array:
        """(n, 3), in the body [rad/s]"""
        return self._rows("angular_velocity")

    @property
    def gimbal(self) -> Array:
        """(n, 4): pitch, yaw [rad] and their rates [rad/s]"""
        return self._rows("gimbal")

    @property
    def alive(self) -> Array:
        """(n,): whether the UAV has neither collided nor left the world"""
        return self._rows("alive").astype(bool)

    @property
    def airborne(self) -> Array:
        return self._rows("airborne").astype(bool)

    @property
    def captures(self) -> Array:
        """(n,): number of exposures that saw at least one interest point"""
        return self._rows("captures")

    @property
    def distance_m(self) -> Array:
        """(n,): length of the flight so far [m]"""
        return self._rows("distance_m")

    @property
    def points(self) -> Array:
        """All interest points: position and normal in W, best delivered and earned quality (0: none), and whether a
        camera ever saw the point."""
        rows = self._worker.ask("scene")["points"]
        table = np.zeros(len(rows), _POINT)
        if rows:
            numbers = np.array(rows, float)
            table["position"], table["normal"] = numbers[:, :3], numbers[:, 3:6]
            table["delivered"], table["earned"], table["seen"] = numbers[:, 6], numbers[:, 7], numbers[:, 8] > 0
        return table

    @property
    def boxes(self) -> Array:
        """The boxes that UAVs receive during the mission: name, centre, size and attitude of each."""
        boxes = self._worker.ask("scene")["boxes"]
        return np.array([(box["name"], box["center"], box["size"], box["attitude"]) for box in boxes], _BOX)
