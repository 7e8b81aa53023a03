"""Receives messages of a fleet without taking part in the lock-step: no program waits for it, and it does not affect
the flight."""

from __future__ import annotations

import atexit
import contextlib
import os
import time
import weakref
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import Error, InputError
from ..launch import path_text
from . import messages, words
from ._native import native
from .member import translated, variable, whole
from .messages import Message

_LOOK_S = 0.1
_open: weakref.WeakSet[Listener] = weakref.WeakSet()


@dataclass(slots=True)
class Heard:
    """A received message."""

    topic: str
    message: Message


@dataclass(frozen=True, slots=True)
class FlyingFleet:
    """A fleet that flies on this host. `folder`: its results."""

    folder: Path
    base_domain: int
    run: int
    dds: str
    fleet: tuple[str, ...]  #: names of the UAVs

    def domain(self, node: str) -> int:
        """DDS domain of a node: "world", "gcs" or a UAV's name. Raises InputError for another name."""
        names = ("world", "gcs", *self.fleet)
        if not isinstance(node, str) or node not in names:
            raise InputError(f"'{node}' is not a node of this fleet; those are {', '.join(names)}")
        return self.base_domain + names.index(node)


def flying_fleet(run: str | os.PathLike[str] | None = None, patience_s: float = 0.0) -> FlyingFleet:
    """The fleet whose results go to the folder `run`; None: the only fleet on this host. Waits up to `patience_s` [s]
    for it, then raises InputError. Like `skein ps`, it finds no fleets in one process (no DDS) or in containers."""
    looks_left = int(_patience_s(patience_s) / _LOOK_S)
    while True:
        try:
            return _flying_fleet(run)
        except InputError:
            if looks_left == 0:
                raise
        looks_left -= 1
        time.sleep(_LOOK_S)


def _patience_s(value: float) -> float:
    patience_s = words.number(value, "patience_s")
    if patience_s < 0.0:
        raise InputError(f"patience_s: must be at least 0, not {value!r}")
    return patience_s


def _flying_fleet(run: str | os.PathLike[str] | None) -> FlyingFleet:
    folder = path_text("run", run) if run is not None else None
    if folder is not None and "\0" in folder:
        raise InputError(f"no fleet flies into {folder!r}: no folder has such a name")
    found = list(_fleets())
    if folder is not None:
        found = [fleet for fleet in found if fleet.folder == Path(folder).resolve()]
    if len(found) == 1:
        return found[0]
    which = "no fleet flies on this host" if folder is None else f"no fleet flies into {folder}"
    if found:
        which = "several fleets fly: say which, by its folder: " + ", ".join(str(fleet.folder) for fleet in found)
    raise InputError(which)


def _fleets() -> Iterator[FlyingFleet]:
    for process in Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            line = (process / "cmdline").read_bytes().decode(errors="surrogateescape").split("\0")
            folder = Path(os.readlink(process / "cwd"))
        except OSError:  # the process has ended, or belongs to another user
            continue
        if "sim_server" not in (Path(word).name for word in line[:6]):  # the command may begin with a loader
            continue
        options = {word: value for word, value in zip(line, line[1:]) if word.startswith("--")}
        try:
            yield FlyingFleet((folder / options["--out"]).resolve(), int(options["--domain"]),
                              int(options.get("--run", "0")), options.get("--dds", "cyclonedds"),
                              _names_of(options["--scenario"]))
        except (KeyError, ValueError):
            continue


def _names_of(scenario: str) -> tuple[str, ...]:
    with translated():
        return tuple(one["name"] for one in native.config(scenario, "gcs")["fleet"])


