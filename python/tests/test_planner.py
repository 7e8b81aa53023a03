"""Planners in Python: in one process and over DDS, compared with one in C++, killed, flown again, and with mistakes."""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import skein
from skein.testing import PlannerContract

HOVER = "py:python/examples/hover.py"
#: A planner that uses both random generators, the order of a set and a module of its own, and sends numbers by radio.
WANDERER = '''
import random
import numpy as np
import steps
from skein.planner import *

class Wanderer(Planner):
    def debug_names(self):
        return ["drawn"]
    def plan(self, inputs):
        drawn = random.random() + np.random.normal()
        out = PlannerOutput(debug={"drawn": drawn}, radio=[RadioMessage("/plan", f"drew {drawn!r}")])
        if inputs.tracking.done:
            near = inputs.state.p_WB + [*steps.step(), 1.0]
            out.motion = Path([Waypoint(near, 2.0)])
        return out
'''


def fly(tmp_path: Path, planner: str, **options: Any) -> skein.Run:
    words: dict[str, Any] = {"planner": planner, "duration": 12, "seed": 3, "one_process": True, "no_oracle": True,
                             "no_report": True, "out": tmp_path / "run"}
    return skein.run("towers", **(words | options))


@pytest.fixture(autouse=True)
def _in_the_checkout(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)


@pytest.fixture
def wanderer(tmp_path: Path) -> str:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/steps.py").write_text("import random\ncount = 0\ndef step():\n    global count\n    count += 1\n"
                                            "    return random.uniform(-0.3, 0.3), 0.1 * random.gauss(0, 1)\n")
    (tmp_path / "mine/wanderer.py").write_text(WANDERER)
    return f"py:{tmp_path}/mine/wanderer.py"


def test_a_planner_in_python_flies_as_the_same_planner_in_cpp(tmp_path: Path) -> None:
    ours = fly(tmp_path, "hover:height_m=4", out=tmp_path / "cpp")
    for spec in (f"{HOVER}:height_m=4", f"{HOVER}:Hover:height_m=4"):
        assert fly(tmp_path, spec, force=True).digest == ours.digest
    mixed = fly(tmp_path, f"hover:height_m=4,jurong={HOVER}:height_m=4", force=True)
    assert mixed.digest == ours.digest
    assert mixed.result["planner"]["jurong"] == f"py:{Path('python/examples/hover.py').resolve()}:height_m=4"


def test_the_digest_is_the_same_over_dds_killed_and_started_again(tmp_path: Path, wanderer: str) -> None:
    faults = tmp_path / "faults.yaml"
    faults.write_text("faults:\n  - {at_s: 5, for_s: 2, kill: jurong}\n")
    one = fly(tmp_path, wanderer, faults=faults, out=tmp_path / "one")
    many = fly(tmp_path, wanderer, faults=faults, out=tmp_path / "many", one_process=False, record="none")
    assert one.digest is not None and one.digest == many.digest
    after = one.trajectories[(one.trajectories["uav"] == "jurong") & (one.trajectories["time_s"] > 10)]
    assert (abs(after["vx"]) + abs(after["vy"]) + abs(after["vz"])).max() > 0.1, "it stood after its restart"


def test_a_run_keeps_its_planner_and_rerun_flies_it_again(tmp_path: Path, wanderer: str) -> None:
    run = fly(tmp_path, wanderer, duration=8)
    (kept,) = run.result["planner_files"]
    assert (run.path / kept["kept"]).read_text() == WANDERER
    assert (run.path / kept["kept"]).with_name("steps.py").exists()
    rerun = [skein.find_launcher(), "rerun", str(run.path), "--uav", "jurong", "--force"]
    said = subprocess.run(rerun, capture_output=True, text=True)
    assert said.returncode == 0 and "the output is the recorded one" in said.stdout, said.stdout + said.stderr
    (tmp_path / "mine/steps.py").write_text("def step():\n    return 0.0, 0.0\n")
    said = subprocess.run(rerun, capture_output=True, text=True)
    assert said.returncode == 0 and "has changed since that run" in said.stderr, said.stdout + said.stderr


