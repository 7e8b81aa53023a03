"""What UAVs did in the seconds that count as frozen (docs/results.md#work), for each planner of some studies.

    python3 python/examples/without_work.py studies/wild

The table has the shares of a planner's frozen seconds, from 0.5 % on; its last row has their number per flight.
"""

import sys
from collections import Counter, defaultdict

import numpy as np
import skein

# Groups of the activities in docs/view.md, by the first words of the activities.
GROUPS = {
    "waits on the ground until an explorer has proved the space above it free": ("waits to be shown",),
    "is on the ground, or takes off": ("on the ground", "takes off"),
    "is stopped, too near to structure": ("stands: too near",),
    "is stopped, because another UAV is in the way": ("stands: another UAV",),
    "is stopped, before space that is not proved free": ("stands: what is ahead",),
    "rests at its goal, or has none": ("rests at its goal", "has no goal"),
    "finds no path to its goals": ("looks for a way",),
    "flies to goals without work": ("flies to a goal", "flies along"),
    "recovers: flies back, looks around, tries from another place, climbs": (
        "looks around", "flies nearer", "tries ", "climbs to see", "flies back", "makes room"),
    "proves the space above another UAV free": ("shows",),
    "delivers, or looks for a link": ("returns", "delivers", "waits for a link", "stays "),
}


def group(mode: str) -> str:
    return next((name for name, starts in GROUPS.items() if mode.startswith(starts)), f"other: {mode}")


def frozen_seconds(run: skein.Run) -> Counter[str]:
    """Frozen seconds by group. An activity lasts until the next one; a second counts for the activity at its end."""
    seconds: Counter[str] = Counter()
    for uav in run.uavs:
        told = run.activity[run.activity["uav"] == uav]
        frozen = run.work[(run.work["uav"] == uav) & (run.work["frozen"] == 1)]
        for row in np.searchsorted(told["time_s"], frozen["time_s"], side="right"):
            seconds[group(str(told[row - 1]["mode"])) if row else "other: nothing told yet"] += 1
    return seconds


by_planner: defaultdict[str, Counter[str]] = defaultdict(Counter)
flights: Counter[str] = Counter()
for path in sys.argv[1:]:
    study = skein.Study(path)
    for number, flight in enumerate(study.flights):
        by_planner[str(flight["planner"])] += frozen_seconds(study.run(number))
        flights[str(flight["planner"])] += 1

print("| |", " | ".join(by_planner), "|")
print("|---|" + "---|" * len(by_planner))
for name in dict.fromkeys([*GROUPS, *(name for seconds in by_planner.values() for name in seconds)]):
    shares = [100.0 * seconds[name] / max(1, seconds.total()) for seconds in by_planner.values()]
    if max(shares) >= 0.5:
        print(f"| {name} |", " | ".join(f"{share:.0f} %" for share in shares), "|")
print("| sum per flight over all UAVs [s] |",
      " | ".join(f"{seconds.total() / flights[planner]:.0f}" for planner, seconds in by_planner.items()), "|")
