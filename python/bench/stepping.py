"""Measures the cost of stepping fleets: the part of `skein bench --python` that is written in Python.

Prints its progress on stderr. Its output is JSON: for each figure a list with a value for each repeat. It measures wall
time and CPU time. The CPU time of a step is the sum for this program and the fleet's process, which take turns: the
time of a step on an otherwise idle core.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np

import skein

UAVS = ["jurong", "raffles", "sentosa", "changi", "nanyang"]
WARM_UP_STEPS = 200  # the UAVs climb meanwhile
WARM_UP_RESETS = 20

Figures = dict[str, list[float]]


def cpu_s(pid: int) -> float:
    """CPU time of another process so far [s]."""
    return sum(int(file.read_text().split()[0]) for file in Path(f"/proc/{pid}/task").glob("*/schedstat")) * 1e-9


def memory_mb(pid: int | str) -> float:
    return int(Path(f"/proc/{pid}/status").read_text().split("VmRSS:")[1].split()[0]) / 1024.0


def pid_of(fleet: skein.Fleet) -> int:
    assert fleet._worker is not None
    return fleet._worker.pid


def stepping(seconds: float, safe: bool, figures: Figures, name: str) -> None:
    """Simulated time per CPU time and per wall time, with five learners and steps of 0.05 s. Each UAV gets an action in
    each step."""
    with skein.Fleet("towers", learners=UAVS, safe=safe, step_s=0.05) as fleet:
        fleet.reset()
        up: Any = {uav: {"velocity": np.array([0.2, 0.1, 1.0]), "yaw_rate": 0.05, "gimbal_rate": np.zeros(2)}
                   for uav in UAVS}
        on: Any = {uav: {**up[uav], "velocity": np.array([0.3, 0.05 * i, 0.0])} for i, uav in enumerate(UAVS)}
        for _ in range(WARM_UP_STEPS):
            fleet.step(up)
        pid = pid_of(fleet)
        began, own, theirs = time.perf_counter(), time.process_time(), cpu_s(pid)
        steps = round(seconds / fleet.step_s)
        for _ in range(steps):
            fleet.step(on)
        clock, own, theirs = time.perf_counter() - began, time.process_time() - own, cpu_s(pid) - theirs
    figures[name + "_cpu"].append(steps * fleet.step_s / (own + theirs))
    figures[name + "_clock"].append(steps * fleet.step_s / clock)
    figures[name + "_python_us"].append(1e6 * own / steps)
    figures[name + "_fleet_us"].append(1e6 * theirs / steps)


def resets(count: int, figures: Figures) -> None:
    """Resets per minute, and how the memory of this program and of the process that is copied grows over them."""
    with skein.Fleet("towers", learners=UAVS, safe=False) as fleet:
        root = fleet._families[None]._root.pid
        for seed in range(WARM_UP_RESETS):
            fleet.reset(seed=seed)
        memory = memory_mb("self"), memory_mb(root)
        began, used = time.perf_counter(), -time.process_time() - cpu_s(root)
        for seed in range(count):
            fleet.reset(seed=seed)
            used += cpu_s(pid_of(fleet))
        used += time.process_time() + cpu_s(root)
        figures["resets_per_minute_cpu"].append(60.0 * count / used)
        figures["resets_per_minute_clock"].append(60.0 * count / (time.perf_counter() - began))
        figures["growth_here_mb"].append(memory_mb("self") - memory[0])
        figures["growth_root_mb"].append(memory_mb(root) - memory[1])


def copying(scenario: str, at_s: float, count: int, figures: Figures) -> None:
    """Time to copy a fleet that flies `patrol`, until the copy is ready to be stepped. CPU time: of this program, the
    original and the copy."""
    with skein.Fleet(scenario, planner="patrol", assets=os.environ.get("SKEIN_ASSETS")) as fleet:
        fleet.reset()
        fleet.step(step_s=at_s)
        pid = pid_of(fleet)
        for _ in range(count):
            began, used = time.perf_counter(), -time.process_time() - cpu_s(pid)
            copy = fleet.fork()
            clock = time.perf_counter() - began
            used += time.process_time() + cpu_s(pid) + cpu_s(pid_of(copy))
            process = Path(f"/proc/{pid_of(copy)}")
            copy.close()
            while process.exists():  # freeing its memory on the same core takes longer than the copy
                time.sleep(0.001)
            figures[f"copy_{scenario}_clock_ms"].append(1e3 * clock)
            figures[f"copy_{scenario}_cpu_ms"].append(1e3 * used)
        figures[f"copy_{scenario}_mb"].append(memory_mb(pid))


def say(text: str) -> None:
    print(f"bench: {text}", file=sys.stderr, flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=60.0, help="simulated time of a measurement of steps")
    parser.add_argument("--resets", type=int, default=1000)
    parser.add_argument("--copies", type=int, default=20)
    parser.add_argument("--copy-at", type=float, default=300.0, help="simulated time at which fleets are copied [s]")
    parser.add_argument("--copied", default="towers", help="scenarios, with commas; files are those of SKEIN_ASSETS")
    parser.add_argument("--json", help="file for the figures, instead of stdout")
    options = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # all processes share one core
    figures: Figures = defaultdict(list)
    for i in range(options.repeat):
        say(f"steps, {i + 1} of {options.repeat}")
        stepping(options.seconds, False, figures, "stepping")
        stepping(options.seconds, True, figures, "stepping_safe")
    say(f"{options.resets} resets")
    resets(options.resets, figures)
    for scenario in options.copied.split(","):
        say(f"copies of {scenario} at {options.copy_at:g} s")
        copying(scenario, options.copy_at, options.copies, figures)
    text = json.dumps(figures)
    print(text) if options.json is None else Path(options.json).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
