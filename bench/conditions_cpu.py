#!/usr/bin/env python3
"""Measures which share of a run's CPU time the code of conditions takes, part by part. Needs `perf`.

`perf` samples the stacks of flights in one process on one thread. A sample belongs to the part of the innermost
function on its stack that PARTS names. With --compare, the program also flies each seed without conditions, before and
after that flight, and prints the ratio of the CPU times: how much the flights cost in all, with what the conditions
change in the flights themselves. It does not depend on how fast the machine is, but on what else runs on it, so
measure on an idle machine, or over many seeds.

  bench/conditions_cpu.py build/release/bin/skein --conditions breezy,harsh --seeds 1,2,3
"""
import argparse
import collections
import os
import re
import shlex
import statistics
import subprocess
import tempfile
from pathlib import Path

NO_PART = "not of conditions"
PARTS = {
    # Functions that the code of conditions calls, but that flights without conditions call just as well.
    NO_PART: r"Vehicle::(control_attitude|fly\b)|AttitudeControl",
    "pictures from other states (`drift`, `wind`)": r"Surroundings::other_states|Camera::imagine",
    "radio: shadowing": r"ShadowField::|PathLoss::|LinkTracer::update|LinkTracer::quality",
    "wind": r"sim::(Wind|WindProfile|WindPush|LongitudinalGust|TransverseGust)::|body_drag|rotors_pushed_B",
    "odometry, battery, and the rest in `sim_server`":
        r"OdometryError::|GaussMarkov::|sim::Battery::|electric_power|ideal_power|induced_velocity|Surroundings::",
    "reaction of the flight core (`Caution`)": r"agent::Caution::",
    "LiDAR errors": r"LidarErrors::",
    "maps: how far beams without return are clear": r"ClearWays::|WorldMap::clear_way_m",
    "maps: returns by drops (`ClutterFilter`)": r"ClutterFilter::",
}
# `perf` often does not find the callers of functions of libm. Then a sample belongs to the part that calls the function
# most.
LIBM = {
    "radio: shadowing": r"\b__cos_",
    "wind": r"\b__(ieee754_)?(exp|pow|log)_",
    "odometry, battery, and the rest in `sim_server`": r"\bhypot\b|\b__hypot",
}
LIDAR = re.compile("LiDAR|maps")


def fly(args, conditions, seed, out, *wrapper):
    """Flies once. Returns the CPU time of the process and its children in user mode [s]."""
    before = os.times().children_user
    subprocess.run([*wrapper, args.skein, "run", *shlex.split(args.flight), "--planner", args.planner, "--seed",
                    str(seed), "--one-process", "--threads", "1", "--record=none", "--no-oracle", "--conditions",
                    conditions, "--out", str(out), "--force"], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return os.times().children_user - before


def part_of(stack):
    """The part to which a sample belongs. `stack`: names of functions, the innermost first."""
    parts = LIBM if len(stack) == 1 and re.search("|".join(LIBM.values()), stack[0]) else PARTS
    for function in stack:
        for part, pattern in parts.items():
            if re.search(pattern, function):
                return part
    return NO_PART


def sampled(data):
    """Number of samples by part."""
    command = ["perf", "script", "-i", str(data), "--no-inline", "-F", "ip,sym"]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    stacks = collections.Counter(
        tuple(line.strip() for line in sample.strip().splitlines()) for sample in text.split("\n\n") if sample.strip())
    counts = collections.Counter()
    for stack, count in stacks.items():
        counts[part_of(stack)] += count
    return counts


def shares(args, conditions, folder):
    """Shares of the parts [%], one flight after the other."""
    data, flights = folder / "perf.data", []
    for seed in args.seeds:
        fly(args, conditions, seed, folder / "out", "perf", "record", "-q", "-F", "499", "--call-graph", "dwarf,4096",
            "-o", str(data), "--")
        counts = sampled(data)
        total = counts.total()
        flights.append({part: 100.0 * counts[part] / total for part in PARTS if part != NO_PART})
    return flights


def ratio(args, conditions, folder):
    """Median ratio of the CPU time of a flight to the mean of the two flights without conditions around it."""
    ratios = []
    for seed in args.seeds:
        times = [fly(args, one, seed, folder / "out") for one in ("none", conditions, "none")]
        ratios.append(2.0 * times[1] / (times[0] + times[2]))
    return statistics.median(ratios)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("skein", help="the program `skein` of a build")
    parser.add_argument("--flight", default="towers --duration 60", help="arguments of `skein run`")
    parser.add_argument("--planner", default="patrol")
    parser.add_argument("--conditions", default="breezy,harsh", help="values of --conditions, joined by commas")
    parser.add_argument("--seeds", default="1,2,3", help="of the flights; the figures are medians over them")
    parser.add_argument("--compare", action="store_true", help="also compare with flights without conditions")
    args = parser.parse_args()
    args.seeds = [int(seed) for seed in args.seeds.split(",")]
    with tempfile.TemporaryDirectory() as folder:
        for conditions in args.conditions.split(","):
            flights = shares(args, conditions, Path(folder))
            sums = {"all without the LiDAR": lambda part: not LIDAR.search(part), "all": lambda part: True}
            for part in flights[0]:
                print(f"{conditions}: {part}: {statistics.median(f[part] for f in flights):.1f} %")
            for name, counts in sums.items():
                of_flights = [sum(share for part, share in f.items() if counts(part)) for f in flights]
                print(f"{conditions}: {name}: {statistics.median(of_flights):.1f} %")
            if args.compare:
                print(f"{conditions}: CPU time: {ratio(args, conditions, Path(folder)):.2f} times that of `none`")


if __name__ == "__main__":
    main()
