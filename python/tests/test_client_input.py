"""Wrong input raises an exception and never crashes the interpreter: random bytes, wrong arguments, misuse."""

from __future__ import annotations

import multiprocessing
import random
import struct
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from skein.client import Client, Listener, Message, decode, define, encode, new
from skein.client.messages import type_named
from skein.client.step import Step

TYPES = ["nav_msgs/msg/Odometry", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/JointState", "std_msgs/msg/String",
         "skein_msgs/msg/CaptureReports", "skein_msgs/msg/Step", "trajectory_msgs/msg/MultiDOFJointTrajectory",
         "visualization_msgs/msg/MarkerArray", "tf2_msgs/msg/TFMessage", "skein_msgs/msg/Activity",
         "octomap_msgs/msg/Octomap", "geometry_msgs/msg/Twist", "sensor_msgs/msg/PointCloud"]
ODD = [None, True, -1, 2**70, 1e300, float("nan"), "text", "a\0b", b"bytes", [], [1, 2], [[1]], {}, (1, "x"), object(),
       np.zeros((2, 2)), np.array(["a"]), range(3), 1j, [float("inf")] * 3, lambda: 0]


def filled(of: type[Message], draw: random.Random, depth: int = 0) -> Message:
    """A message with random values in all fields."""
    message = of()
    for field in of.FIELDS:
        def one() -> Any:
            if field.kind == "string":
                return "".join(draw.choice("aé€ ,") for _ in range(draw.randrange(6)))
            if field.is_number:
                top = {"float32": 1.5, "float64": -2.25, "bool": True}.get(field.kind)
                return top if top is not None else draw.randrange(100)
            return filled(type_named(field.kind), draw, depth + 1)
        count = field.count or draw.randrange(4)
        setattr(message, field.name, one() if field.count is None else [one() for _ in range(count)])
    return message


def test_decoding_reverses_encoding(root: Path) -> None:
    draw = random.Random(1)
    for name in TYPES * 5:
        message = filled(type_named(name), draw)
        payload = encode(message)
        assert decode(name, payload) == message and len(payload) % 4 == 0
        assert encode(decode(name, payload)) == payload


def test_bytes_are_what_dds_carries() -> None:
    text = new("std_msgs/msg/String", data="abc")
    assert encode(text) == b"\0\1\0\0" + struct.pack("<I", 4) + b"abc\0"
    assert decode("std_msgs/msg/String", b"\0\0\0\0" + struct.pack(">I", 4) + b"abc\0") == text
    twist = new("geometry_msgs/msg/Twist")
    twist.angular.z = 2.0
    assert encode(twist) == b"\0\1\0\0" + struct.pack("<6d", 0, 0, 0, 0, 0, 2)
    define("test_msgs/msg/Mixed", "uint8 a\nfloat64 b\nuint16[] c\nfloat64[] d\nbool e")
    mixed = new("test_msgs/msg/Mixed", a=1, b=0.5, c=[7], e=True)
    assert encode(mixed) == (b"\0\1\0\0" + struct.pack("<B7xdIH2xI?", 1, 0.5, 1, 7, 0, True) + b"\0\0\0")
    assert decode("std_msgs/msg/String", b"\0\1\0\0\2\0\0\0\xff\0").data == "\udcff", "a byte that is not UTF-8"


def test_random_bytes_are_refused_or_decoded_without_a_crash() -> None:
    draw = random.Random(2)
    refused = 0
    for i in range(4000):
        name = draw.choice(TYPES)
        payload = bytearray(encode(filled(type_named(name), draw)))
        for _ in range(draw.randrange(1, 6)):
            kind = draw.randrange(3)
            if kind == 0 and payload:
                payload[draw.randrange(len(payload))] = draw.choice([0, 1, 255, draw.randrange(256)])
            elif kind == 1:
                del payload[draw.randrange(len(payload) + 1):]
            else:
                payload += draw.randbytes(draw.randrange(9))
        if i % 5 == 0:
            payload = bytearray(draw.randbytes(draw.randrange(200)))
        try:
            decode(name, bytes(payload))
        except skein.DamagedError:
            refused += 1
    assert 500 < refused < 4000


def test_damaged_texts_count_as_lost_and_others_still_arrive() -> None:
    client = Client.__new__(Client)  # without a fleet
    text = "std_msgs/msg/String"
    client.name, client._latest, client._radio = "jurong", {}, {"/plan": text, "/own": text}
    whole = encode(new(text, data="here"))
    arrived = {"/plan/jurong": [whole, whole[:10], b"", whole], "/own/jurong": [whole[:5]]}
    step = Step(client, 1, 20, False, arrived, True, 0)
    assert [(one.topic, one.text) for one in step.radio] == [("/plan", "here")] * 2
    with pytest.raises(skein.DamagedError):
        step.messages("/plan")


