"""The contract that every planner must keep, whatever its strategy, as test cases for pytest:

    from skein.testing import PlannerContract

    class TestMine(PlannerContract):
        planner = "py:my_planner.py"

`pytest` then flies the planner in short one-process missions: alone and with seven others, in another scene, without
radio, restarted in flight, and twice for the same digest. Any `--planner` that flies in one process will do, in C++,
too; for an `exec:` program, set `options = {"one_process": False}`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, ClassVar

from .run import Run
from .run import run as fly


class PlannerContract:
    """Derive a class whose name begins with Test, so that pytest collects it, and set `planner`."""

    planner: ClassVar[str] = ""            #: a value of --planner
    scenario: ClassVar[str] = "towers"
    duration_s: ClassVar[float] = 60.0     #: of each mission
    seed: ClassVar[int] = 3
    least_distance_m: ClassVar[float] = 1.0  #: least distance that each UAV must fly; 0: it may stay where it is
    options: ClassVar[dict[str, Any]] = {}   #: more options of `skein.run`

    def fly(self, folder: Path, **options: Any) -> Run:
        """Flies a mission without recording, oracle and report, which would take time."""
        assert self.planner, f"{type(self).__name__}.planner must say which planner"
        words: dict[str, Any] = {"planner": self.planner, "seed": self.seed, "duration": self.duration_s,
                                 "one_process": True, "record": "none", "no_oracle": True, "no_report": True,
                                 "out": folder}
        return fly(self.scenario, **(words | self.options | options))

    def expect_sound(self, run: Run, flies: bool = True) -> None:
        """Asserts that the run was completed without collisions and without rejected commands."""
        result = run.result
        assert result["status"] == "completed", result["warnings"]
        assert result["deterministic"], result["warnings"]
        assert not result["collisions"]
        for uav in result["uavs"]:
            assert uav["alive"], uav["name"]
            assert uav["commands_rejected"] == 0, f"{uav['name']}: {uav['commands_rejected']} commands were rejected"
            if flies:
                assert uav["distance_m"] >= self.least_distance_m, f"{uav['name']} flew {uav['distance_m']} m"

    def faults(self, folder: Path, *faults: str) -> Path:
        file = folder / "faults.yaml"
        file.write_text("faults:\n" + "".join(f"  - {{{fault}}}\n" for fault in faults))
        return file

    def test_same_input_same_output(self, tmp_path: Path) -> None:
        first = self.fly(tmp_path / "first")
        with _variable("SKEIN_HASH_SEED", "4711"):
            again = self.fly(tmp_path / "again")
        assert first.digest is not None and first.digest == again.digest, "skein check-planner names what differs"

    def test_alone(self, tmp_path: Path) -> None:
        self.expect_sound(self.fly(tmp_path / "run", uavs=1))

    def test_eight(self, tmp_path: Path) -> None:
        self.expect_sound(self.fly(tmp_path / "run", uavs=8))

    def test_another_scene(self, tmp_path: Path) -> None:
        self.expect_sound(self.fly(tmp_path / "run", scene_seed=7))

    def test_no_uav_hears_another(self, tmp_path: Path) -> None:
        deaf = self.faults(tmp_path, "at_s: 0, link: {loss: 1}")
        self.expect_sound(self.fly(tmp_path / "run", faults=deaf))

    def test_started_again_in_flight(self, tmp_path: Path) -> None:
        first = self.fly(tmp_path / "names", duration=1).result["uavs"][0]["name"]
        killed = self.faults(tmp_path, f"at_s: {self.duration_s / 3:g}, for_s: 3, kill: {first}")
        run = self.fly(tmp_path / "run", faults=killed)
        self.expect_sound(run)
        assert not run.result["uavs"][0]["program_lost"], f"{first} did not take part again"


@contextmanager
def _variable(name: str, value: str) -> Iterator[None]:
    before = os.environ.get(name)
    os.environ[name] = value
    try:
        yield
    finally:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before
