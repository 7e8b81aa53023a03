"""Plans a UAV's flight by simulation: before each decision, tries actions in copies of the fleet, and takes the best.

    python3 python/examples/plan_by_fork.py [SCENARIO] [SECONDS]

The copies show the true future, which no UAV could know: the score is a bound for planners that search in models of
their own. The value of an action is the score that the fleet then has earned, minus a penalty for the UAV's distance
from the structure beyond 8 m.
"""

import sys

import numpy as np

import skein

LEARNER, STEP_S, AHEAD_S = "nanyang", 2.0, 4.0
HEADINGS = np.linspace(0.0, 2.0 * np.pi, 6, endpoint=False)
CHOICES = [np.array([2.5 * np.cos(a), 2.5 * np.sin(a), climb]) for a in HEADINGS for climb in (0.0, 1.0)]


def action(velocity: np.ndarray, fleet: skein.Fleet, structure: np.ndarray) -> dict:
    """Flies with this velocity in W, with the camera on the nearest point of the structure."""
    here = fleet.truth.position[fleet.uavs.index(LEARNER)]
    yaw = yaw_of(fleet.truth.attitude[fleet.uavs.index(LEARNER)])
    nearest = structure[np.argmin(((structure - here) ** 2).sum(axis=1))]
    turned = np.array([[np.cos(yaw), np.sin(yaw), 0.0], [-np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
    return {"velocity": turned @ velocity, "look_at": nearest}


def yaw_of(q: np.ndarray) -> float:
    w, x, y, z = q
    return float(np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))


def value(fleet: skein.Fleet, structure: np.ndarray) -> float:
    i = fleet.uavs.index(LEARNER)
    if not fleet.truth.alive[i]:
        return -1e9
    distance = np.sqrt(((structure - fleet.truth.position[i]) ** 2).sum(axis=1).min())
    return fleet.truth.score_earned - 0.01 * max(0.0, float(distance) - 8.0)


def main(scenario: str = "towers", seconds: str = "20") -> None:
    with skein.Fleet(scenario, planner="hover", seed=1, learners=[LEARNER], safe=False) as fleet:
        fleet.reset()
        structure = fleet.truth.points["position"]
        fleet.step({LEARNER: {"velocity": (0.0, 0.0, 2.0)}}, step_s=3.0)
        flown = 0
        while fleet.agents and not fleet.over and fleet.truth.time_s < float(seconds):
            values = []
            for choice in CHOICES:
                with fleet.fork() as future:
                    future.step({LEARNER: action(choice, fleet, structure)}, step_s=AHEAD_S)
                    values.append(value(future, structure))
                    flown += 1
            best = CHOICES[int(np.argmax(values))]
            fleet.step({LEARNER: action(best, fleet, structure)}, step_s=STEP_S)
            print(f"{fleet.truth.time_s:6.2f} s  earned {fleet.truth.score_earned:7.3f}  alive {fleet.agents != []}")
        print(f"{flown} futures of {AHEAD_S:g} s tried; {fleet.result()['uavs'][fleet.uavs.index(LEARNER)]}")


if __name__ == "__main__":
    main(*sys.argv[1:])
