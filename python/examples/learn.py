"""Learns the parameters of a planner by an evolution strategy: it trains in some scenes, and tests in other ones.

    python3 python/examples/learn.py            # a small one, below a minute
    python3 python/examples/learn.py --full     # 340 flights: six minutes of a core

Each generation draws parameters around the present ones, flies them in all training scenes, and moves towards those
that scored more than others in the same scene. The test scenes do not influence this: there it flies only the first
parameters, and those after each generation. It states their mean score, and its gain, with intervals by bootstrap over
scenes.
"""

from __future__ import annotations

import argparse
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import skein

SCENARIO, PLANNER = "towers", f"py:{Path(__file__).parent / 'facade.py'}"
# Name, first guess, lowest, highest. The search works on the logarithms.
PARAMETERS = (("standoff_m", 12.0, 3.0, 30.0), ("lane_m", 10.0, 1.0, 30.0), ("speed_mps", 1.0, 0.2, 8.0))
Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass
class Size:
    learning: range        #: scene seeds for training
    judging: range         #: scene seeds for tests
    generations: int
    population: int        #: number of parameter sets that a generation tries
    duration_s: float      #: mission time


SMALL = Size(range(1, 3), range(201, 204), 1, 4, 40.0)
FULL = Size(range(1, 11), range(201, 221), 4, 6, 90.0)


def bounded(values: Array) -> dict[str, float]:
    return {name: round(float(np.clip(np.exp(value), low, high)), 4)
            for value, (name, _, low, high) in zip(values, PARAMETERS)}


def spec(values: Array) -> str:
    return PLANNER + ":" + ",".join(f"{name}={value}" for name, value in bounded(values).items())


def scores(tried: list[Array], scenes: range, duration_s: float, jobs: int) -> Array:
    """The scores of parameter sets (rows) in scenes (columns). `jobs` fleets fly in parallel."""
    flights = [(values, scene) for values in tried for scene in scenes]
    found = []
    for first in range(0, len(flights), jobs):
        batch = [skein.Fleet(SCENARIO, planner=spec(values), scene_seed=scene, duration=duration_s, no_check=True)
                 for values, scene in flights[first:first + jobs]]
        for fleet in batch:
            fleet.begin_step(step_s=2.0 * duration_s + 60.0)  # to the mission's end
        for fleet in batch:
            fleet.end_step()
            found.append(fleet.result()["score"])
            fleet.close()
    return np.array(found).reshape(len(tried), len(scenes))


def interval(values: Array, random: np.random.Generator) -> tuple[float, float]:
    """The 95 % interval of the mean, by bootstrap."""
    means = random.choice(values, (10_000, len(values))).mean(axis=1)
    low, high = np.quantile(means, [0.025, 0.975])
    return float(low), float(high)


def learn(size: Size, jobs: int, seed: int) -> dict[str, Any]:
    random = np.random.default_rng(seed)
    mean, spread = np.log([first for _, first, *_ in PARAMETERS]), 0.5
    present, judged = [mean], [scores([mean], size.judging, size.duration_s, jobs)[0]]
    learning = []
    for generation in range(size.generations):
        half = random.normal(size=(size.population // 2, len(mean)))
        drawn = mean + spread * np.concatenate([half, -half])  # in pairs, which reduces noise
        result = scores(list(drawn), size.learning, size.duration_s, jobs)
        # Ranks within each scene, so that a scene with many points has no more influence than others.
        ranks = result.argsort(axis=0).argsort(axis=0).mean(axis=1)
        weights = np.maximum(ranks - np.median(ranks), 0.0)
        if weights.sum() > 0.0:
            mean = weights @ drawn / weights.sum()
        spread *= 0.8
        learning.append(result.mean(axis=1))
        present.append(mean)
        judged.append(scores([mean], size.judging, size.duration_s, jobs)[0])
        print(f"generation {generation + 1}: tried {learning[-1].min():.1f} to {learning[-1].max():.1f}; "
              f"{bounded(mean)}: {judged[-1].mean():.1f} in scenes never seen", flush=True)
    gain = judged[-1] - judged[0]
    return {"seed": seed, "learning": list(size.learning), "judging": list(size.judging),
            "parameters": [bounded(values) for values in present], "tried": [row.tolist() for row in learning],
            "judged": [row.tolist() for row in judged],
            "judged_interval": [interval(row, random) for row in judged],
            "gain": float(gain.mean()), "gain_interval": interval(gain, random),
            "better_in": int((gain > 0.0).sum())}


def plot(told: dict[str, Any], file: str) -> None:
    from skein import plots

    axes = plots.axes(height=2.6)
    generations = np.arange(len(told["judged"]))
    low, high = np.array(told["judged_interval"]).T
    with plots.style():
        for i, tried in enumerate(told["tried"]):
            axes.plot(np.full(len(tried), i + 1), tried, ".", color="0.7", label="tried, scenes of learning"[i * 99:])
        axes.fill_between(generations, low, high, alpha=0.25, linewidth=0.0)
        axes.plot(generations, np.mean(told["judged"], axis=1), marker="o",
                  label=f"learned, {len(told['judging'])} scenes never seen")
        axes.set(xlabel="generation", ylabel="mean score", xticks=generations, ylim=(0.0, None))
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0))
    plots.save(axes, file)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--full", action="store_true", help="scene seeds 1 to 10, judged in 20 others")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="fleets that fly at once")
    parser.add_argument("--json", help="file for all of it")
    parser.add_argument("--plot", help="file for the curve: SVG, PDF or PNG")
    options = parser.parse_args()
    told = learn(FULL if options.full else SMALL, options.jobs, options.seed)
    first, last = np.mean(told["judged"][0]), np.mean(told["judged"][-1])
    low, high = told["gain_interval"]
    print(f"in {len(told['judging'])} scenes that it never saw: {first:.1f} before, {last:.1f} after, "
          f"gain {told['gain']:+.1f} (95 %: {low:+.1f} to {high:+.1f}), more in {told['better_in']}")
    if options.json:
        Path(options.json).write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    if options.plot:
        plot(told, options.plot)


if __name__ == "__main__":
    main()
