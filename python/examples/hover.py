"""The planner `hover` in Python: takes off to a height and hovers there.

    ./skein run towers --planner py:python/examples/hover.py:height_m=4
"""

from __future__ import annotations

from dataclasses import dataclass

from skein.planner import GimbalCommand, Path, Planner, PlannerInput, PlannerOutput, Waypoint, parameter


BEGINS_IN_FLIGHT_M = 2.0  # a UAV that is higher when its planner begins has been restarted in flight


class Hover(Planner):
    @dataclass
    class Config:
        height_m: float = parameter(3.0, at_least=0.2, at_most=200.0)  # above the start
        climb_mps: float = parameter(1.0, at_least=0.1, at_most=5.0)

    config: Config
    started = False

    def plan(self, inputs: PlannerInput) -> PlannerOutput:
        if self.started:
            return PlannerOutput()
        self.started = True
        here = inputs.state.p_WB
        top = here + [0.0, 0.0, self.config.height_m]
        if here[2] > BEGINS_IN_FLIGHT_M:  # it must not climb once more
            top[2] = self.agent.me().p_WB_start[2] + self.config.height_m
        return PlannerOutput(motion=Path([Waypoint(top, self.config.climb_mps)]), gimbal=GimbalCommand("angle"))
