"""Arguments of a wrong type or value raise an exception of this package, whichever function gets them. The launcher is
a script that refuses everything, so nothing flies."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from skein import plots
from skein.client import Client, Listener, decode, define, encode, flying_fleet, new
from skein.client._native import native
from skein.client.step import Step

ODD: dict[str, Any] = {
    "none": None, "true": True, "minus": -1, "large": 2**70, "fraction": 1.5, "huge": 1e300, "nan": float("nan"),
    "infinite": float("inf"), "text": "text", "nul": "a\0b", "bytes": b"bytes", "list": [1], "texts": ["x"],
    "mixed": [None, "x"], "nested": [[1]], "empty": [], "dictionary": {"a": 1}, "tuple": (1, "x"), "object": object(),
    "matrix": np.zeros((2, 2)), "array": np.array(["a"]), "range": range(3), "complex": 1j, "function": len,
    "type": int,
}

FLEET = ["scenario", "planner", "seed", "learners", "step_s", "actions", "safe", "scans", "map_window", "map_cell_m",
         "detections", "reward", "render_mode", "launcher", "scene_seed", "uavs", "duration", "faults", "agent_timeout"]
# Waits: a fleet may start later.
VALID = {(case, odd) for case in ("Listener(patience_s)", "flying_fleet(patience_s)")
         for odd in ("large", "huge", "fraction")}
CLIENT = ["scans", "key_frames", "read", "debug", "name", "domain", "dds", "run", "scenario", "security"]
LISTENER = ["topics", "node", "run", "domain", "dds", "security", "patience_s", "most"]
FLOWN = ["launcher", "verbose", "seed", "duration", "out", "log", "one_process"]


def with_launcher(call: Callable[..., Any], name: str, value: Any, launcher: Path, *fixed: Any) -> Any:
    return call(*fixed, **{"launcher": launcher, name: value})


def cases() -> dict[str, Callable[[Any, Path], Any]]:
    """Calls that get the odd value and the launcher's path, by their names."""
    calls: dict[str, Callable[[Any, Path], Any]] = {"find_launcher": lambda value, _: skein.find_launcher(value)}
    for name in FLEET:
        calls[f"Fleet({name})"] = lambda value, launcher, name=name: with_launcher(skein.Fleet, name, value, launcher)
    for name in FLOWN:
        calls[f"run({name})"] = lambda value, launcher, name=name: with_launcher(skein.run, name, value, launcher)
        for call in (skein.compare, skein.contest):
            calls[f"{call.__name__}({name})"] = lambda value, launcher, name=name, call=call: with_launcher(
                call, name, value, launcher, ["kios"])
    for call in (skein.compare, skein.contest):
        calls[f"{call.__name__}(planners)"] = lambda value, launcher, call=call: call(value, launcher=launcher)
    for name in CLIENT:
        known = {"name": "jurong", "scenario": "towers", "domain": 1, "dds": "cyclonedds"}
        calls[f"Client({name})"] = lambda value, _, name=name, known=known: Client(**(known | {name: value}))
    for name in LISTENER:
        beside: dict[str, Any] = {} if name in ("run", "patience_s") else {"domain": 1}
        calls[f"Listener({name})"] = lambda value, _, name=name, beside=beside: Listener(
            **({"topics": ["/jurong/gimbal"]} | beside | {name: value})).close()
    calls |= {
        "run(scenario)": lambda value, launcher: skein.run(value, launcher=launcher),
        "Run(path)": lambda value, _: skein.Run(value),
        "Study(path)": lambda value, _: skein.Study(value),
        "FleetVector(fleets)": lambda value, _: skein.FleetVector(value),
        "FleetVector.reset(seed)": lambda value, _: one_fleet().reset(value),
        "FleetVector.step(actions)": lambda value, _: one_fleet().step(value),
        "Run.table": lambda value, _: skein.Run(Path(__file__).parent).table(value),
        "Study.table": lambda value, _: skein.Study(Path(__file__).parent).table(value),
        "Study.run": lambda value, _: skein.Study(Path(__file__).parent).run(value),
        "Listener.hear": lambda value, _: heard_once().hear(value),
        "GymEnv(fleet)": lambda value, _: skein.GymEnv(value),
        "gym_env(uav)": lambda value, launcher: skein.gym_env(value, launcher=launcher),
        "gym_env(scenario)": lambda value, launcher: skein.gym_env("jurong", value, launcher=launcher),
        "vector_env(n)": lambda value, launcher: skein.vector_env(value, launcher=launcher),
        "vector_env(seed)": lambda value, launcher: skein.vector_env(1, seed=value, launcher=launcher),
        "vector_env(scenario)": lambda value, launcher: skein.vector_env(1, value, launcher=launcher),
        "flying_fleet(run)": lambda value, _: flying_fleet(value),
        "flying_fleet(patience_s)": lambda value, _: flying_fleet("/nowhere", value),
        "new(type)": lambda value, _: new(value),
        "new(value)": lambda value, _: encode(new("std_msgs/msg/String", data=value)),
        "define(name)": lambda value, _: define(value, "float64 x"),
        "define(text)": lambda value, _: define("odd_msgs/msg/A", value),
        "decode(type)": lambda value, _: decode(value, b""),
        "decode(payload)": lambda value, _: decode("std_msgs/msg/String", value),
        "encode(message)": lambda value, _: encode(value),
    }
    for name in ("score", "losses", "delivery", "quality", "map", "activity", "links", "links_over_time", "scores",
                 "curves", "pairs"):
        calls[f"plots.{name}(of)"] = lambda value, _, name=name: getattr(plots, name)(value)
    for name, method in METHODS.items():
        calls[f"Client.{name}"] = lambda value, _, method=method: method(in_a_step(), value)
    calls["plots.look.labels_of"] = lambda value, _: plots.look.labels_of([], value)
    return calls


