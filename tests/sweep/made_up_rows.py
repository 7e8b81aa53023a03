#!/usr/bin/env python3
"""Writes the files that nodes would leave after a sweep, for made-up flights: FOLDER PLANNERS SCENES SEEDS.

The study is `skein compare --planners hover,patrol,...` over SCENES scenes of `towers` with SEEDS seeds each, in the
form that `--status FOLDER` reads. Scores are drawn at random; other figures are drawn, or those of a typical flight.
"""
import json
import random
import sys
from pathlib import Path

folder, planners, scenes, seeds = Path(sys.argv[1]).resolve(), *map(int, sys.argv[2:5])
names = ["hover", "patrol", "kios", "xxh", "star"][:planners]
count, unit = planners * scenes * seeds, 30
draw = random.Random(1)
sweep = folder / "sweep"
(sweep / "done" / "made-up").mkdir(parents=True, exist_ok=True)
command = ["compare", "--planners", ",".join(names), "--scenarios", "towers", "--scene-seeds", f"0-{scenes - 1}",
           "--seeds",
           f"0-{seeds - 1}", "--executor", "local", "--out", str(folder)]
reference = {"index": 0, "dir": str(sweep / "reference"), "run": {"scenario": "towers"}, "made_under": None}
(sweep / "sweep.json").write_text(json.dumps({
    "format": 2, "token": "made-up", "plan": "", "flights": count, "unit_flights": unit, "reference": reference,
    "digest": "",
    "reference_s": 1.0, "command": command, "working_folder": str(folder)}))


def figures(index):
    score = draw.gauss(100.0, 20.0) + 5.0 * (index % planners)
    uavs = [{"name": name, "role": "explorer" if name in ("jurong", "raffles") else "photographer", "score": score / 5,
             "distance_m": draw.uniform(100, 600), "idle_s": draw.uniform(0, 60), "captures": draw.randrange(200)}
            for name in ("jurong", "raffles", "sentosa", "changi", "nanyang")]
    return {"score": score, "points_detected": 150, "points_total": 400,
            "attainable_percent": score / 4, "attainable": 400.0,
            "mean_quality": score / 150, "greatest_share": 20.0, "collisions": 0, "frozen_uavs": 0, "waiting_uavs": 1,
            "frozen_s": draw.uniform(0, 20), "waited_s": 31.2, "without_work_s": 44.1, "idle_explorers_s": 12.3,
            "idle_photographers_s": draw.uniform(0, 60), "distance_m": 1800.5, "planner_cpu_ms": 3.1,
            "real_time_factor": 42.0, "mission_time_s": 600.0, "status": "completed", "digest": f"{index:064x}",
            "memory_mb": 140.0, "processors": 1.0, "braking_hits": 0, "braking_meets": 0, "ways_meet": 3,
            "least_clearance_m": 1.2, "least_separation_m": 2.3, "uavs": uavs}


def flight(index):
    run = {"scenario": "towers", "planner": names[index % planners], "seed": index}
    return {"index": index, "dir": str(folder / "flights" / str(index)), "run": run, "made_under": None}


(sweep / "units").mkdir(exist_ok=True)
for number in range((count + unit - 1) // unit):
    indices = range(number * unit, min((number + 1) * unit, count))
    planned = {"flights": [flight(index) for index in indices], "again": False}
    (sweep / "units" / f"{number:06}.json").write_text(json.dumps(planned))
    rows = [{"index": index, "node": f"node{number % 50}", "problem": "", "figures": figures(index)}
            for index in indices]
    (sweep / "done" / "made-up" / f"{number:06}.json").write_text(json.dumps({"flights": rows}))
