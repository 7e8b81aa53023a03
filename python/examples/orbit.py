"""The planner of docs/how-to-add-a-planner.md in Python: flies around every box at several heights, with the camera on
the nearest point of the box. A UAV that has reached a corner says so by radio, and the others leave that corner out.

    ./skein run towers --planner py:python/examples/orbit.py
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from skein.planner import (AgentConfig, FlightConfig, Goal, OrientedBox, Planner, PlannerInput, PlannerOutput,
                           RadioMessage, Vector, Waypoint, parameter)

_TALK = "orbit "  # prefix of a message; the number of a corner follows


def corners_around(box: OrientedBox, standoff_m: float, ring_step_m: float) -> Iterator[tuple[Vector, Vector]]:
    """Pairs of a place and a point to look at from there, ring by ring from the top down."""
    half = 0.5 * box.size
    rings = max(1, int(box.size[2] / ring_step_m))
    for ring in range(rings):
        z = (0.5 - (ring + 0.5) / rings) * box.size[2]
        for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
            edge = np.array([x * half[0], y * half[1], z])
            away = np.array([x * standoff_m, y * standoff_m, 0.0])
            yield box.center + box.R_WO @ (edge + away), box.center + box.R_WO @ edge


class Orbit(Planner):
    @dataclass
    class Config:
        standoff_m: float = parameter(4.0, at_least=3.0, at_most=20.0)  # from a box's sides
        ring_step_m: float = parameter(6.0, at_least=1.0, at_most=50.0)
        flight: FlightConfig = field(default_factory=FlightConfig)      # approach_mps, climb_mps, ...

    config: Config

    def __init__(self, config: Config, agent: AgentConfig) -> None:
        super().__init__(config, agent)
        self.corners: list[tuple[Vector, Vector]] = []
        self.done: set[int] = set()

    def flight(self) -> FlightConfig:
        return self.config.flight

    def plan(self, inputs: PlannerInput) -> PlannerOutput:
        if not self.corners and inputs.boxes:  # all UAVs have the same list
            for box in inputs.boxes:
                self.corners += corners_around(box, self.config.standoff_m, self.config.ring_step_m)
        said = [message.text[len(_TALK):] for message in inputs.radio if message.text.startswith(_TALK)]
        self.done |= {int(number) for number in said if number.isdigit()}
        out = PlannerOutput()
        reached = [outcome.id for outcome in inputs.flight.outcomes if outcome.kind == "reached"]
        self.done |= {outcome.id for outcome in inputs.flight.outcomes}
        out.radio = [RadioMessage("/plan", f"{_TALK}{corner}") for corner in reached]
        if inputs.flight.idle:
            out.goals = self.next_goals()
        if inputs.flight.goal is not None:
            out.gimbal = self.corners[inputs.flight.goal][1]
        return out

    def next_goals(self) -> list[Goal]:
        """The next corner that no UAV has reached; each UAV begins at another place in the list."""
        count = len(self.corners)
        first = self.agent.index * count // len(self.agent.fleet)
        left = [(first + i) % count for i in range(count) if (first + i) % count not in self.done]
        return [Goal(corner, [Waypoint(self.corners[corner][0], 2.0)]) for corner in left[:1]]
