"""Misuses the package's classes: passes random wrong values, calls them in wrong orders, interrupts calls, and uses
objects in forked copies of the interpreter. test_fuzz.py runs this program in a process of its own, because a crash of
the interpreter would end the tests.

    python3 fuzz.py fleet|interrupts|results|programs SEED
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import skein
from interrupts import Interrupts
from skein import client

UAV = "jurong"
# Permitted exceptions for wrong input: those of the package, and KeyError for an unknown name.
REFUSALS = (skein.Error, KeyError)


class Draw:
    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.refused = self.taken = 0

    def value(self, depth: int = 0) -> Any:
        """A random value, which is almost never a valid argument."""
        draw = self.random
        shape = tuple(draw.randrange(5) for _ in range(draw.randrange(4)))
        plain: list[Callable[[], Any]] = [
            lambda: None, lambda: draw.choice([True, False]), lambda: draw.randrange(-3, 4),
            lambda: draw.choice([2**31, 2**63, 2**64, 10**400, -2**70]), lambda: draw.choice([1e300, -1e-300, 5e-324]),
            lambda: draw.choice([np.nan, np.inf, -np.inf]),
            lambda: draw.choice(["", "text", "a\0b", "é\ud800", "x" * 5000]),
            lambda: b"\xff\0", lambda: object(), lambda: 1j, lambda: range(3), lambda: (lambda: 0), lambda: Draw,
            lambda: np.full(shape, draw.choice([0.0, np.nan, 1e300])), lambda: np.zeros(shape, draw.choice("iU?O")),
            lambda: np.float32(draw.random()), lambda: Path("/nowhere")]
        if depth < 3:
            plain += [lambda: [self.value(depth + 1) for _ in range(draw.randrange(4))],
                      lambda: tuple(self.value(depth + 1) for _ in range(draw.randrange(4))),
                      lambda: {draw.choice(["velocity", "seed", "x", 3]): self.value(depth + 1) for _ in range(2)}]
        return draw.choice(plain)()

    def ask(self, what: Callable[..., Any], *arguments: Any, **named: Any) -> None:
        """Calls a function, which must accept the arguments or refuse them with a message."""
        try:
            what(*arguments, **named)
            self.taken += 1
        except REFUSALS as error:
            assert str(error).strip(), (what, arguments, named)
            self.refused += 1


MOTIONS = {"velocity": ["velocity", "yaw_rate"], "goal": ["goal", "path", "speed", "yaw"]}


def action(draw: Draw, actions: str) -> Any:
    names = [*MOTIONS[actions], "gimbal_rate", "gimbal", "look_at", "trigger"]
    right = {"velocity": (0.1, 0, 0.2), "yaw_rate": 0.1, "gimbal_rate": (0.1, 0), "trigger": 1, "goal": (1, 2, 9),
             "speed": 2, "yaw": 0.1}
    chosen = draw.random.sample(names, draw.random.randrange(1, 4))
    return {name: right[name] if name in right and draw.random.random() < 0.3 else draw.value() for name in chosen}


def fuzz_fleet(draw: Draw) -> None:
    for actions in MOTIONS:
        misuse_fleet(draw, actions)
    for _ in range(6):
        draw.ask(skein.Fleet, draw.value(), no_check=True)
        name = draw.random.choice(["planner", "seed", "learners", "step_s", "actions", "map_window", "map_cell_m",
                                   "detections", "render_mode", "launcher", "duration", "uavs", "stop_at", "faults"])
        options = {"no_check": True, name: draw.value()}
        draw.ask(lambda options: skein.Fleet("towers", **options).close(), options)
        draw.ask(skein.vector_env, draw.value(), draw.value())
        draw.ask(skein.gym_env, draw.value(), draw.value())


def misuse_fleet(draw: Draw, actions: str) -> None:
    """Random wrong calls do not change a fleet: its twin, which receives none of them, flies identically."""
    options: Any = {"learners": [UAV], "duration": 30, "no_check": True, "actions": actions}
    fleet, twin = skein.Fleet("towers", **options), skein.Fleet("towers", **options)
    fleet.reset(seed=3)
    twin.reset(seed=3)
    for _ in range(13):
        for _ in range(12):
            value = draw.value()
            draw.random.choice([
                lambda: draw.ask(fleet.observation_space, value), lambda: draw.ask(fleet.action_space, value),
                lambda: draw.ask(fleet.save_commands, value, draw.value()), lambda: draw.ask(fleet.end_step),
                lambda: draw.ask(fleet.render), lambda: draw.ask(fleet.state), lambda: draw.ask(fleet.result),
                lambda: wrong_step(draw, fleet, actions), lambda: wrong_reset(draw, fleet)])()
        assert fleet.truth.step == twin.truth.step, "a refused call has moved the fleet"
        x, y, z = (draw.random.uniform(-1, 1) for _ in range(3))
        right = {UAV: {"velocity": (x, y, z)} if actions == "velocity" else {"goal": (20 * x, 20 * y, 8 + z)}}
        for one in (fleet, twin):
            one.step(right)
    digests = fleet.result()["digest"], twin.result()["digest"]
    assert digests[0] == digests[1], digests
    fleet.close()
    fleet.close()
    for call in (fleet.reset, fleet.step, fleet.end_step, fleet.fork, fleet.result, fleet.state, lambda: fleet.truth,
                 lambda: fleet.begin_step({UAV: {}}), fleet.render):
        taken = draw.taken
        draw.ask(call)
        assert draw.taken == taken or call == fleet.render, "a closed fleet accepted a call"
    assert repr(fleet) and not in_a_copy(twin), "a forked copy of the interpreter could fly the fleet"
    twin.step()
    twin.close()


def wrong_step(draw: Draw, fleet: skein.Fleet, actions: str) -> None:
    """Calls `step()` with wrong actions, or with a wrong duration."""
    value = draw.value()
    if value is None or isinstance(value, dict):
        value = [value]
    if draw.random.random() < 0.5:
        # After a random action, which may be right by chance, the name of an unknown UAV is wrong in any case.
        draw.ask(fleet.step, draw.random.choice([value, {"nobody": {}}, {UAV: action(draw, actions) | {"fly": 1}},
                                                 {UAV: action(draw, actions), "nobody": {}}]))
    else:
        draw.ask(fleet.step, {UAV: action(draw, actions)}, step_s=draw.random.choice([0, -1, 0.07, np.nan, "x", [1]]))


def wrong_reset(draw: Draw, fleet: skein.Fleet) -> None:
    draw.ask(fleet.reset, draw.random.choice([-1, 1.5, "x", np.nan, 2**63, [1]]),
             draw.random.choice([None, {}, {"x": draw.value()}]))


def in_a_copy(fleet: skein.Fleet) -> int:
    """Uses the fleet in a forked copy of the interpreter. Returns the copy's exit code: 0 if each call was refused."""
    child = os.fork()
    if child == 0:
        code = 0
        for call in (fleet.step, fleet.reset, fleet.fork, fleet.result, fleet.state):
            try:
                call()
                code = 1
            except skein.Error:
                pass
        with contextlib.suppress(skein.Error):
            fleet.close()
        os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def fuzz_interrupts(draw: Draw) -> None:
    """After an interrupt at any instruction, the next step() of a fleet either flies exactly one step and returns what
    the learner sees then, or is refused with a message that names reset() or end_step(). After reset(), the fleet flies
    as before."""
    interrupts, struck, stood = Interrupts(), 0, 0
    up = {UAV: {"velocity": (0.3, 0, 1)}}
    with skein.Fleet("towers", learners=[UAV], duration=30, no_check=True) as fleet:
        def episode() -> str:
            fleet.reset(seed=5)
            for _ in range(3):
                fleet.step(up)
            return str(fleet.result()["digest"])

        calls: dict[str, Callable[[], Any]] = {
            "step": lambda: fleet.step(up), "fork": lambda: fleet.fork().close(), "result": lambda: fleet.result(),
            "reset": lambda: fleet.reset(seed=6)}
        right = episode()
        for number in range(30):
            call = draw.random.choice(list(calls.values()))
            fleet.reset(seed=5)
            with interrupts.at_instruction(0):
                call()
            fleet.reset(seed=5)
            fleet.step(up)
            try:
                with interrupts.at_instruction(draw.random.randrange(1, interrupts.instructions + 1)):
                    call()
            except KeyboardInterrupt:
                struck += 1
            try:
                step = fleet.truth.step
                times_s = []
                for flown in (1, 2):
                    times_s.append(fleet.step()[0][UAV]["time_s"])
                    assert fleet.truth.step == step + flown, "a call returned the answer to another call"
                assert times_s[0] < times_s[1], "the observations are those of an earlier mission"
                stood += 1
            except skein.InputError as error:
                assert "reset" in str(error) or "end_step" in str(error), error
            if number % 3 == 0:
                assert episode() == right, "the flight after an interrupt and reset() differs from the flight before"
    assert struck > 20 and stood > 2, (struck, stood)