def one_fleet() -> skein.FleetVector:
    """A fleet without a process. Its mission is over."""
    fleet = object.__new__(skein.Fleet)
    fleet._over = fleet._closed = True
    fleet._flying, fleet._worker = False, None
    return skein.FleetVector([fleet])


def heard_once() -> Listener:
    listener = Listener(["/jurong/gimbal"], domain=1)
    listener._heard_any = True  # else it waits for the first program that writes the topic
    return listener


def in_a_step() -> Client:
    """A client that takes part in a fleet, as far as it knows: it is in a step."""
    client = Client(name="jurong", scenario="towers", domain=1, dds="cyclonedds", debug=["x"])
    client._latest["/jurong/ground_truth/odometry"] = encode(new("nav_msgs/msg/Odometry"))
    client._types["/jurong/ground_truth/odometry"] = "nav_msgs/msg/Odometry"
    client._step = Step(client, 1, 20, False, {}, True, 0)
    return client


METHODS: dict[str, Callable[[Client, Any], Any]] = {
    "command": lambda client, value: client.command(value),
    "gimbal": lambda client, value: client.gimbal(value),
    "fly_to(p_W)": lambda client, value: client.fly_to(value),
    "fly_to(speed_mps)": lambda client, value: client.fly_to([0, 0, 1], value),
    "fly_to(yaw)": lambda client, value: client.fly_to([0, 0, 1], yaw=value),
    "look_at": lambda client, value: client.look_at(value),
    "send(what)": lambda client, value: client.send(value),
    "send(topic)": lambda client, value: client.send("text", value),
    "activity(mode)": lambda client, value: client.activity(value),
    "activity(goal_W)": lambda client, value: client.activity("flies", goal_W=value),
    "activity(waits_for)": lambda client, value: client.activity("waits", waits_for=value),
    "debug(name)": lambda client, value: client.debug(value, 1.0),
    "debug(value)": lambda client, value: client.debug("x", value),
    "open(topic)": lambda client, value: client.open(value),
    "open(type)": lambda client, value: client.open("/mine", value),
    "open(targets)": lambda client, value: client.open("/mine", targets=value),
    "is_open": lambda client, value: client.is_open(value),
    "listen(topic)": lambda client, value: client.listen(value),
    "listen(type)": lambda client, value: client.listen("/mine", value),
    "messages": lambda client, value: client._now().messages(value),
}
CASES = cases()


class Compiled:
    """In place of the compiled Member and Listener, which would join DDS domains. The compiled ones refuse a value of
    another type with a TypeError."""

    def __init__(self, *values: Any) -> None:
        kinds = {9: (str, str, int, str, int, str, list, list, int), 7: (int, str, int, str, str, list, int)}
        for value, kind in zip(values, kinds[len(values)]):
            if type(value) is not kind:
                raise TypeError(f"{value!r} is not a {kind.__name__}")
            if kind is list:
                for one in value:
                    if not all(type(part) is str for part in (one if isinstance(one, tuple) else (one,))):
                        raise TypeError(f"{one!r} in a list")

    def say(self, topic: str, payload: bytes) -> str:
        return "sent"

    def open(self, topic: str, of: str, targets: list[str]) -> None:
        self.listen(topic, of)
        if not all(type(node) is str for node in targets):
            raise TypeError(f"{targets!r} are not texts")

    def listen(self, topic: str, of: str) -> None:
        if type(topic) is not str or type(of) is not str:
            raise TypeError(f"{topic!r} or {of!r} is not a text")

    def next(self, timeout_s: float) -> None:
        if type(timeout_s) is not float:
            raise TypeError(f"{timeout_s!r} is not a float")

    def has_writers(self) -> bool:
        return False

    def missed(self) -> int:
        return 0

    def close(self) -> None:
        pass


@pytest.fixture(scope="module")
def launcher(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("launcher") / "skein"
    file.write_text("#!/bin/sh\necho refused >&2\nexit 2\n")
    file.chmod(0o755)
    return file


@pytest.mark.parametrize("odd", ODD)
@pytest.mark.parametrize("case", CASES)
def test_an_odd_argument_raises_an_exception_of_this_package(case: str, odd: str, launcher: Path,
                                                             monkeypatch: pytest.MonkeyPatch) -> None:
    if (case, odd) in VALID or "(launcher)" in case and odd == "none":
        pytest.skip("a valid value")
    for name in ("Member", "Listener"):
        monkeypatch.setattr(native, name, Compiled)
    try:
        CASES[case](ODD[odd], launcher)
    except (skein.Error, KeyError):  # KeyError: a text that names no table
        pass
    except ValueError as error:
        assert any(part in str(error) for part in ("no run to draw", "1 labels for 0 runs"))
