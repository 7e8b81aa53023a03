"""Programs in Python in a fleet (skein.client): real processes, real DDS, both vendors."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import skein

#: A program that reads all inputs of a step, sends all kinds of messages, and checks that encoding reverses decoding.
CURIOUS = '''
import random
import numpy as np
from skein.client import Client, decode, encode
from skein.client.member import native
from skein.planner import GimbalCommand

draw = random.Random(7)
with Client(scans=True, key_frames=True, read=["/{name}/lidar_servo", "/clock"], debug=["height"]) as uav:
    start, last, checked = None, -1, 0
    for step in uav:
        assert step.k == last + 1 or last == -1, (step.k, last)
        last = step.k
        for topic, payloads in step._arrived.items():
            for payload in payloads:
                kind = uav._type_of("/plan" if topic == "/plan/" + uav.name else topic)
                assert encode(decode(kind, payload)) == payload, topic
                checked += 1
        start = step.state.p_WB if start is None else start
        assert abs(np.linalg.norm(step.state.q_WB) - 1) < 1e-6 and step.gimbal is not None
        assert len(step.messages("/clock")) == 1 and step.rejected == ()
        assert all(frame.source is not None and frame.points_W.shape[1] == 3 for frame in step.key_frames)
        assert all(scan.tick <= step.tick and scan.points_W.dtype == np.float32 for scan in step.scans)
        assert all(one.name != uav.name for one in step.neighbours) and len(step.detected.dtype.names) == 4
        assert step.station_linked == any(one.node == 0 for one in step.neighbours)
        uav.fly_to(start + [0.0, 0.0, 3.0], 1.5)
        uav.gimbal(GimbalCommand("rate", 0.1, draw.uniform(-0.2, 0.2)))
        uav.debug("height", step.state.p_WB[2])
        uav.send(f"at step {{step.k}}")
        uav.activity("looks about", goal_W=start)
    assert step.final and checked > 100 and len(step.boxes) > 0 and step.mission_remaining_s is not None
    print("all well", checked > 0)
'''


def program(tmp_path: Path, code: str, name: str = "jurong") -> str:
    """The planner specification of a program, as --planner accepts it."""
    file = tmp_path / f"{name}_program.py"
    file.write_text(code.replace("{name}", name).replace("{{", "{").replace("}}", "}"))
    return f"{name}=exec:exec {sys.executable} -B {file}"


def fly(tmp_path: Path, planner: str, **options: Any) -> skein.Run:
    words: dict[str, Any] = {"planner": planner, "duration": 12, "seed": 3, "no_oracle": True, "no_report": True,
                             "record": "none", "out": tmp_path / "run", "force": True}
    return skein.run("towers", **(words | options))


def log(run: skein.Run, name: str = "jurong") -> str:
    return (run.path / f"uav_agent-{name}.log").read_text()


@pytest.fixture(autouse=True)
def _package(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    monkeypatch.setenv("PYTHONPATH", str(root / "python"))


def test_a_program_sends_and_receives_the_same_with_both_vendors_and_under_chaos(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    planner = "hover," + program(tmp_path, CURIOUS)
    digests = set()
    for dds, chaos in (("cyclonedds", ""), ("fastdds", ""), ("mixed", "5")):
        if chaos:
            monkeypatch.setenv("SKEIN_CHAOS", chaos)
        run = fly(tmp_path, planner, dds=dds)
        assert run.status == "completed" and run.result["deterministic"] and "all well" in log(run), log(run)
        assert not run.result["lost_members"]
        own = run.trajectories[run.trajectories["uav"] == "jurong"]
        assert 2.5 < own["z"].max() - own["z"].min() < 3.5
        digests.add(run.digest)
    assert len(digests) == 1 and None not in digests


def of_the_page(root: Path, name: str) -> str:
    """The text of a program in docs/how-to-python.md."""
    page = (root / "docs/how-to-python.md").read_text()
    return page.split(f"```python {name}\n")[1].split("```")[0]


def test_the_example_program_scores(root: Path, tmp_path: Path) -> None:
    example = f"hover,jurong=exec:exec {sys.executable} -B {root}/python/examples/my_uav.py"
    run = fly(tmp_path, example, duration=70)
    assert run.score is not None and run.score > 5.0 and run.status == "completed"


def test_a_listener_changes_no_digest(root: Path, tmp_path: Path) -> None:
    shooter = "hover," + program(tmp_path, of_the_page(root, "my_uav.py"))
    heard = subprocess.Popen([sys.executable, "-B", str(root / "python/examples/listen.py"), str(tmp_path / "heard")],
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    runs = [fly(tmp_path, shooter, duration=30, dds=dds, out=tmp_path / out)
            for dds, out in (("fastdds", "heard"), ("cyclonedds", "alone"))]
    said, _ = heard.communicate(timeout=120)
    assert heard.returncode == 0 and "the fleet has ended" in said, said
    assert runs[0].digest == runs[1].digest and runs[0].digest is not None
    assert runs[0].score is not None and runs[0].score > 5.0


@pytest.mark.parametrize("fault", ["kill", "pause"])
def test_a_program_that_a_fault_kills_or_stops_comes_back_and_loses_no_capture(
        root: Path, tmp_path: Path, fault: str) -> None:
    """The UAV has no link until after the fault, so it delivers all its captures afterwards."""
    faults = tmp_path / "faults.yaml"
    faults.write_text("faults:\n  - {at_s: 0, until_s: 26, blackout: jurong}\n"
                      f"  - {{at_s: 22, for_s: 2, {fault}: jurong}}\n")
    shooter = "hover," + program(tmp_path, of_the_page(root, "my_uav.py"))
    runs = [fly(tmp_path, shooter, duration=34, faults=faults, dds=dds) for dds in ("cyclonedds", "fastdds")]
    assert runs[0].digest is not None and runs[0].digest == runs[1].digest
    run = runs[0]
    assert run.status == "completed" and run.result["deterministic"]
    own = run.trajectories[(run.trajectories["uav"] == "jurong") & (run.trajectories["time_s"] > 25)]
    assert (abs(own["vx"]) + abs(own["vy"]) + abs(own["vz"])).max() > 0.5, "the UAV does not fly after the fault"
    before = run.captures[(run.captures["uav"] == "jurong") & (run.captures["time_s"] < 22)]
    assert len(before) > 10 and before["delivered_at_s"].min() > 26, "a capture was lost"


@pytest.mark.parametrize(("line", "words"), [
    ("raise ValueError('no such plan')", ["ValueError: no such plan", "jurong's program failed at step 40 (2.00 s)"]),
    ("uav.fly_to([1, 2])", ["p_W: must be three finite numbers, not [1, 2]", "at step 40"]),
])
def test_an_exception_is_named_with_its_traceback(tmp_path: Path, line: str, words: list[str]) -> None:
    code = ("from skein.client import Client\nwith Client() as uav:\n    for step in uav:\n"
            f"        if step.k == 40:\n            {line}\n")
    with pytest.raises(skein.ProcessError) as caught:
        fly(tmp_path, "hover," + program(tmp_path, code), duration=4)
    assert "uav_agent-jurong failed" in str(caught.value)
    for word in words:
        assert word in str(caught.value)
    run = caught.value.run
    assert run is not None and run.status == "completed", "the other UAVs did not fly on"
    assert [one["member"] for one in run.result["lost_members"]] == ["jurong"]


def test_programs_talk_on_radio_topics_of_their_own_and_with_the_ground(tmp_path: Path) -> None:
    talker = '''
from skein.client import Client, define, new
define("my_msgs/msg/Survey", "float64[3] place\\nstring[] names\\nuint16 count")
with Client() as uav:
    for step in uav:
        if step.k == 3:
            uav.open("/survey", "my_msgs/msg/Survey", ["gcs"])
        if step.k > 3 and uav.is_open("/survey"):
            uav.send(new("my_msgs/msg/Survey", place=[1, 2, step.k], names=["a", "b"], count=step.k), "/survey")
        heard = [one.text for one in step.radio if one.topic == "/plan" and one.text.startswith("thanks")]
        if heard:
            print(heard[0])
'''
    ground = '''
from skein.client import Client, define
define("my_msgs/msg/Survey", "float64[3] place\\nstring[] names\\nuint16 count")
with Client() as gcs:
    assert not gcs.is_uav and gcs.config.vehicle is None
    for step in gcs:
        if step.k == 1:
            gcs.listen("/survey", "my_msgs/msg/Survey")
        for one in step.messages("/survey") if step.k > 1 else []:
            assert list(one.place) == [1, 2, one.count] and one.names == ["a", "b"]
            gcs.send(f"thanks for {one.count}")
'''
    digests = set()
    for dds in ("cyclonedds", "fastdds"):
        planner = f"hover,{program(tmp_path, talker)},{program(tmp_path, ground, 'gcs')}"
        run = fly(tmp_path, planner, duration=4, dds=dds)
        assert "thanks for" in log(run), log(run)
        digests.add((run.digest, log(run).count("thanks for")))
    assert len(digests) == 1


def test_ctrl_c_ends_a_program_that_waits(tmp_path: Path) -> None:
    code = ("import sys\nfrom skein.client import Client\n"
            "uav = Client(name='jurong', scenario='towers', domain=221, dds=sys.argv[1], run=1)\n"
            "try:\n    print('waits', flush=True)\n    next(uav)\n"
            "except KeyboardInterrupt:\n    print('interrupted')\n")
    for dds in ("cyclonedds", "fastdds"):
        child = subprocess.Popen([sys.executable, "-B", "-c", code, dds], stdout=subprocess.PIPE, text=True)
        assert child.stdout is not None and child.stdout.readline() == "waits\n"
        child.send_signal(2)
        said, _ = child.communicate(timeout=60)
        assert said == "interrupted\n" and child.returncode == 0


def test_the_types_of_the_client_module_are_complete(root: Path, tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    mypy = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path)]
    environment = os.environ | {"MYPYPATH": str(root / "python")}
    said = subprocess.run([*mypy, "-p", "skein.client"], capture_output=True, text=True, env=environment)
    assert said.returncode == 0, said.stdout
    wrong = tmp_path / "wrong.py"
    wrong.write_text("from skein.client import Client\nfor step in Client():\n    step.stat\n")
    said = subprocess.run([*mypy, str(wrong)], capture_output=True, text=True, env=environment)
    assert said.returncode != 0 and '"stat"' in said.stdout, said.stdout


def test_a_program_with_the_number_of_another_run_does_not_join(tmp_path: Path) -> None:
    """A program with the number of another run does not become a member, and its log says so."""
    code = ("import os\nos.environ['SKEIN_RUN'] = '12345'\nfrom skein.client import Client\n"
            "with Client() as uav:\n    for step in uav:\n        print('let in')\n")
    with pytest.raises(skein.ProcessError):
        fly(tmp_path, "hover," + program(tmp_path, code), duration=2, agent_timeout=5)
    text = (tmp_path / "run/uav_agent-jurong.log").read_text()
    assert "let in" not in text and "run" in text
    assert json.loads((tmp_path / "run/result.json").read_text())["lost_members"][0]["member"] == "jurong"
