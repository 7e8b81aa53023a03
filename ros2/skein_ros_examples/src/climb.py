#!/usr/bin/env python3
"""A planner in Python: climbs to 6 m, and tells the others how high it is."""
from skein_ros import Planner, run


class Climb(Planner):
    def plan(self, inputs):
        goal = inputs.p_WB + [0, 0, min(1.0, 6.0 - inputs.p_WB[2])]
        self.show_activity("climbs" if inputs.p_WB[2] < 5.5 else "stays")
        self.say(f"at {inputs.p_WB[2]:.1f} m")
        self.fly_to(goal, inputs.yaw)


run(Climb)