#: A planner that compares the fields of its peers with each other. @IDEAL@: whether the run has no conditions.
OBSERVER = '''
import numpy as np
from skein.planner import *

left = {}

class Observer(Planner):
    def plan(self, inputs):
        for peer in inputs.peers:
            key = self.agent.name, peer.uav
            away = np.linalg.norm(peer.p_W - self.agent.fleet[peer.uav].p_WB_start) > 0.5
            left[key] = left.get(key, False) or bool(peer.visible and (away or np.linalg.norm(peer.v_W) > 0.3))
            assert peer.deviation_m.shape == (3,) and peer.deviation_m.dtype == np.float64
            if @IDEAL@:
                assert not peer.left_start and not peer.deviation_m.any() and peer.link is None
            else:
                assert (peer.link is not None) is peer.visible
                assert peer.link is None or (-82 <= peer.link.received_dbm < 20 and peer.link.rate_bit_s >= 162500)
                assert peer.left_start is left[key] and (peer.deviation_m > 0).all()
        assert (inputs.station_link is not None) is (inputs.station_linked and not @IDEAL@)
        assert inputs.time_s < 10 or any(left.values())
        out = PlannerOutput()
        if inputs.tracking.done:
            out.motion = Path([Waypoint(inputs.state.p_WB + [0, 0, 6.0], 2.0)])
        return out
'''


@pytest.mark.parametrize("conditions", ["none", "harsh"])
def test_peers_have_fields_that_say_how_accurate_they_are(tmp_path: Path, conditions: str) -> None:
    (tmp_path / "observer.py").write_text(OBSERVER.replace("@IDEAL@", str(conditions == "none")))
    run = fly(tmp_path, f"py:{tmp_path}/observer.py", conditions=conditions)
    assert run.digest is not None
    names = run.trajectories.dtype.names
    assert ("charge" in names) is (conditions == "harsh"), "there are charges without batteries, or none with them"
    if conditions == "harsh":
        assert 0 <= run.trajectories["charge"].min() < 1 == run.trajectories["charge"].max()


def test_the_hash_seed_changes_the_flight_of_a_planner_that_depends_on_the_order_of_a_set(tmp_path: Path) -> None:
    """This is how check-planner finds such a planner (tests/hunt/check_planner_test.cpp). With the same seed of hashes,
    the flight is the same."""
    (tmp_path / "sets.py").write_text(
        "from skein.planner import *\n"
        "class Sets(Planner):\n"
        "    def plan(self, inputs):\n"
        "        if inputs.k != 20: return None\n"
        "        first = next(iter({f'text {i}' for i in range(50)}))\n"
        "        return PlannerOutput(Path([Waypoint(inputs.state.p_WB + [0, 0, 2 + 0.1 * int(first[5:])])]))\n")
    spec = f"py:{tmp_path}/sets.py"
    first = fly(tmp_path, spec, duration=4)
    os.environ["SKEIN_HASH_SEED"] = "4711"
    try:
        other = fly(tmp_path, spec, duration=4, out=tmp_path / "other")
    finally:
        del os.environ["SKEIN_HASH_SEED"]
    assert first.digest != other.digest
    assert fly(tmp_path, spec, duration=4, force=True).digest == first.digest


@pytest.mark.parametrize("one_process", [True, False])
def test_an_exception_is_named_with_uav_and_step(tmp_path: Path, one_process: bool) -> None:
    (tmp_path / "bad.py").write_text(
        "from skein.planner import *\n"
        "class Bad(Planner):\n"
        "    def plan(self, inputs):\n"
        "        if inputs.k == 50: raise ValueError('no way out')\n")
    with pytest.raises(skein.ProcessError) as caught:
        fly(tmp_path, f"hover,raffles=py:{tmp_path}/bad.py", one_process=one_process, duration=6)
    text = str(caught.value)
    for part in ("uav_agent-raffles", "Traceback", "bad.py", "ValueError: no way out", "raffles's planner py:",
                 "at step 50 (2.50 s)"):
        assert part in text, text
    assert caught.value.run is not None
    uavs = {uav["name"]: uav for uav in caught.value.run.result["uavs"]}
    assert uavs["jurong"]["distance_m"] > 1, "the other UAVs did not fly on"


WRONG_FILES = {
    "def f(:\n": "SyntaxError",
    "import nothing_of_that_name\n": "ModuleNotFoundError",
    "x = 1\n": "there is no planner in it",
    "from skein.planner import *\nclass A(Planner): pass\nclass B(Planner): pass\n": "which of its planners",
    "from skein.planner import *\nclass A(Planner):\n    def __init__(self): 1 / 0\n": "ZeroDivisionError",
    "from skein.planner import *\nclass A(Planner):\n    def wants_beams(self): return 1\n": "True or False",
}


@pytest.mark.parametrize("code", WRONG_FILES)
def test_a_planner_that_cannot_be_loaded_is_refused_before_the_flight(tmp_path: Path, code: str) -> None:
    (tmp_path / "wrong.py").write_text(code)
    with pytest.raises(skein.InputError, match=WRONG_FILES[code]) as caught:
        fly(tmp_path, f"jurong=py:{tmp_path}/wrong.py")
    assert caught.value.exit_code == 2
    assert not (tmp_path / "run/result.json").exists()


