"""The learning example in a small size: its result is valid, and the same in each run."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

LOWEST = {"standoff_m": 3.0, "lane_m": 1.0, "speed_mps": 0.2}
HIGHEST = {"standoff_m": 30.0, "lane_m": 30.0, "speed_mps": 8.0}


def learned(root: Path, folder: Path, jobs: int) -> tuple[dict[str, Any], str]:
    folder.mkdir()
    command = [sys.executable, "-B", root / "python/examples/learn.py", f"--jobs={jobs}", "--json=told.json",
               "--plot=curve.svg"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(root / "python")})
    assert done.returncode == 0, done.stderr
    told: dict[str, Any] = json.loads((folder / "told.json").read_text())
    assert "<svg" in (folder / "curve.svg").read_text()
    return told, done.stdout


def test_the_result_does_not_depend_on_how_many_fleets_fly_at_once(root: Path, tmp_path: Path) -> None:
    told, said = learned(root, tmp_path / "one", 1)
    again, _ = learned(root, tmp_path / "two", 2)
    assert told == again
    assert not set(told["learning"]) & set(told["judging"]), "the learner is judged in scenes in which it has learned"
    generations = len(told["tried"])
    assert len(told["parameters"]) == len(told["judged"]) == generations + 1 > 1
    for values in told["parameters"]:
        assert all(LOWEST[name] <= value <= HIGHEST[name] for name, value in values.items()), values
    assert told["parameters"][-1] != told["parameters"][0], "the parameters did not change"
    for row in (*told["judged"], *told["tried"]):
        assert all(math.isfinite(score) and score >= 0.0 for score in row)
    assert max(map(max, told["judged"])) > 0.0, "no flight scored"
    gains = [last - first for first, last in zip(told["judged"][0], told["judged"][-1])]
    assert told["gain"] == pytest.approx(sum(gains) / len(gains))
    low, high = told["gain_interval"]
    assert min(gains) - 1e-9 <= low <= told["gain"] <= high <= max(gains) + 1e-9
    assert f"{told['gain']:+.1f}" in said
