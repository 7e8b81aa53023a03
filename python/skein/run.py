"""Runs: `skein.run()` flies one, `Run` reads one from its folder."""

from __future__ import annotations

import hashlib
import json
import math
import os
import re
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from . import columns
from .errors import DamagedError, Error, InputError, MissingError, missing_package
from .launch import Finished, fly, option_arguments, path_text, positional
from .tables import Array, read_table, read_text, read_wide_table

if TYPE_CHECKING:
    import pandas

_Kind = TypeVar("_Kind")


def run(scenario: str | os.PathLike[str] = "towers", *, launcher: str | os.PathLike[str] | None = None,
        verbose: bool = False, **options: Any) -> Run:
    """Flies a fleet, as `skein run SCENARIO` does, and returns the finished run.

    Every option of `skein run --help` is a keyword: `planner="kios"`, `seed=3`, `one_process=True`, `duration=60`,
    `log=["jurong=debug", "raffles=debug"]`. The launcher chooses the results folder as on the command
    line, unless `out="..."` names one.

    `launcher` is the path of the launcher; the default is SKEIN in the environment, else this checkout's `./skein`,
    else `skein` in PATH. `verbose` shows the launcher's output during the flight.

    Raises `InputError` if the input is wrong, `ProcessError` if a process failed (the exception's `run` has the
    complete results), another `Error` for other exit codes, and KeyboardInterrupt after Ctrl-C, when the fleet has
    ended.
    """
    words = ["run", positional("scenario", scenario), *option_arguments(options)]
    return fly(words, results_folder, Run, "run", launcher=launcher, verbose=verbose)


def results_folder(finished: Finished) -> Path | None:
    """The results folder that the launcher named at the end of its output, or else at the beginning."""
    named = re.findall(r"^results   (.+)$", finished.out, re.MULTILINE)
    named = named or re.findall(r"^.*, results in (.+)$", finished.err, re.MULTILINE)
    return Path(named[-1]) if named else None


class _AsWritten(str):
    """A number, kept as it is written in the JSON file."""


