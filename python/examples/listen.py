"""Listens to a flying fleet, and prints its points and its score.

    skein run towers --out runs/heard &
    python3 python/examples/listen.py runs/heard
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # the package of this checkout; not needed if it is installed

from skein.client import Listener  # noqa: E402

run = sys.argv[1] if len(sys.argv) > 1 else None
points, score = 0, 0.0
with Listener(["/gcs/score"], run=run, patience_s=30) as station:
    for heard in station:  # until the fleet ends
        qualities = next(one.values for one in heard.message.channels if one.name == "score")
        points, score = len(qualities), float(qualities.sum())
        print(f"{heard.message.header.stamp.sec} s: {points} points, score {score:.1f}", flush=True)
print(f"the fleet has ended with {points} points, score {score:.1f}; {station.missed} messages came too fast")
