"""What it costs to step fleets: the figures of docs/performance.md.

    PYTHONPATH=python python3 python/bench/stepping.py [--repeat 3] [--resets 1000] [--seconds 60] [--mbs 300]

Times are told twice: by the clock, and as CPU time of this program and the fleet's process together, which is the
clock's time on a core that nobody else uses. mbs needs SKEIN_ASSETS.
"""

from __future__ import annotations

import argparse
import os
import statistics
import time
from pathlib import Path
from typing import Any

import numpy as np

import skein

UAVS = ["jurong", "raffles", "sentosa", "changi", "nanyang"]


def cpu_s(pid: int) -> float:
    """Of another process, in hundredths of a second."""
    words = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def memory_mb(pid: int | str) -> float:
    return int(Path(f"/proc/{pid}/status").read_text().split("VmRSS:")[1].split()[0]) / 1024


def pid_of(fleet: skein.Fleet) -> int:
    assert fleet._worker is not None
    return fleet._worker.pid


def stepping(seconds: float, safe: bool) -> tuple[float, float]:
    """Simulated time a second, by the clock and by CPU time: five learners, a step of 0.05 s."""
    with skein.Fleet("towers", learners=UAVS, safe=safe) as fleet:
        fleet.reset()
        up: Any = {uav: {"velocity": np.array([0.2, 0.1, 1.0]), "yaw_rate": 0.05, "gimbal_rate": np.zeros(2)}
                   for uav in UAVS}
        on: Any = {uav: {**up[uav], "velocity": np.array([0.3, 0.05 * i, 0.0])} for i, uav in enumerate(UAVS)}
        for _ in range(200):
            fleet.step(up)
        pid, began, used = pid_of(fleet), time.perf_counter(), time.process_time() + cpu_s(pid_of(fleet))
        steps = round(seconds / fleet.step_s)
        for _ in range(steps):
            fleet.step(on)
        return (steps * fleet.step_s / (time.perf_counter() - began),
                steps * fleet.step_s / (time.process_time() + cpu_s(pid) - used))


def resets(count: int) -> tuple[float, float, float, float]:
    """Resets a minute, by the clock and by CPU time; growth of memory [MB], here and in the first process."""
    with skein.Fleet("towers", learners=UAVS, safe=False) as fleet:
        root = fleet._families[None]._root.pid
        for seed in range(20):
            fleet.reset(seed=seed)
        before = memory_mb("self"), memory_mb(root)
        began, used, own = time.perf_counter(), 0.0, time.process_time()
        for seed in range(count):
            fleet.reset(seed=seed)
            used += cpu_s(pid_of(fleet))
        used += time.process_time() - own
        return (60.0 * count / (time.perf_counter() - began), 60.0 * count / used, memory_mb("self") - before[0],
                memory_mb(root) - before[1])


def copying(scenario: str, at_s: float, count: int = 20) -> tuple[float, float]:
    """Median time of a copy [ms], and memory of the process that is copied [MB]."""
    with skein.Fleet(scenario, planner="patrol") as fleet:
        fleet.reset()
        fleet.step(step_s=at_s)
        times = []
        for _ in range(count):
            began = time.perf_counter()
            copy = fleet.fork()
            times.append(1e3 * (time.perf_counter() - began))
            copy.close()
        return statistics.median(times), memory_mb(pid_of(fleet))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--resets", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--mbs", type=float, default=300.0, help="copy a fleet beside MBS at this time [s]")
    options = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    print(f"one core; load {os.getloadavg()[0]:.1f}")
    for safe in (False, True):
        figures = np.array([stepping(options.seconds, safe) for _ in range(options.repeat)])
        clock, cpu = np.median(figures, axis=0)
        print(f"towers, five learners, step 0.05 s, {'safety filter' if safe else 'no scans'}: {clock:.0f} times real "
              f"time by the clock, {cpu:.0f} by CPU time", flush=True)
    clock, cpu, own, root = resets(options.resets)
    print(f"resets a minute: {clock:.0f} by the clock, {cpu:.0f} by CPU time; memory grew by {own:+.1f} MB here, "
          f"{root:+.1f} MB in the first process, over {options.resets}", flush=True)
    for scenario, at_s in (("towers", 60.0), ("mbs", options.mbs)):
        if scenario == "mbs" and not os.environ.get("SKEIN_ASSETS"):
            print("mbs: no SKEIN_ASSETS")
            continue
        milliseconds, memory = copying(scenario, at_s)
        print(f"a copy at {at_s:g} s of {scenario}: {milliseconds:.1f} ms of a process of {memory:.0f} MB", flush=True)


if __name__ == "__main__":
    main()
