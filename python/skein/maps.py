"""Types of the maps that a planner in Python may query: `inputs.map`, `inputs.world_map` and `inputs.space`.

A map is valid only during the call of `plan()` that received it. Instead of one place, a query accepts an array of
shape (N, 3) and returns an array of N answers. Frame W, metres. The planner owns what a query returns.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from .planner import OrientedBox

#: Three numbers, or N times three.
Places = Union[npt.NDArray[np.float64], Sequence[float], Sequence[Sequence[float]]]


class OccupancyMap(Protocol):
    """Occupied and free space according to LiDAR key frames, own ones and those of UAVs in line of sight."""

    @property
    def resolution_m(self) -> float: ...
    @property
    def occupied_cells(self) -> int: ...
    @property
    def revision(self) -> int:
        """A number that changes whenever another cell becomes occupied."""
    @property
    def key_frames(self) -> int: ...

    def occupied(self, p_W: Places) -> Any:
        """Whether the cell that contains the place holds a hit."""
    def known_free(self, p_W: Places, rays: int = 3) -> Any:
        """Whether at least min(rays, 20) rays passed the coarse cell of the place, and its fine cell holds no hit."""
    def distance_to_occupied(self, p_W: Places, max_distance: float) -> Any:
        """Distance to the nearest centre of an occupied cell; infinite if there is none within `max_distance`."""
    def segment_clear(self, a_W: Places, b_W: Places, radius: float) -> bool:
        """Whether no centre of an occupied cell lies within `radius` of the segment."""
    def cast(self, from_W: Places, direction: Places, max_distance: float, radius: float) -> float | None:
        """Along a direction to the first occupied cell that comes within `radius` of the ray."""
    def occupied_in(self, box: OrientedBox) -> npt.NDArray[np.float64]:
        """Centres of the occupied cells in a box, (N, 3), in a fixed order."""
    def octomap_bytes(self, rays: int = 3) -> bytes:
        """The map in OctoMap's binary serialisation, to send it to other UAVs (`PlannerOutput.heard_maps`)."""


class WorldMap(Protocol):
    """Free and occupied space, as LiDAR beams have proved it (docs/decisions/0026-what-is-free-is-proved.md)."""

    @property
    def cell_m(self) -> float: ...

    def at(self, p_W: Places) -> Any:
        """`Space` of the cube that contains the place: 0 unknown, 1 free, 2 occupied."""
    def structure_distance_m(self, p_W: Places) -> Any:
        """Lower bound of the distance to the nearest occupied cube, at most 4 m."""
    def tube_free(self, a_W: Places, b_W: Places, radius_m: float) -> bool: ...
    def ball_free(self, p_W: Places, radius_m: float, lowest_m: float) -> bool: ...
    def clear_way_m(self, from_W: Places, direction: Places, reach_m: float) -> float: ...
    def window(self, lowest_W: Places, cubes: Sequence[int]) -> npt.NDArray[np.uint8]:
        """`Space` of a block with `cubes` cubes along x, y and z; its lowest cube contains `lowest_W`."""
    def regions(self) -> npt.NDArray[np.float64]:
        """Lowest corners (N, 3) of all 16 m cubes in which the map knows anything, in order of their first change."""


class FreeSpace(Protocol):
    """Space in which this UAV may plan paths, as far as it knows."""

    def free(self, p_W: Places) -> Any: ...
    def segment_free(self, a_W: Places, b_W: Places) -> bool: ...
    def cost(self, p_W: Places) -> Any:
        """Cost of one metre of path at the place, in metres."""
    def sees(self, a_W: Places, b_W: Places, radius: float) -> bool: ...