def _compact(value: Any) -> str:
    """The compact JSON text over which Skein computes the checksum."""
    if isinstance(value, _AsWritten):
        return str(value)
    if isinstance(value, dict):
        return "{" + ",".join(f"{_compact(k)}:{_compact(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ",".join(map(_compact, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def read_json(file: Path, missing: str) -> dict[str, Any]:
    """Reads a JSON file that holds an object, and verifies its checksum if it has one. `missing` is the likely
    reason if the file does not exist, for the message."""
    text = read_text(file, missing)
    try:
        value = json.loads(text)
        as_written = json.loads(text, parse_float=_AsWritten, parse_int=_AsWritten, parse_constant=_AsWritten)
        if not isinstance(value, dict):
            raise ValueError("it is not a JSON object")
        stated = as_written.pop("checksum", None)
        # An escape in the file may be half of a surrogate pair: surrogatepass encodes it, so that the mismatch of the
        # checksum is reported instead of a UnicodeEncodeError.
        content = _compact(as_written).encode(errors="surrogatepass") if stated is not None else b""
    except (ValueError, RecursionError) as error:  # RecursionError: the JSON is nested too deeply
        line = getattr(error, "lineno", 1)
        raise DamagedError(f"{file}:{line}: is damaged: {error}") from None
    if stated is not None and hashlib.sha256(struct.pack("<Q", len(content)) + content).hexdigest() != stated:
        raise DamagedError(f"{file}:1: is damaged, or was edited: its checksum does not match its contents (Skein "
                           "accepts it unchecked if you delete the key 'checksum')")
    return value


def existing_folder(path: str | os.PathLike[str]) -> Path:
    text = path_text("path", path)
    try:
        folder = Path(os.path.abspath(text))
        there = folder.is_dir()
    except (OSError, ValueError):  # a name that no file can have
        there = False
    if not there:
        raise MissingError(f"there is no folder {text!r:.200}")
    return folder


class Run:
    """A run, read from its results folder. It reads each file when you first ask for its contents.

    `result` is result.json. The tables are read-only structured arrays of NumPy, with the columns and units of
    docs/results.md: `run.captures["q_blur"]`. `run.frame("captures")` returns the same table as a pandas frame. Flags
    are bool; an empty cell is NaN or "". A missing file raises `MissingError`, a damaged one `DamagedError`.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = existing_folder(path)
        self._tables: dict[str, Array] = {}
        self._json: dict[str, dict[str, Any]] = {}

    def __repr__(self) -> str:
        try:
            what = f"{self.scenario}, seed {self.seed}, {self.status}: score {self.score:.1f}"
        except (Error, TypeError, ValueError) as error:
            what = str(error)
        return f"<skein.Run {self.path}: {what}>"

    # -- contents of result.json --------------------------------------------------------------------------------------

    @property
    def result(self) -> dict[str, Any]:
        """result.json, with the keys of docs/results.md."""
        return self._read_json("result.json", "it is not a results folder, or its run has not ended")

    @property
    def scene(self) -> dict[str, Any]:
        """scene.json: boxes, interest points, the mesh, and each UAV's camera."""
        return self._read_json("scene.json", "the run ended before Skein wrote the file, or the disk was full")

    def _read_json(self, name: str, missing: str) -> dict[str, Any]:
        if name not in self._json:
            self._json[name] = read_json(self.path / name, missing)
        return self._json[name]

    def _value(self, key: str, kind: type[_Kind]) -> _Kind:
        value = self.result.get(key)
        if not isinstance(value, kind):
            raise DamagedError(
                f"{self.path / 'result.json'}:1: {key} must be of type {kind.__name__}, not {value!r:.60}")
        return value

    def _number(self, key: str) -> float:
        """A number of result.json; NaN if it is unknown because the process that knows it died."""
        value = self.result.get(key)
        if value is None:
            return math.nan
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise DamagedError(f"{self.path / 'result.json'}:1: {key} must be a number, not {value!r:.60}")
        return float(value)

    @property
    def scenario(self) -> str:
        return self._value("scenario", str)

    @property
    def planner(self) -> dict[str, str]:
        """The planner of each UAV, by the UAV's name."""
        return dict(self._value("planner", dict))

    @property
    def seed(self) -> int:
        return self._value("seed", int)

    @property
    def status(self) -> str:
        """completed, no_takeoff, interrupted or aborted."""
        return self._value("status", str)

    @property
    def score(self) -> float:
        """The delivered score; NaN if it is unknown."""
        return self._number("score")

    @property
    def digest(self) -> str | None:
        """The digest; None if the run is not deterministic: a repetition may end differently."""
        value = self.result.get("digest")
        return value if isinstance(value, str) else None

    @property
    def uavs(self) -> list[str]:
        """The names of the UAVs, in fleet order."""
        try:
            return [str(uav["name"]) for uav in self._value("uavs", list)]
        except (KeyError, TypeError):
            raise DamagedError(f"{self.path / 'result.json'}:1: each entry of uavs must have a name") from None

    @property
    def sim_time_s(self) -> float:
        """Simulated time of the run [s]; NaN if it is unknown."""
        return self._number("sim_time_s")

    # -- tables -------------------------------------------------------------------------------------------------------

    def table(self, name: str) -> Array:
        """One of the tables below, by its name."""
        if not isinstance(name, str):
            raise InputError(f"the name of a table is a text, not {name!r:.80}")
        if name not in self._tables:
            self._tables[name] = self._read_table(name)
        return self._tables[name]

    def _read_table(self, name: str) -> Array:
        if name == "links":
            return self._make_links()
        if name == "digests":
            uavs = "|".join(map(re.escape, self.uavs))
            return read_wide_table(self.path, columns.DIGESTS, 2, f"({uavs})\\.({'|'.join(columns.DIGESTS_OF_A_UAV)})")
        if name not in columns.RUN_TABLES:
            names = ", ".join([*columns.RUN_TABLES, "links"])
            raise KeyError(f"a run has no table {name!r}; it has {names}")
        table = columns.RUN_TABLES[name]
        # Skein writes this file only if a link lost or delayed a capture message; `self.result` raises if the folder
        # has no results.
        if name == "capture_messages" and not (self.path / table.file).exists() and self.result:
            return np.empty(0, [(c.name, "U1" if c.kind == "text" else columns.KINDS[c.kind]) for c in table.columns])
        return read_table(self.path, table)

    def frame(self, name: str) -> pandas.DataFrame:
        """A copy of one of the tables below as a pandas frame."""
        return frame_of(self.table(name))

    @property
    def points(self) -> Array:
        """score.csv: every interest point and its delivered score."""
        return self.table("points")

    @property
    def captures(self) -> Array:
        """captures.csv: a row for each point of each capture."""
        return self.table("captures")

    @property
    def losses(self) -> Array:
        """losses.csv: a row for each attainable point: its score, its attainable score, and the cause of its loss."""
        return self.table("losses")

    @property
    def work(self) -> Array:
        """work.csv: a row for each UAV and second: whether the UAV had work, and how much of it the UAV did."""
        return self.table("work")

    @property
    def timeline(self) -> Array:
        """score_timeline.csv: the delivered score whenever it changed."""
        return self.table("timeline")

    @property
    def trajectories(self) -> Array:
        """trajectories.csv: pose, velocity and gimbal of every UAV, ten times per simulated second; in runs with
        batteries also their `charge`."""
        return self.table("trajectories")

    @property
    def tracking(self) -> Array:
        """tracking.csv: histogram of the distances between UAVs and their setpoints."""
        return self.table("tracking")

    @property
    def events(self) -> Array:
        """events.csv: when programs joined and left, links opened and closed, and captures were taken and
        acknowledged."""
        return self.table("events")

    @property
    def activity(self) -> Array:
        """activity.csv: what each UAV did and why, as its program reported."""
        return self.table("activity")

    @property
    def capture_messages(self) -> Array:
        """capture_messages.csv: the messages with captures that faulty links lost or delayed. Often empty."""
        return self.table("capture_messages")

    @property
    def digests(self) -> Array:
        """digests.csv: a row for each step, with the running digest and a hash of each part of the state."""
        return self.table("digests")

    @property
    def links(self) -> Array:
        """Intervals in which a radio link was open: sender `a`, receiver `b`, from `from_s` to `to_s` [s]. If a
        link is still open at the end of the run, its `to_s` is that end."""
        return self.table("links")

    def hand(self, uav: str) -> Array:
        """hand-UAV.csv: the commands of the pilot who flew this UAV by hand."""
        if uav not in self.uavs:
            raise KeyError(f"there is no UAV {uav!r}; there are {', '.join(self.uavs)}")
        return read_table(self.path, columns.HAND, columns.HAND.file.format(uav=uav))

    def _make_links(self) -> Array:
        begun: dict[tuple[str, str], float] = {}
        links: list[tuple[str, str, float, float]] = []
        events = self.events
        for row in events[np.isin(events["event"], ["link_up", "link_down"])]:
            link = (str(row["subject"]), str(row["object"]))
            if (row["event"] == "link_up") == (link in begun):
                raise DamagedError(f"{self.path / 'events.csv'}: at {row['time_s']} s there is a second {row['event']} "
                                   f"in a row from {link[0]} to {link[1]}")
            if row["event"] == "link_up":
                begun[link] = float(row["time_s"])
            else:
                links.append((*link, begun.pop(link), float(row["time_s"])))
        links.extend((*link, from_s, self.sim_time_s) for link, from_s in begun.items())
        links.sort(key=lambda link: (link[2], link[0], link[1]))
        longest = max((len(name) for link in links for name in link[:2]), default=1)
        table = np.array(links, [("a", f"U{longest}"), ("b", f"U{longest}"), ("from_s", "f8"), ("to_s", "f8")])
        table.flags.writeable = False
        return table

    # -- derived from the tables --------------------------------------------------------------------------------------

    @property
    def score_losses(self) -> dict[str, float]:
        """The lost score by cause. The sum is the attainable score minus `score` (docs/results.md, Losses)."""
        losses = self.result.get("losses")
        if not isinstance(losses, dict):
            raise MissingError(f"{self.path / 'result.json'} has no losses: {columns.LOSSES.missing}")
        try:
            return {cause: float(part["score"]) for cause, part in losses.items()}
        except (KeyError, TypeError, ValueError):
            raise DamagedError(f"{self.path / 'result.json'}:1: losses must give a score for each cause, not "
                               f"{losses!r:.60}") from None

    def earned(self) -> Array:
        """The earned score over time (columns `time_s` and `score`): of all captures, delivered or not, of UAVs that
        did not collide."""
        captures = self.captures
        good = captures[(captures["q"] >= 0.2) & (captures["reason"] != "uav collided")]
        good = good[np.argsort(good["time_s"], kind="stable")]
        _, points = np.unique(good["point"], return_inverse=True)  # indices, because a damaged table may name any point
        best = np.zeros(len(good))
        gains = np.zeros(len(good))
        for i, (point, quality) in enumerate(zip(points, good["q"])):
            gains[i] = max(quality - best[point], 0.0)
            best[point] += gains[i]
        rows = gains > 0.0
        table = np.empty(int(rows.sum()) + 1, [("time_s", "f8"), ("score", "f8")])
        table[0] = (0.0, 0.0)
        table["time_s"][1:] = good["time_s"][rows]
        table["score"][1:] = np.cumsum(gains[rows])
        return table


def frame_of(table: Array) -> pandas.DataFrame:
    """A copy of a structured array as a pandas frame; texts become `str` objects."""
    try:
        import pandas
    except ImportError:
        raise missing_package("pandas") from None
    assert table.dtype.names is not None
    return pandas.DataFrame({name: table[name].astype(object) if table[name].dtype.kind == "U" else table[name].copy()
                             for name in table.dtype.names})
