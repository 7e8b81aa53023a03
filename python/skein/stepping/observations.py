"""Observations of learners, as dictionaries of arrays (uav_agent/planners/learner/observation.hpp)."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import spaces

_FLAGS = {"linked", "airborne", "peers_linked"}
_COUNTS = {"box_count", "undelivered", "detection_count", "scan_points"}
_LEAST: dict[str, float] = {"time_s": 0.0, "time_left_s": 0.0, "peer_ages_s": -1.0, "scan_age_s": -1.0}
_GOALS = 4  # greatest value of `goal`
Field = tuple[str, str, list[int], int]  # name, type, shape, offset of an array in the shared memory block


class Observations:
    """Reads the observations of one learner."""

    def __init__(self, uav: str, fields: list[Field], block: Any) -> None:
        prefix = f"{uav}.sees."
        own = [(name[len(prefix):], (kind, tuple(shape)), offset) for name, kind, shape, offset in fields
               if name.startswith(prefix)]
        names, formats, offsets = (list(part) for part in zip(*own))
        first = offsets[0]
        kind = np.dtype({"names": names, "formats": formats, "offsets": [offset - first for offset in offsets]})
        self._names: list[str] = names
        now: Any = np.ndarray((1,), kind, block, first)
        self._kind = kind
        self._bytes: Any = now.view(np.uint8)
        self.views: dict[str, Any] = {name: now[name][0:1].reshape(now[name].shape[1:]) for name in names}

    def read(self) -> dict[str, Any]:
        """Copies of the arrays, which do not change when the fleet flies on."""
        copy = self._bytes.copy().view(self._kind).reshape(())  # copying bytes is ten times as fast as copying fields
        return dict(zip(self._names, map(copy.__getitem__, self._names)))

    def space(self) -> spaces.Space:
        parts: dict[str, spaces.Space] = {}
        for name, view in self.views.items():
            low, high = -np.inf, np.inf
            if name in _FLAGS:
                low, high = 0, 1
            elif name in _COUNTS:
                low, high = 0, np.iinfo(view.dtype).max
            elif name == "goal":
                low, high = 0, _GOALS
            elif name == "map":
                low, high = -1, 1
            else:
                low = _LEAST.get(name, -np.inf)
            parts[name] = spaces.Box(low, high, view.shape, view.dtype.type)
        return spaces.Dict(parts)