class Listener:
    """Receives topics in one domain of a flying fleet.

        with Listener(["/jurong/ground_truth/odometry"], node="jurong") as listener:
            for heard in listener:
                print(heard.message.pose.pose.position)

    `topics`: names, or a dictionary from names to types for topics that are not Skein's own, such as radio topics.
    `node`: whose domain: "world" (the truth), "gcs" or a UAV; default: the first part of the first topic's name.
    `run`: the fleet's results folder. The listener waits up to `patience_s` [s] for the fleet to start. For a fleet on
    another host, give `domain` and `dds` instead of both. The loop ends when the fleet ends. At most `most` messages
    wait to be taken; beyond that, the oldest are discarded and counted (`missed`). Use it from the thread that made it.
    """

    def __init__(self, topics: Sequence[str] | Mapping[str, str], *, node: str | None = None,
                 run: str | os.PathLike[str] | None = None, domain: int | None = None, dds: str | None = None,
                 security: str | os.PathLike[str] | None = None, patience_s: float = 0.0, most: int = 10_000) -> None:
        listed = isinstance(topics, (Sequence, Mapping)) and not isinstance(topics, str)
        if not listed or not topics or not all(isinstance(topic, str) for topic in topics):
            raise InputError(f"topics: must be a list of names like '/jurong/gimbal', not {topics!r:.80}")
        for name, text in (("node", node), ("dds", dds)):
            if text is not None and not isinstance(text, str):
                raise InputError(f"{name}: must be a text, not {text!r:.80}")
        if whole("most", str(most), 10**9) < 1:
            raise InputError("most: must be at least 1")
        if domain is not None and run is not None:
            raise InputError("run: cannot stand beside domain: both say which fleet it is")
        if _patience_s(patience_s) > 0.0 and domain is not None:
            raise InputError("patience_s: cannot stand beside domain, in which the loop waits for the fleet anyway")
        named = dict(topics) if isinstance(topics, Mapping) else dict.fromkeys(topics, "")
        first = next(iter(named)).split("/")
        self.node = node if node is not None else first[1] if len(first) > 2 else "gcs"
        given_run = 0
        if domain is None and os.environ.get("SKEIN_DOMAIN") and run is None:
            domain = whole("SKEIN_DOMAIN", os.environ["SKEIN_DOMAIN"], 230)
            dds = variable("SKEIN_DDS", dds)
            if node is None:
                self.node = os.environ.get("SKEIN_UAV", self.node)
        elif domain is None:
            fleet = flying_fleet(run, patience_s)
            domain, given_run = fleet.domain(self.node), fleet.run
            dds = dds or fleet.dds
        self._types = {topic: self._type(topic, of) for topic, of in named.items()}
        self._closed = self._heard_any = False
        self._missed = 0
        keys = path_text("security", security) if security is not None else os.environ.get("SKEIN_SECURITY", "")
        with translated():
            self._ear = native.Listener(whole("domain", str(domain), 230), dds or "cyclonedds", given_run, keys,
                                        self.node, [(topic, named[topic]) for topic in named], most)
        _open.add(self)

    def _type(self, topic: str, of: str) -> str:
        if not isinstance(of, str):
            raise InputError(f"topics: the type of {topic} must be a name like 'std_msgs/msg/String', not {of!r:.80}")
        if of:
            messages.type_named(of)
            return of
        with translated():
            return native.type_of(topic, self.node)

    def hear(self, timeout_s: float | None = None) -> Heard | None:
        """The next message. None after `timeout_s` [s]; without a timeout, None when no program writes these topics any
        more."""
        if self._closed:
            raise Error("this listener is closed")
        seconds = 0.2 if timeout_s is None else min(words.number(timeout_s, "timeout_s"), 86400.0)
        if seconds < 0.0:
            raise InputError(f"timeout_s: must be at least 0, not {timeout_s!r}")
        while True:
            with translated():
                heard = self._ear.next(seconds)
                if heard is None and timeout_s is None:
                    writers = self._ear.has_writers()
                    if writers or not self._heard_any:
                        self._heard_any = self._heard_any or writers
                        continue
            if heard is None:
                return None
            self._heard_any = True
            topic, payload = heard
            return Heard(topic, messages.decode(self._types[topic], payload))

    def __iter__(self) -> Iterator[Heard]:
        while (heard := self.hear()) is not None:
            yield heard

    @property
    def missed(self) -> int:
        """Number of messages that were discarded because they were not taken in time."""
        if not self._closed:
            with translated():
                self._missed = self._ear.missed()
        return self._missed

    def close(self) -> None:
        if not self._closed:
            self._missed = self.missed
        self._closed = True
        self._ear.close()

    def __enter__(self) -> Listener:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


@atexit.register
def _leave() -> None:
    for listener in list(_open):
        with contextlib.suppress(Exception):
            listener.close()
