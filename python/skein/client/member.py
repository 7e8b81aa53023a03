"""A Python program as a member of the lock-step, in place of a UAV's software or at the ground station."""

from __future__ import annotations

import atexit
import contextlib
import math
import os
import sys
import weakref
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from ..errors import Error, InputError, ProcessError
from ..launch import path_text
from ..planner import GimbalCommand, TrajectoryCommand
from ..planner_config import AgentConfig, Vector, VectorLike
from . import messages, words
from ._native import native
from .messages import Message
from .step import Step

_TEXT = "std_msgs/msg/String"
_ACCELERATION_MPS2 = 1.0  #: greatest acceleration and deceleration of fly_to()
_LEASE_S = 60  #: DDS lease: a program that is silent for so long counts as dead
_open: weakref.WeakSet[Client] = weakref.WeakSet()


class LostError(ProcessError):
    """The fleet has ended, or goes on without this program, for example because the program did not answer in time."""


@dataclass(slots=True)
class _Flight:
    """Last command of fly_to(): exchange, position, speed and yaw."""

    k: int
    p_W: Vector
    speed_mps: float
    yaw: float


@contextlib.contextmanager
def translated() -> Iterator[None]:
    """A context that turns exceptions of the compiled part into those of this package."""
    try:
        yield
    except native.WrongUse as error:
        raise Error(str(error)) from None
    except native.WrongInput as error:
        raise InputError(str(error)) from None
    except native.Lost as error:
        raise LostError(str(error), 3) from None
    except RuntimeError as error:  # from the DDS vendor
        raise ProcessError(str(error), 3) from None


def variable(name: str, value: Any) -> str:
    """`value`, or the environment variable `name`, which the launcher sets. Raises InputError if both are missing."""
    if value is not None:
        return str(value)
    if found := os.environ.get(name):
        return found
    raise InputError(f"{name} is not set: this program is to be started by the launcher, as in\n"
                     "  skein run towers --planner 'hover,jurong=exec:python3 my_uav.py'")


def whole(name: str, text: str, most: int) -> int:
    if not text.isascii() or not text.isdigit() or len(text) > 20 or int(text) > most:
        raise InputError(f"{name}: must be a whole number up to {most}, not {text!r:.80}")
    return int(text)


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise InputError(f"{name}: must be a text, not {value!r:.80}")
    return str(value)


def texts(name: str, value: Any) -> list[str]:
    """A list of texts. A single text is none: it would count as a list of letters."""
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable):
        raise InputError(f"{name}: must be a list of texts, not {value!r:.80}")
    for one in value:
        if not isinstance(one, str):
            raise InputError(f"{name}: each entry is a text, not {one!r:.80}")
    return [str(one) for one in value]