def test_values_that_do_not_fit_are_named() -> None:
    draw = random.Random(3)
    refused = 0
    for _ in range(1500):
        message = filled(type_named(draw.choice(TYPES)), draw)
        part, place = message, message.TYPE
        while True:
            field = draw.choice(part.FIELDS)
            place += f".{field.name}"
            value = getattr(part, field.name)
            if not isinstance(value, Message):
                break
            part = value
        setattr(part, field.name, draw.choice(ODD))
        try:
            encode(message)
        except skein.InputError as error:
            assert str(error).startswith(place), (error, place)
            refused += 1
    assert refused > 700
    loop = new("geometry_msgs/msg/Twist")
    for wrong in (None, "x", 3, object()):
        with pytest.raises(skein.InputError, match="must be a message"):
            encode(wrong)  # type: ignore[arg-type]
    with pytest.raises(AttributeError, match="has no field 'liner'; it has linear, angular"):
        loop.liner = 1
    with pytest.raises(AttributeError, match="has no field 'liner'"):
        loop.liner


@pytest.mark.parametrize(("name", "text", "match"), [
    ("my_msgs/Survey", "float64 x", "write it like"), ("my_msgs/msg/A", "", "no fields"),
    ("my_msgs/msg/B", "float64 x\nfloat64 x", "twice"), ("my_msgs/msg/C", "float64 x = 3", "is not a field"),
    ("std_msgs/msg/String", "float64 x", "with other fields"), ("my_msgs/msg/D", "float64[-1] x", "is not a field"),
    ("my_msgs/msg/E", "float64[0] x", "without elements"), ("my_msgs/msg/F", "F more", "contains itself"),
    ("my_msgs/msg/G", f"H[2] more\n{'=' * 80}\nMSG: my_msgs/H\nG more", "contains itself"),
])
def test_definitions_are_checked(name: str, text: str, match: str) -> None:
    type_named("std_msgs/msg/String")
    with pytest.raises(skein.InputError, match=match):
        define(name, text)


def test_unknown_types_are_named() -> None:
    for wrong in ("std_msgs/msg/Strin", "String", "", "a/b/c/d"):
        with pytest.raises(skein.InputError):
            new(wrong)
    define("my_msgs/msg/Outer", "Inner inside")
    with pytest.raises(skein.InputError, match="my_msgs/msg/Inner"):
        new("my_msgs/msg/Outer")
    define("my_msgs/msg/Loop", "Loop[] more\nuint8 x")
    endless = new("my_msgs/msg/Loop")
    endless.more = [endless]
    with pytest.raises(skein.InputError, match="without an end"):
        encode(endless)
    with pytest.raises(skein.DamagedError, match="without an end"):
        decode("my_msgs/msg/Loop", b"\0\1\0\0" + b"\1\0\0\0" * 200)


GOOD: dict[str, Any] = {"name": "jurong", "scenario": "towers", "domain": 223, "dds": "cyclonedds", "run": 1}


@pytest.mark.parametrize(("wrong", "match"), [
    ({"name": "jurnog"}, "is not a UAV of this fleet"),
    ({"scenario": "towrs"}, "towrs"), ({"domain": 231}, "up to 230"),
    ({"domain": -1}, "whole number"), ({"dds": "opendds"}, "opendds"), ({"run": -1}, "whole number"),
    ({"name": None}, "SKEIN_UAV is not set"), ({"read": ["/jurong/gimball"]}, "not a topic of jurong"),
    ({"read": ["gimbal"]}, "absolute topic name"), ({"read": [3]}, "is a text"), ({"debug": ["a b"]}, "absolute"),
    ({"security": "/no/such/folder"}, "/no/such/folder"),
    ({"debug": [f"n{i}" for i in range(65)]}, "65 debug names; at most 64 are read"),
])
def test_a_client_with_wrong_arguments_is_refused_with_a_reason(wrong: dict[str, Any], match: str) -> None:
    with pytest.raises(skein.InputError, match=match):
        Client(**(GOOD | wrong))


@pytest.mark.parametrize(("arguments", "match"), [
    (((),), "list of names"), (("/clock",), "list of names"), ((["/jurong/gimball"],), "not a topic of jurong"),
    ((["clock"],), "absolute"), (({"/x/gcs": "std_msgs/msg/Strin"},), "not known"),
])
def test_a_listener_with_wrong_arguments_is_refused_with_a_reason(arguments: Any, match: str) -> None:
    with pytest.raises(skein.InputError, match=match):
        Listener(*arguments, domain=223, dds="cyclonedds")
    with pytest.raises(skein.InputError, match="flies"):
        Listener(["/gcs/score"], run="/no/such/run")
    with pytest.raises(skein.InputError, match="run must be a path"):
        Listener(["/gcs/score"], run=5)  # type: ignore[arg-type]


@pytest.mark.parametrize(("options", "match"), [
    ({"domain": 223, "run": "runs/mine"}, "run: cannot stand beside domain"),
    ({"domain": 223, "patience_s": 3}, "patience_s: cannot stand beside domain"),
    *(({"domain": domain, "patience_s": wrong}, "patience_s: must be")
      for domain in (None, 223) for wrong in (-1e-9, -0.05, -3, float("nan"), float("inf"), "3")),
])
def test_options_that_a_listener_would_ignore_are_refused(options: dict[str, Any], match: str) -> None:
    with pytest.raises(skein.InputError, match=match):
        Listener(["/gcs/score"], dds="cyclonedds", **options)


