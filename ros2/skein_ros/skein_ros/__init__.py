"""Planners for Skein as ROS 2 nodes in Python: derive from Planner, decide in plan(), call run().

    from skein_ros import Planner, run

    class Climb(Planner):
        def plan(self, inputs):
            self.fly_to(inputs.p_WB + [0, 0, 1], inputs.yaw)

    run(Climb)

Frames: W world (ENU), B body (x ahead, y left, z up). Units: SI and radians. Threads: one.
"""
from skein_ros.planner import Inputs, Neighbour, Planner
from skein_ros.running import enter_step, run

__all__ = ["Inputs", "Neighbour", "Planner", "enter_step", "run"]