class Client:
    """Takes part in the lock-step, with either DDS vendor, and delivers the UAV's captures by itself.

        with Client() as uav:
            for step in uav:
                uav.fly_to(step.state.p_WB + [0, 0, 1])

    Each pass of the loop is one exchange. Its commands are sent when the loop asks for the next exchange; the fleet
    waits until then. The launcher sets variables for UAV, domain, vendor and run; arguments override them.

    `scans`, `key_frames`: whether to read them; they cost most. `read`: further topics of this UAV's domain, for
    `Step.messages()`. `debug`: names of the values that `debug()` publishes. Use it from the thread that made it.
    """

    def __init__(self, *, scans: bool = False, key_frames: bool = False, read: Sequence[str] = (),
                 debug: Sequence[str] = (), name: str | None = None, domain: int | None = None, dds: str | None = None,
                 run: int | None = None, scenario: str | os.PathLike[str] | None = None,
                 security: str | os.PathLike[str] | None = None) -> None:
        self.name = variable("SKEIN_UAV", name)  #: name of the UAV, or "gcs"
        file = variable("SKEIN_SCENARIO", None if scenario is None else path_text("scenario", scenario))
        with translated():
            #: The rules of the mission, the own vehicle and the fleet. At the station `vehicle` is None.
            self.config: AgentConfig = words.config_of(native.config(file, self.name))
            radio = native.radio(file, self.name)
        self._radio = {topic: of for topic, of, _ in radio}
        self._sends = {topic for topic, _, sends in radio if sends}
        for option, wanted in (("scans", scans), ("key_frames", key_frames)):
            if not isinstance(wanted, bool):
                raise InputError(f"{option}: must be True or False, not {wanted!r:.80}")
        self._options = {option for option, wanted in (("scans", scans), ("key_frames", key_frames)) if wanted}
        self._read = [*dict.fromkeys([*self._usual_topics(), *texts("read", read)])]
        self._debug = tuple(texts("debug", debug))
        self._writes = self._usual_commands() if self.is_uav else []
        self._latest: dict[str, bytes] = {}
        self._types: dict[str, str] = {}
        self._step: Step | None = None
        self._flight: _Flight | None = None
        self._closed = False
        with translated():
            self._member = native.Member(
                file, self.name, whole("SKEIN_DOMAIN", variable("SKEIN_DOMAIN", domain), 230),
                variable("SKEIN_DDS", dds), whole("SKEIN_RUN", str(run) if run is not None else
                                                  os.environ.get("SKEIN_RUN", "0"), 2**64 - 1),
                path_text("security", security) if security is not None else os.environ.get("SKEIN_SECURITY", ""),
                self._read, self._writes, _LEASE_S)
        _open.add(self)

    @property
    def is_uav(self) -> bool:
        return self.config.index >= 0

    # ---- steps ---------------------------------------------------------------------------------------------------

    def __iter__(self) -> Iterator[Step]:
        return self

    def __next__(self) -> Step:
        """Answers the last step with all messages that it queued, and waits for the next step. Raises LostError."""
        if self._closed:
            if self._step is not None and self._step.final:
                raise StopIteration
            raise Error("this client is closed")
        with translated():
            going_on = self._member.next()
        if not going_on:
            self._closed = True
            raise StopIteration
        arrived: dict[str, list[bytes]] = {}
        for topic, payload in self._member.messages():
            arrived.setdefault(topic, []).append(payload)
            self._latest[topic] = payload
        self._step = Step(self, self._member.k, self._member.tick, self._member.final_step, arrived,
                          self._member.station_linked, self._member.undelivered)
        return self._step

    @property
    def joins(self) -> int:
        """How often the program has joined the lock-step: once, and again after each fault that stopped it."""
        return self._member.joins

    def close(self) -> None:
        """Leaves the fleet. Before the last step, the launcher reports the program as lost."""
        self._closed = True
        self._member.close()

    def __enter__(self) -> Client:
        return self

    def __exit__(self, _type: object, error: BaseException | None, _trace: object) -> None:
        if error is not None and self._step is not None:
            error.add_note(f"{self.name}'s program failed at step {self._step.k} ({self._step.time_s:.2f} s)")
        self.close()

    # ---- commands and messages, within a step --------------------------------------------------------------------

    def command(self, command: TrajectoryCommand) -> None:
        """Sends a command to the flight controller unchanged, for this exchange (docs/rules.md, P1 to P3)."""
        if not isinstance(command, TrajectoryCommand):
            raise InputError(f"command: must be a TrajectoryCommand, not {command!r}")
        self._say(f"/{self.name}/command/trajectory", words.trajectory_at(self._now().tick, command))

    def fly_to(self, p_W: VectorLike, speed_mps: float = 2.0, yaw: float | None = None) -> bool:
        """Flies along a straight line; call it in each step. It avoids no obstacles: that is up to your program. `yaw`:
        of the body [rad]; None: unchanged. Returns whether the UAV is within half a metre of the place."""
        step, goal, speed = self._now(), words.finite(p_W, "p_W"), words.number(speed_mps, "speed_mps")
        if speed <= 0.0:
            raise InputError(f"speed_mps: must be above 0, not {speed_mps!r}")
        state, dt = step.state, self.config.exchange_period_s
        heading = self._flight.yaw if self._flight else state.yaw
        if self._flight is None or step.k - self._flight.k > 1:  # no fly_to() in the last step
            self._flight, heading = _Flight(step.k - 1, state.p_WB, 0.0, state.yaw), state.yaw
        last = self._flight
        if last.k < step.k:
            way = goal - last.p_W
            left = float(np.linalg.norm(way))
            brakes = math.sqrt(2.0 * _ACCELERATION_MPS2 * left)
            speed = min(speed, brakes, last.speed_mps + _ACCELERATION_MPS2 * dt, left / dt)
            velocity = way / left * speed if left > 0.0 else np.zeros(3)
            self._flight = _Flight(step.k, last.p_W + velocity * dt, speed,
                                   heading if yaw is None else words.number(yaw, "yaw"))
            self.command(TrajectoryCommand(self._flight.p_W, velocity, yaw=self._flight.yaw))
        return bool(np.linalg.norm(goal - state.p_WB) < 0.5)

    def gimbal(self, command: GimbalCommand) -> None:
        """Commands the gimbal's angles or rates."""
        if not isinstance(command, GimbalCommand):
            raise InputError(f"command: must be a GimbalCommand, not {command!r}")
        self._say(f"/{self.name}/command/gimbal", words.gimbal_command(command))

    def look_at(self, p_W: VectorLike) -> None:
        """Turns the gimbal so that the point is in the centre of the image, as far as the gimbal's limits allow."""
        aim = words.aim_at(words.finite(p_W, "p_W"), self._now().state, self.config.vehicle)
        self.gimbal(aim)

    def trigger(self) -> None:
        """Takes a picture. After the first call, the camera takes no pictures by itself any more."""
        self._say(f"/{self.name}/command/camera_trigger",
                  messages.new("skein_msgs/msg/BoolStamped", header=words.header_at(self._now().tick), data=True))

    def send(self, what: str | Message, topic: str = "/plan") -> None:
        """Sends a text, or a message of the topic's type, by radio. Nodes with a link receive it in the next step."""
        of = self._radio.get(text("topic", topic))
        if of is None or topic not in self._sends:
            raise InputError(f"{self.name} may not send on '{topic}'; it may on {', '.join(sorted(self._sends))}. "
                             "open() registers another topic")
        message = messages.new(_TEXT, data=what) if isinstance(what, str) and of == _TEXT else what
        if not isinstance(message, Message) or message.TYPE != of:
            raise InputError(f"'{topic}' carries {of}, not {what!r}")
        self._say(topic, message)

    def activity(self, mode: str, *, goal_W: VectorLike | None = None, waits_for: str = "", no_way: str = "") -> None:
        """Reports what the UAV does, for human readers of the live page, the recording and activity.csv."""
        message = messages.new("skein_msgs/msg/Activity", header=words.header_at(self._now().tick), mode=mode,
                               waits_for=waits_for, no_way=no_way, undelivered=self._now().undelivered,
                               has_goal=goal_W is not None)
        if self.is_uav:
            message.speed = float(np.linalg.norm(self._now().state.v_WB))
        if goal_W is not None:
            words._set(message.goal, words.finite(goal_W, "goal_W"))
        self._say(f"/{self.name}/activity", message)

    def debug(self, name: str, value: float) -> None:
        """Publishes a value, for faults, properties and plots (docs/properties.md). `name`: one of
        `Client(debug=[...])`."""
        if text("name", name) not in self._debug:
            known = ", ".join(self._debug) or "none"
            raise InputError(f"'{name}' is not a name of Client(debug=[...]); those are: {known}")
        self._say(f"/{self.name}/debug/{name}", messages.new("std_msgs/msg/Float64", data=words.number(value, name)))

    # ---- the program's own radio topics (docs/radio.md) ----------------------------------------------------------

    def open(self, topic: str, type: str = _TEXT, targets: Sequence[str] = ("all",)) -> None:
        """Registers a radio topic for sending to `targets`. Send only once `is_open()` returns True."""
        self._now()
        nodes = texts("targets", targets)
        messages.type_named(type)
        with translated():
            self._member.open(text("topic", topic), type, nodes)
        self._radio[topic] = type
        self._sends.add(topic)

    def is_open(self, topic: str) -> bool:
        """Whether the radio topic is open for sending. Raises InputError if the router has refused it."""
        self._now()
        if text("topic", topic) not in self._sends:
            return False
        with translated():
            is_open, refusal, _ = self._member.sending(topic)
        if refusal:
            raise InputError(f"the router refused '{topic}': {refusal}")
        return is_open

    def listen(self, topic: str, type: str = _TEXT) -> None:
        """Receives a radio topic that another node registers, now or later."""
        self._now()
        messages.type_named(type)
        with translated():
            self._member.listen(text("topic", topic), type)
        self._radio[topic] = type

    # ---- internals -----------------------------------------------------------------------------------------------

    def _now(self) -> Step:
        if self._step is None or self._closed:
            raise Error("this client is closed" if self._closed else "there is no step yet: `for step in client:`")
        return self._step

    def _say(self, topic: str, message: Message) -> None:
        self._now()
        if not self.is_uav and topic not in self._sends:
            raise InputError("the ground station has no body")
        with translated():
            said = self._member.say(topic, messages.encode(message))
        if said != "sent":
            self._refuse(topic, said)

    def _refuse(self, topic: str, why: str) -> NoReturn:
        raise InputError({"full": f"'{topic}': that many messages in one step would be lost; its history is full",
                          "closed": f"'{topic}' is not open yet: is_open() tells",
                          "undeclared": f"'{topic}': this program has not declared it"}[why])

    def _usual_topics(self) -> list[str]:
        topics = ["/gcs/bounding_box_vertices", f"/{self.name}/mission_duration_remained",
                  f"/{self.name}/nbr_odom_cloud"]
        if not self.is_uav:
            return topics
        topics += [f"/{self.name}/{one}" for one in ("ground_truth/odometry", "gimbal", "command_rejected")]
        topics.append("/skein/detected")
        has_lidar = self.config.vehicle.lidar_range_m is not None
        if "scans" in self._options and has_lidar:
            topics.append(f"/{self.name}/cloud_inW")
        if "key_frames" in self._options:
            topics += [f"/{self.name}/{one}" for one in (["slf_kf_cloud"] * has_lidar + ["nbr_kf_cloud"])]
        return topics

    def _usual_commands(self) -> list[str]:
        names = ["command/trajectory", "command/gimbal", "command/camera_trigger", "activity"]
        return [f"/{self.name}/{one}" for one in names + [f"debug/{one}" for one in self._debug]]

    def _arrival(self, topic: str) -> str:
        """The name under which a radio topic arrives here."""
        return f"{topic}/{self.name}" if topic in self._radio else topic

    def _type_of(self, topic: str) -> str:
        if text("topic", topic) in self._radio:
            return self._radio[topic]
        if topic not in self._types:
            if topic not in self._read:
                raise InputError(f"'{topic}' is not read: Client(read=['{topic}']) does")
            with translated():
                self._types[topic] = native.type_of(topic, self.name)
        return self._types[topic]


@atexit.register
def _leave() -> None:
    """Closes all clients: the DDS vendor's threads must end before the interpreter does."""
    for client in list(_open):
        with contextlib.suppress(Exception):
            client.close()
    sys.stdout.flush()
