"""What a learner knows, as dictionaries of arrays (uav_agent/planners/learner/observation.hpp)."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import spaces

_FLAGS = {"linked", "airborne", "peers_linked"}
_COUNTS = {"box_count", "undelivered", "detection_count", "scan_points"}
_LEAST: dict[str, float] = {"time_s": 0.0, "time_left_s": 0.0, "peer_ages_s": -1.0, "scan_age_s": -1.0}
_GOALS = 4  # the highest of `goal`


class Observations:
    """Reads those of one learner."""

    def __init__(self, uav: str, views: dict[str, Any]) -> None:
        prefix = f"{uav}.sees."
        self.views = {name[len(prefix):]: view for name, view in views.items() if name.startswith(prefix)}
        self._items = tuple(self.views.items())

    def read(self) -> dict[str, Any]:
        """Copies, which stay as they are when the fleet goes on."""
        return {name: view.copy() for name, view in self._items}

    def space(self) -> spaces.Space:
        parts: dict[str, spaces.Space] = {}
        for name, view in self._items:
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
