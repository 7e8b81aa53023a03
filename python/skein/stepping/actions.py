"""Actions of learners: checks them, and writes them to the memory that the fleet's process reads
(uav_agent/planners/learner/orders.hpp)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import InputError
from . import spaces

MOST_WAYPOINTS = 32
_GIMBALS = {"gimbal_rate": (1, 2), "gimbal": (2, 2), "look_at": (3, 3)}  # kind in orders.hpp, how many numbers
_MOTIONS = {"velocity": ("velocity", "yaw_rate"), "goal": ("goal", "speed", "path", "yaw")}
_KNOWN = {actions: dict.fromkeys((*motion, *_GIMBALS, "trigger")) for actions, motion in _MOTIONS.items()}
_MOST_MPS, _MOST_CLIMB_MPS, _MOST_TURN = 5.0, 3.0, 1.0
_FAR_M, _HIGH_M = 300.0, 150.0


def action_space(actions: str) -> spaces.Space:
    """The space of actions, with their usual keys only. docs/python.md lists all keys."""
    motion: dict[str, spaces.Space]
    if actions == "velocity":
        most = np.array([_MOST_MPS, _MOST_MPS, _MOST_CLIMB_MPS])
        motion = {"velocity": spaces.Box(-most, most, dtype=np.float64),
                  "yaw_rate": spaces.Box(-_MOST_TURN, _MOST_TURN, (), np.float64)}
    else:
        motion = {"goal": spaces.Box(np.array([-_FAR_M, -_FAR_M, 2.0]), np.array([_FAR_M, _FAR_M, _HIGH_M]),
                                     dtype=np.float64),
                  "yaw": spaces.Box(-math.pi, math.pi, (), np.float64)}
    return spaces.Dict({**motion, "gimbal_rate": spaces.Box(-_MOST_TURN, _MOST_TURN, (2,), np.float64),
                        "trigger": spaces.Discrete(2)})


def _numbers(uav: str, name: str, value: Any, shape: tuple[int, ...]) -> Any:
    """`value` as a float64 array of the shape `shape`, in which -1 stands for any size. Raises InputError."""
    try:
        array = np.asarray(value, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{uav}: {name} must be numbers, not {value!r}") from None
    if array.shape == shape and len(shape) < 2:  # the usual case, by a fast check
        numbers = array.tolist()
        if math.isfinite(sum(numbers) if shape else numbers):
            return array
    wanted = "(" + ", ".join("n" if size < 0 else str(size) for size in shape) + ("," if len(shape) == 1 else "") + ")"
    if len(array.shape) != len(shape) or any(want not in (-1, size) for want, size in zip(shape, array.shape)):
        raise InputError(f"{uav}: {name} must have the shape {wanted}, not {array.shape}")
    if not np.isfinite(array).all():
        raise InputError(f"{uav}: {name} must be finite, not {value!r}")
    return array


def _is_empty(value: Any) -> bool:
    try:
        return len(value) == 0
    except TypeError:  # a single value
        return False


def check_names(uav: str, action: Any, actions: str) -> Mapping[str, Any]:
    if type(action) is not dict and not isinstance(action, Mapping):  # the first test is faster
        example = {_MOTIONS[actions][0]: (0, 0, 1)}
        raise InputError(f"{uav}: an action is a dictionary, as {example}, not {action!r}")
    known = _KNOWN[actions]
    if not action.keys() <= known.keys():
        unknown = next(name for name in action if name not in known)
        raise InputError(f"{uav}: there is no {unknown!r} in an action of actions={actions!r}; there are "
                         + ", ".join(known))
    if len(action.keys() & _GIMBALS.keys()) > 1:
        raise InputError(f"{uav}: one of {', '.join(_GIMBALS)} in an action, not several")
    if "goal" in action and "path" in action:
        raise InputError(f"{uav}: a goal or a path in an action, not both")
    return action


class Orders:
    """Writes the actions of one learner into the memory shared with the fleet's process."""

    def __init__(self, uav: str, actions: str, views: dict[str, Any]) -> None:
        self._uav, self._actions = uav, actions
        prefix = f"{uav}.does."
        self._views = {name[len(prefix):]: view for name, view in views.items() if name.startswith(prefix)}

    def read(self, action: Any) -> dict[str, Any]:
        """Checks the complete action before anything is written. Returns the values by field. Raises InputError."""
        uav, action = self._uav, check_names(self._uav, action, self._actions)
        values: dict[str, Any] = {}
        if "velocity" in action:
            values["velocity"] = _numbers(uav, "velocity", action["velocity"], (3,))
        if "yaw_rate" in action:
            values["yaw_rate"] = _numbers(uav, "yaw_rate", action["yaw_rate"], ())
        if "goal" in action or "path" in action:
            values.update(self._way(action))
        elif "yaw" in action or "speed" in action:
            raise InputError(f"{uav}: yaw and speed belong to a goal or a path, and there is none in this action")
        for name, (kind, count) in _GIMBALS.items():
            if name in action:
                values["gimbal_kind"] = kind
                values["gimbal"] = wanted = np.zeros(3)
                wanted[:count] = _numbers(uav, name, action[name], (count,))
        values["trigger"] = 0
        if "trigger" not in action:
            return values
        trigger = action["trigger"]
        if not (isinstance(trigger, (bool, np.bool_)) or (getattr(trigger, "ndim", 0) == 0 and trigger in (0, 1))):
            raise InputError(f"{uav}: trigger must be 0 or 1, not {trigger!r}")
        values["trigger"] = int(trigger)
        return values

    def _way(self, action: Mapping[str, Any]) -> dict[str, Any]:
        uav = self._uav
        speed = float(_numbers(uav, "speed", action.get("speed", _MOST_MPS), ()))
        if speed <= 0.0:
            raise InputError(f"{uav}: speed must be above 0, not {speed}")
        if "goal" in action:
            points = _numbers(uav, "goal", action["goal"], (3,))[np.newaxis]
        else:
            path = action["path"]
            points = _numbers(uav, "path", path, (-1, 3)) if not _is_empty(path) else np.zeros((0, 3))
        if len(points) > MOST_WAYPOINTS:
            raise InputError(f"{uav}: a path has {MOST_WAYPOINTS} waypoints at most, not {len(points)}")
        way = np.zeros((MOST_WAYPOINTS, 4))
        way[:len(points), :3] = points
        way[:len(points), 3] = speed
        values = {"waypoints": len(points), "way": way, "turns": int("yaw" in action)}
        if "yaw" in action:
            values["yaw"] = _numbers(uav, "yaw", action["yaw"], ())
        return values

    def write(self, values: dict[str, Any]) -> None:
        for name, value in values.items():
            self._views[name][...] = value
        self._views["serial"] += 1