@pytest.mark.parametrize(("spec", "text"), [
    ("py:nobody.py", "there is no file"), ("py:", "a file must follow"), (f"{HOVER}:Hovr", "did you mean 'Hover'"),
    (f"{HOVER}:height=1", "did you mean 'height_m'"), (f"{HOVER}:height_m=x", "must be a number"),
    (f"{HOVER}:height_m=0", "within"), (f"{HOVER},height_m=3", "no UAV is called"),
    (f"hover,gcs={HOVER}", "ground station"),
])
def test_a_wrong_spec_says_what_would_be_right(tmp_path: Path, spec: str, text: str) -> None:
    with pytest.raises(skein.InputError, match=text):
        fly(tmp_path, spec)


def test_pdb_stops_in_plan_while_the_fleet_waits(tmp_path: Path) -> None:
    launcher = [skein.find_launcher(), "run", "towers", "--planner", f"hover,jurong={HOVER}", "--duration", "4",
                "--debug", "jurong=pdb", "--break-at", "2", "--no-oracle", "--no-report", "--out",
                str(tmp_path / "run")]
    commands = "p 'stopped at', inputs.k\np self.agent.name\nc\n"
    said = subprocess.run(launcher, input=commands, capture_output=True, text=True, timeout=300)
    assert said.returncode == 0, said.stdout + said.stderr
    assert "('stopped at', 40)" in said.stdout and "'jurong'" in said.stdout, said.stdout
    result = json.loads((tmp_path / "run/result.json").read_text())
    assert result["digest"] == fly(tmp_path, "hover", duration=4, seed=0, out=tmp_path / "without").digest
    with pytest.raises(skein.InputError, match="only a planner in Python"):
        fly(tmp_path, "hover", one_process=False, debug="jurong=pdb", force=True)


def test_the_interface_is_typed(root: Path, tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    mypy = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path)]
    environment = os.environ | {"MYPYPATH": str(root / "python")}
    good = [str(root / "python/examples" / name) for name in ("hover.py", "orbit.py")]
    said = subprocess.run(mypy + good, capture_output=True, text=True, env=environment)
    assert said.returncode == 0, said.stdout
    wrong = tmp_path / "wrong.py"
    wrong.write_text("from skein.planner import Planner, PlannerInput, PlannerOutput\n"
                     "class Wrong(Planner):\n"
                     "    def plan(self, inputs: PlannerInput) -> PlannerOutput:\n"
                     "        return PlannerOutput(motion=inputs.stat)\n")
    said = subprocess.run([*mypy, str(wrong)], capture_output=True, text=True, env=environment)
    assert said.returncode != 0 and '"stat"' in said.stdout, said.stdout


class TestHover(PlannerContract):
    """A simple planner fulfils the contract. Missions are short, because this tests the contract, not the planner."""

    planner = HOVER
    duration_s = 10.0


def test_the_contract_fails_where_a_planner_does_not_keep_it(tmp_path: Path) -> None:
    (tmp_path / "odd.py").write_text(
        "import os\n"
        "from skein.planner import *\n"
        "class Odd(Planner):\n"
        "    def plan(self, inputs):\n"
        "        return PlannerOutput(TrajectoryCommand(v_WB=(0, 0, 50 if inputs.k > 50 else 1)))\n")

    class OfOdd(PlannerContract):
        planner = f"py:{tmp_path}/odd.py"
        duration_s = 5.0

    with pytest.raises(AssertionError, match="commands were rejected"):
        OfOdd().test_alone(tmp_path)
    with pytest.raises(AssertionError, match="must say which planner"):
        PlannerContract().test_alone(tmp_path)


@pytest.mark.parametrize("lost", [False, True])
def test_the_contract_fails_if_a_restarted_program_did_not_come_back(tmp_path: Path, lost: bool) -> None:
    run = fly(tmp_path, HOVER, duration=3)
    run.result["uavs"][0]["program_lost"] = lost

    class OfLost(PlannerContract):
        def fly(self, folder: Path, **options: Any) -> skein.Run:
            return run

    if lost:
        with pytest.raises(AssertionError, match="did not take part again"):
            OfLost().test_started_again_in_flight(tmp_path)
    else:
        OfLost().test_started_again_in_flight(tmp_path)


def test_drawn_parameters_reach_the_planner(tmp_path: Path) -> None:
    draw = random.Random(5)
    height_m = round(draw.uniform(1.0, 4.0), 2)
    run = fly(tmp_path, f"{HOVER}:height_m={height_m},climb_mps=2", seed=0)
    rows = run.trajectories[run.trajectories["uav"] == "jurong"]
    assert abs(rows["z"].max() - rows["z"].min() - height_m) < 0.3