def fuzz_results(draw: Draw) -> None:
    """Reads runs and studies from folders whose files have random contents, and asks for tables by random names. Also
    calls run(), compare() and contest() with random arguments."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        keys = ["scenario", "planner", "seed", "status", "score", "digest", "uavs", "losses", "sim_time_s"]
        odd: Any = [None, True, 3, -1.5, "x", [], [3], {}, {"a": 1}, [{"name": 3}], [{"nobody": 1}],
                    {"cause": {"score": "x"}}]
        for number in range(80):
            (path / "result.json").write_text(json.dumps({key: draw.random.choice(odd) for key in draw.random.sample(
                keys, draw.random.randrange(len(keys)))}))
            for name in ("captures", "events", "digests", "trajectories"):
                (path / f"{name}.csv").write_bytes(bytes(draw.random.choice(b'a1,."\n\0\xff') for _ in range(60)))
            run = skein.Run(path)
            assert repr(run)
            for name in [*keys, "captures", "events", "links", "digests", "trajectories", "score_losses", "scene"]:
                draw.ask(getattr, run, name, 0)
            for call in (run.table, run.frame, run.hand, skein.Run, skein.Study):
                value = draw.value()
                draw.ask(call, value if not isinstance(value, (list, dict, np.ndarray)) else str(value)[:40])
        study = skein.Study(path)
        for _ in range(50):
            draw.ask(study.table, str(draw.value())[:40])
            draw.ask(study.runs, **{draw.random.choice(["planner", "seed", "x"]): draw.value()})
        for command in (skein.run, skein.compare, skein.contest):
            for _ in range(12):
                draw.ask(command, draw.value(), launcher=draw.random.choice(["/bin/true", "/bin/false", draw.value()]),
                         **{draw.random.choice(["seed", "duration", "out", "faults", "x"]): draw.value()})


def fuzz_programs(draw: Draw) -> None:
    """Makes messages, clients and listeners from random values."""
    types = ["nav_msgs/msg/Odometry", "std_msgs/msg/String", "skein_msgs/msg/Step", "x/msg/Y"]
    for _ in range(400):
        value = draw.value()
        name = draw.random.choice([*types, value])
        draw.ask(client.decode, name, bytes(draw.random.randrange(256) for _ in range(draw.random.randrange(200))))
        draw.ask(client.new, name)
        draw.ask(client.encode, value)
        draw.ask(client.define, draw.random.choice(["a/msg/B", value]), draw.random.choice(["float64[3] x", value]))
        message = client.new("geometry_msgs/msg/Twist")
        message.linear = value
        draw.ask(client.encode, message)
    for _ in range(40):
        draw.ask(client.Client, **{draw.random.choice(["read", "scans", "name"]): draw.value()})
        draw.ask(client.Listener, draw.value(), **{draw.random.choice(["run", "node", "domain", "dds"]): draw.value()})
    domain = draw.random.randrange(200, 231)
    listener = client.Listener(["/jurong/ground_truth/odometry"], domain=domain, dds="cyclonedds", patience_s=0.0)
    assert not in_another(listener)
    listener.close()
    listener.close()
    draw.ask(lambda: list(listener))


def in_another(listener: Any) -> int:
    """Uses the listener in a forked copy of the interpreter. Returns the copy's exit code: 0 if the listener refused or
    had no message."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            next(iter(listener))
        except (skein.Error, StopIteration):
            code = 0
        os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def main() -> None:
    what, seed = sys.argv[1], int(sys.argv[2])
    draw = Draw(seed)
    {"fleet": fuzz_fleet, "interrupts": fuzz_interrupts, "results": fuzz_results, "programs": fuzz_programs}[what](draw)
    print(f"{what}, seed {seed}: {draw.refused} refused, {draw.taken} taken")


if __name__ == "__main__":
    main()