def _in_a_copy(client: Client, answers: Any) -> None:
    try:
        next(client)
    except skein.Error as error:
        answers.put(str(error))
    client.close()


def test_misuse_is_an_exception() -> None:
    client = Client(**GOOD)
    with pytest.raises(skein.Error, match="no step yet"):
        client.fly_to([0, 0, 1])
    with pytest.raises(skein.Error, match="no step yet"):
        client.trigger()
    context = multiprocessing.get_context("fork")
    answers = context.Queue()
    copy = context.Process(target=_in_a_copy, args=(client, answers))
    copy.start()
    assert "forked process" in answers.get(timeout=60)
    copy.join(60)
    assert copy.exitcode == 0
    said: list[str] = []

    def elsewhere() -> None:
        try:
            next(client)
        except skein.Error as error:
            said.append(str(error))

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert said == ["use it only in the thread that joined"]
    client.close()
    client.close()
    with pytest.raises(skein.Error, match="this client is closed"):
        next(client)
    with Listener(["/gcs/score"], domain=223, dds="cyclonedds") as listener:
        assert listener.hear(0.0) is None and listener.missed == 0
        for wrong in (-1.0, float("nan")):
            with pytest.raises(skein.InputError, match="timeout_s"):
                listener.hear(wrong)
    with pytest.raises(skein.Error, match="this listener is closed"):
        listener.hear(0.0)


#: A program that makes wrong calls in flight, which must not change its flight.
NASTY = '''
import random, numpy as np
import skein
from skein.client import Client
from skein.planner import GimbalCommand, TrajectoryCommand
ODD = [None, True, -1, 1e300, float("nan"), "text", b"x", [], [1, 2], [[1]], {}, (1, "x"), object(), 1j,
       np.zeros((2, 2)), [float("inf")] * 3]
draw, refused = random.Random(4), 0
with Client(debug=["x"]) as uav:
    start = None
    for step in uav:
        start = step.state.p_WB if start is None else start
        uav.fly_to(start + [0, 0, 2.0])
        if NASTY:
            for _ in range(20):
                odd, more = draw.choice(ODD), draw.choice(ODD)
                call = draw.choice([
                    lambda: uav.command(odd), lambda: uav.command(TrajectoryCommand(p_WB=odd)),
                    lambda: uav.gimbal(odd), lambda: uav.gimbal(GimbalCommand("angel", 0, 0)),
                    lambda: uav.gimbal(GimbalCommand("angle", odd, "x")), lambda: uav.look_at([odd, 1]),
                    lambda: uav.send(object(), "/plan"), lambda: uav.send("x", "/nowhere"), lambda: uav.debug("y", 1.0),
                    lambda: uav.debug("x", "text"), lambda: uav.activity(3), lambda: uav.open("x", "a"),
                    lambda: uav.open("/a", "std_msgs/msg/String", "all"), lambda: uav.listen("nothing"),
                    lambda: step.messages("/jurong/cloud_inW"), lambda: step.scans,
                    lambda: uav.fly_to(start, speed_mps=-1), lambda: uav.fly_to(start, yaw="north")])
                try:
                    call()
                except skein.Error:
                    refused += 1
            for _ in range(300):
                try:
                    uav.send("much")
                except skein.InputError as error:
                    assert "history is full" in str(error)
                    break
            else:
                raise AssertionError("no end")
        else:
            for _ in range(256):
                uav.send("much")
    print("refused", refused > 500)
'''


def test_invalid_calls_are_refused_in_flight_and_change_nothing(tmp_path: Path, root: Path,
                                                                monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(root / "python"))
    digests = []
    for nasty in (True, False):
        file = tmp_path / "nasty.py"
        file.write_text(f"NASTY = {nasty}\n" + NASTY)
        run = skein.run("towers", planner=f"hover,jurong=exec:exec {sys.executable} -B {file}", duration=3, seed=1,
                        record="none", no_oracle=True, no_report=True, out=tmp_path / f"run{nasty}")
        text = (run.path / "uav_agent-jurong.log").read_text()
        assert f"refused {nasty}" in text, text
        digests.append(run.digest)
    assert digests[0] == digests[1]


def test_without_the_compiled_part_the_message_says_where_to_get_it(root: Path, tmp_path: Path) -> None:
    (tmp_path / "lib/python").mkdir(parents=True)
    import shutil
    shutil.copytree(root / "python/skein", tmp_path / "lib/python/skein", ignore=shutil.ignore_patterns("__pycache__"))
    said = subprocess.run([sys.executable, "-B", "-c", "import skein.client"], capture_output=True, text=True,
                          env={"PYTHONPATH": str(tmp_path / "lib/python"), "PATH": "/usr/bin"})
    assert said.returncode == 1 and "python3-skein has it" in said.stderr, said.stderr
