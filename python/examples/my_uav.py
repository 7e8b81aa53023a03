"""A program that replaces a UAV's software: flies over the tops of the boxes, photographs them, and comes back.

    skein run towers --planner 'hover,jurong=exec:python3 python/examples/my_uav.py'
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))  # the package of this checkout; not needed if it is installed

from skein.client import Client  # noqa: E402

ABOVE_M = 3.0


def tour(start, boxes):
    """Pairs of a place and a point to look at: above all boxes, around the edges of each, the nearest box first."""
    tops = [box.center[2] + 0.5 * np.abs(box.R_WO[2]) @ box.size for box in boxes]
    height = max(tops) + ABOVE_M
    yield np.array([*start[:2], height]), start
    for box, top in sorted(zip(boxes, tops), key=lambda one: np.linalg.norm(one[0].center - start)):
        for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)):
            edge = box.center + box.R_WO @ (0.5 * box.size * [x, y, 0.0])
            yield np.array([*edge[:2], height]), np.array([*box.center[:2], top])
    yield np.array([*start[:2], height]), start  # the station is in sight there


with Client() as uav:
    left = None
    for step in uav:
        if left is None and step.boxes:
            left = list(tour(step.state.p_WB, step.boxes))
        if not left:
            continue
        place, look_at = left[0]
        uav.look_at(look_at)  # the camera takes its pictures by itself
        uav.activity("photographs", goal_W=place)
        if uav.fly_to(place, speed_mps=3.0) and len(left) > 1:
            left.pop(0)
            print(f"{step.time_s:.2f} s: {len(left)} places left, {step.undelivered} captures to deliver")
        for message in step.radio:
            print(f"{step.time_s:.2f} s: heard {message.text!r} on {message.topic}")  # into this UAV's log
