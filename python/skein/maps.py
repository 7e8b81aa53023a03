"""The maps that a planner in Python may ask, as types: `inputs.map`, `inputs.world_map` and `inputs.space`.

Each of them answers during the call of `plan()` that it was given to. Where a place is wanted, an array of shape (N, 3)
asks for N places at once, and the answer is an array of N. Frame W, metres. What is returned is the planner's own.
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
    """What LiDAR key frames have shown, own ones and those of UAVs in line of sight."""

    @property
    def resolution_m(self) -> float: ...
    @property
    def occupied_cells(self) -> int: ...
    @property
    def revision(self) -> int:
        """Another number whenever something more became occupied."""
    @property
    def key_frames(self) -> int: ...

    def occupied(self, p_W: Places) -> Any:
        """Whether the cell of a place holds a hit."""
    def known_free(self, p_W: Places, rays: int = 3) -> Any:
        """Whether at least so many rays (20 at most) passed the coarse cell of a place, and nothing was hit there."""
    def distance_to_occupied(self, p_W: Places, max_distance: float) -> Any:
        """To the nearest centre of an occupied cell; infinite where there is none within `max_distance`."""
    def segment_clear(self, a_W: Places, b_W: Places, radius: float) -> bool:
        """Whether no centre of an occupied cell lies within `radius` of the segment."""
    def cast(self, from_W: Places, direction: Places, max_distance: float, radius: float) -> float | None:
        """Along a direction to the first occupied cell that comes within `radius` of the ray."""
    def occupied_in(self, box: OrientedBox) -> npt.NDArray[np.float64]:
        """Centres of the occupied cells in a box, (N, 3), in a fixed order."""
    def octomap_bytes(self, rays: int = 3) -> bytes:
        """All of it in OctoMap's binary serialisation, to tell others (`PlannerOutput.heard_maps`)."""


class WorldMap(Protocol):
    """What beams have proved to be free or occupied (docs/decisions/0026-what-is-free-is-proved.md)."""

    @property
    def cell_m(self) -> float: ...

    def at(self, p_W: Places) -> Any:
        """`Space` of the cube about a place: 0 unknown, 1 free, 2 occupied."""
    def structure_distance_m(self, p_W: Places) -> Any:
        """To the nearest occupied cube, 4 m at most; never more than it is."""
    def tube_free(self, a_W: Places, b_W: Places, radius_m: float) -> bool: ...
    def ball_free(self, p_W: Places, radius_m: float, lowest_m: float) -> bool: ...
    def clear_way_m(self, from_W: Places, direction: Places, reach_m: float) -> float: ...
    def window(self, lowest_W: Places, cubes: Sequence[int]) -> npt.NDArray[np.uint8]:
        """`Space` of as many cubes along x, y and z, from the cube about a place on."""
    def regions(self) -> npt.NDArray[np.float64]:
        """Lowest corners (N, 3) of cubes of 16 m of which something is known, in the order in which it became so."""


class FreeSpace(Protocol):
    """Where this UAV may choose to fly, as far as it knows."""

    def free(self, p_W: Places) -> Any: ...
    def segment_free(self, a_W: Places, b_W: Places) -> bool: ...
    def cost(self, p_W: Places) -> Any:
        """What a metre costs there, in metres."""
    def sees(self, a_W: Places, b_W: Places, radius: float) -> bool: ...
