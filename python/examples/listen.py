"""Listens to a fleet that flies, and prints: how high a UAV is, and what counts.

    skein run towers --out runs/heard &
    python3 python/examples/listen.py runs/heard
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # this checkout's package; installed, it is found by itself

from skein.client import Listener  # noqa: E402

run = sys.argv[1] if len(sys.argv) > 1 else None
points, score = 0, 0.0
with Listener(["/gcs/score"], run=run, patience_s=30) as station:
    for heard in station:  # until the fleet ends
        qualities = next(one.values for one in heard.message.channels if one.name == "score")
        points, score = len(qualities), float(qualities.sum())
        print(f"{heard.message.header.stamp.sec} s: {points} points, score {score:.1f}", flush=True)
print(f"the fleet has ended with {points} points, score {score:.1f}; {station.missed} messages came too fast")
