"""Learns parameters of a planner by an evolution strategy: many flights in some scenes, judged in scenes never seen.

    python3 python/examples/learn.py            # a small one: some minutes
    python3 python/examples/learn.py --full     # scene seeds 1 to 10, judged on 20 others: hours

A generation draws parameters around the present ones, flies each in all scenes of learning, and moves towards those
that scored more (paired by scene and seed, ranks instead of scores). In the end the first and the last parameters fly
in the scenes of judging; the mean difference comes with an interval by bootstrap over scenes.
"""

from __future__ import annotations

import argparse
import os

import numpy as np

import skein

SCENARIO, PLANNER = "towers", "patrol"
# Name, first value, lowest, highest: the search goes by their logarithms.
PARAMETERS = (("approach_mps", 5.0, 1.0, 10.0), ("climb_mps", 3.0, 0.5, 6.0), ("deliver_every_s", 240.0, 20.0, 600.0))


def spec(values: np.ndarray) -> str:
    bounded = [min(max(float(np.exp(v)), low), high) for v, (_, _, low, high) in zip(values, PARAMETERS)]
    return PLANNER + ":" + ",".join(f"{name}={value:.4f}" for (name, *_), value in zip(PARAMETERS, bounded))


def scores(flights: list[tuple[np.ndarray, int]], duration_s: float, jobs: int) -> np.ndarray:
    """Of parameters and scene seeds; so many fleets fly at once."""
    found = np.zeros(len(flights))
    for first in range(0, len(flights), jobs):
        batch = [skein.Fleet(SCENARIO, planner=spec(values), scene_seed=scene, duration=duration_s, no_check=True)
                 for values, scene in flights[first:first + jobs]]
        for fleet in batch:
            fleet.begin_step(step_s=2.0 * duration_s + 60.0)  # to the mission's end
        for i, fleet in enumerate(batch):
            fleet.end_step()
            found[first + i] = fleet.result()["score"]
            fleet.close()
    return found


def learn(scenes: range, generations: int, population: int, duration_s: float, jobs: int, seed: int) -> np.ndarray:
    random = np.random.default_rng(seed)
    mean, spread = np.log([first for _, first, *_ in PARAMETERS]), np.full(len(PARAMETERS), 0.4)
    for generation in range(generations):
        half = random.normal(size=(population // 2, len(mean)))
        drawn = mean + spread * np.concatenate([half, -half])  # in pairs, which cancels noise
        flights = [(values, scene) for values in drawn for scene in scenes]
        result = scores(flights, duration_s, jobs).reshape(len(drawn), len(scenes))
        # Ranks in each scene: a scene with many points has no more say than another.
        ranks = result.argsort(axis=0).argsort(axis=0).mean(axis=1)
        weights = np.maximum(ranks - np.median(ranks), 0.0)
        if weights.sum() > 0.0:
            mean = weights @ drawn / weights.sum()
        spread *= 0.85
        print(f"generation {generation + 1}: mean score {result.mean():.2f}, best {result.mean(axis=1).max():.2f}, "
              f"{spec(mean)}", flush=True)
    return mean


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    options = parser.parse_args()
    # Scenes of learning, of judging; generations, flights of a generation and scene; mission time [s].
    learning, judging, generations, population, duration_s = (
        (range(1, 11), range(101, 121), 8, 8, 300.0) if options.full else (range(1, 3), range(101, 104), 1, 4, 40.0))
    learned = learn(learning, generations, population, duration_s, options.jobs, options.seed)
    first = np.log([value for _, value, *_ in PARAMETERS])
    flights = [(values, scene) for values in (first, learned) for scene in judging]
    before, after = scores(flights, duration_s, options.jobs).reshape(2, len(judging))
    difference = after - before
    random = np.random.default_rng(options.seed)
    means = random.choice(difference, (10_000, len(difference))).mean(axis=1)
    low, high = np.quantile(means, [0.025, 0.975])
    print(f"in {len(judging)} scenes that it never saw: {before.mean():.2f} before, {after.mean():.2f} after, "
          f"difference {difference.mean():+.2f} (95 %: {low:+.2f} to {high:+.2f})")


if __name__ == "__main__":
    main()
