"""A planner that flies along a face of a box in lanes, one above the other, with the camera on the face. It uses no map
and avoids no obstacles. python/examples/learn.py finds out by flying how near to the face it should fly.

    ./skein run towers --planner py:python/examples/facade.py:standoff_m=6,speed_mps=2
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from skein.planner import (AgentConfig, OrientedBox, Path, Planner, PlannerInput, PlannerOutput, Vector, Waypoint,
                           parameter)

LOWEST_M = 3.0  # no lane is lower
RISE_MPS = 6.0  # speed on the way to the first lane


class Face(NamedTuple):
    center: Vector
    normal: Vector  #: outward and level
    width: float
    height: float


def upright_faces(box: OrientedBox) -> list[Face]:
    found = []
    upright = int(np.argmax(np.abs(box.R_WO[2])))
    for axis in {0, 1, 2} - {upright}:
        width = box.size[3 - axis - upright]
        for sign in (1.0, -1.0):
            normal = sign * box.R_WO[:, axis] * [1.0, 1.0, 0.0]
            normal /= np.linalg.norm(normal)
            found.append(Face(box.center + 0.5 * box.size[axis] * normal, normal, width, box.size[upright]))
    return found


def is_over(box: OrientedBox, place: Vector) -> bool:
    """Whether the place is in the box, or above or below it."""
    offset = (place - box.center) * [1.0, 1.0, 0.0]
    return bool(np.all(np.abs(offset @ box.R_WO) < 0.5 * box.size + 1.0))


class Facade(Planner):
    @dataclass
    class Config:
        standoff_m: float = parameter(12.0, at_least=3.0, at_most=30.0)  # from the face
        lane_m: float = parameter(10.0, at_least=1.0, at_most=30.0)      # between two lanes
        speed_mps: float = parameter(1.0, at_least=0.2, at_most=8.0)     # along a lane

    config: Config

    def __init__(self, config: Config, agent: AgentConfig) -> None:
        super().__init__(config, agent)
        self.face: Face | None = None
        self.share = 0, 1  # index of this UAV's part of the face's width, number of parts

    def plan(self, inputs: PlannerInput) -> PlannerOutput:
        here = inputs.state.p_WB
        if self.face is not None:
            normal = self.face.normal
            return PlannerOutput(gimbal=here - normal * ((here - self.face.center) @ normal))
        if not inputs.boxes:
            return PlannerOutput()
        self.face = self.my_face(inputs.boxes, here)
        normal = self.face.normal
        return PlannerOutput(motion=Path(self.lanes(inputs.boxes, here)), yaw=float(np.arctan2(-normal[1], -normal[0])))

    def my_face(self, boxes: tuple[OrientedBox, ...], here: Vector) -> Face:
        """The nearest face of this UAV's tower; the UAVs take the towers in turn. A tower is a box that is higher than
        wide; if there is none, all boxes are towers. Faces whose lanes would be above or below another box are left
        out, unless no other is left."""
        towers = [box for box in boxes if box.size[2] > max(box.size[:2])] or list(boxes)
        mine = self.agent.index % len(towers)
        self.share = self.agent.index // len(towers), len(self.agent.fleet[mine::len(towers)])
        near = sorted(upright_faces(towers[mine]), key=lambda face: float(np.linalg.norm((face.center - here)[:2])))
        free = [face for face in near if not any(
            is_over(box, face.center + self.config.standoff_m * face.normal) for box in boxes)]
        return (free or near)[0]

    def lanes(self, boxes: tuple[OrientedBox, ...], here: Vector) -> list[Waypoint]:
        """The path: up, over all boxes, and down along the face in lanes. UAVs that share a face fly side by side."""
        assert self.face is not None
        center, normal, width, height = self.face
        config, (part, parts) = self.config, self.share
        along = np.array([-normal[1], normal[0], 0.0])
        left, right = (width * ((part + share) / parts - 0.5) for share in (0.15, 0.85))
        top, low = center[2] + 0.5 * height, max(LOWEST_M, center[2] - 0.5 * height)
        above = max(box.center[2] + 0.5 * float(np.abs(box.R_WO[2]) @ box.size) for box in boxes)
        above += 5.0 + 3.0 * self.agent.index  # each UAV has a height of its own
        away = center + config.standoff_m * normal

        def place(sideways: float, z: float) -> Vector:
            return np.array([*(away + sideways * along)[:2], z])

        way = [Waypoint(np.array([*here[:2], above]), RISE_MPS), Waypoint(place(left, above), RISE_MPS)]
        for lane, z in enumerate(np.arange(top - 0.5 * config.lane_m, low, -config.lane_m)):
            for end in (left, right) if lane % 2 == 0 else (right, left):
                way.append(Waypoint(place(end, z), config.speed_mps))
        return way
