"""Files and columns of the tables of a run and of a study.

docs/results.md and docs/studies.md explain the columns. A test compares both pages with this file.
"""

from __future__ import annotations

from dataclasses import dataclass

# Kinds of columns, and their types in an array. A cell may be empty only where a comment says so.
KINDS = {
    "number": "float64",
    "number?": "float64",  # empty: NaN
    "count": "int64",
    "seed": "uint64",
    "flag": "bool",  # 0 or 1 in the file
    "text": "str",  # empty: ""
}


@dataclass(frozen=True)
class Column:
    """A column: its name, its kind (a key of KINDS), and its unit ("" if it has none)."""

    name: str
    kind: str
    unit: str = ""


@dataclass(frozen=True)
class Table:
    """A table: its name in Python, its file, its columns, the reason why the file may be missing, and columns that only
    some runs have, behind the others."""

    name: str
    file: str
    columns: tuple[Column, ...]
    missing: str = "the run ended before Skein wrote the file, or the disk was full"
    optional: tuple[Column, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(column.name for column in self.columns)


def _columns(kind: str, unit: str, names: str) -> tuple[Column, ...]:
    return tuple(Column(name, kind, unit) for name in names.split())


_LAUNCHER = "the launcher was killed before the run's end, or the disk was full; `skein merge` makes some of its files"
_TIME = Column("time_s", "number", "s")
_UAV = Column("uav", "text")
_POSITION = _columns("number", "m", "x y z")

POINTS = Table("points", "score.csv", (
    *_POSITION, *_columns("number", "1", "nx ny nz score"), Column("index", "count")), _LAUNCHER)

CAPTURES = Table("captures", "captures.csv", (
    _UAV, Column("capture", "count"), Column("tick", "count", "2.5 ms"), _TIME, Column("point", "count"),
    *_columns("number", "1", "q_seen q_blur q_res q_distance q"), Column("delivered_at_s", "number?", "s"),
    Column("reason", "text")))

LOSSES = Table("losses", "losses.csv", (
    Column("index", "count"), *_POSITION, *_columns("number", "1", "estimate score"), Column("cause", "text"),
    Column("loss", "number", "1"), _UAV, Column("capture", "number?"),
    *_columns("number?", "1", "q_distance q_tilt q_blur q")),
    "only a run that was completed has it, flown without `no_oracle=True` (--no-oracle), in a scene that the oracle "
    "knows (`skein oracle SCENARIO` asks it)", optional=(Column("part", "text"),))

WORK = Table("work", "work.csv", (
    _TIME, _UAV, Column("open", "text"), Column("work", "number", "1"), Column("waits_for", "text"),
    *_columns("flag", "", "excused frozen"), Column("without_work_s", "number", "s")), _LAUNCHER)

TIMELINE = Table("timeline", "score_timeline.csv", (_TIME, Column("points", "count"), Column("score", "number", "1")))

TRAJECTORIES = Table("trajectories", "trajectories.csv", (
    _TIME, _UAV, *_POSITION, *_columns("number", "1", "qw qx qy qz"), *_columns("number", "m/s", "vx vy vz"),
    *_columns("number", "rad", "gimbal_pitch gimbal_yaw"), Column("alive", "flag"), Column("clearance", "number", "m")),
    optional=(Column("charge", "number", "1"),))

TRACKING = Table("tracking", "tracking.csv", (
    Column("vehicle", "text"), Column("speed_mps", "number", "m/s"), Column("acceleration_mps2", "number", "m/s^2"),
    Column("error_m", "number", "m"), Column("samples", "count")))

EVENTS = Table("events", "events.csv", (
    Column("step", "count"), _TIME, *_columns("text", "", "event subject object")))

ACTIVITY = Table("activity", "activity.csv", (
    Column("step", "count"), _TIME, *_columns("text", "", "uav mode"),
    *_columns("number?", "m", "goal_x goal_y goal_z"), *_columns("text", "", "waits_for no_way")))

CAPTURE_MESSAGES = Table("capture_messages", "capture_messages.csv", (
    Column("step", "count"), _UAV, Column("arrives", "number?")))

# In the file, the columns of each UAV's fields are between the first two of these columns and the last three.
DIGESTS = Table("digests", "digests.csv", (Column("k", "count"), *_columns("text", "", "digest ledger radio tally")))
DIGESTS_OF_A_UAV = ("position", "attitude", "velocity", "body_rates", "gimbal", "alive")

HAND = Table("hand", "hand-{uav}.csv", (
    *_columns("count", "", "step tick"), *_columns("number", "m/s", "ahead left up"),
    *_columns("number", "rad/s", "yaw_rate gimbal_pitch_rate gimbal_yaw_rate")),
    "no viewer flew this UAV by hand (`planner=\"UAV=hand\"` with `view=True`)")

RUN_TABLES = {table.name: table for table in (
    POINTS, CAPTURES, LOSSES, WORK, TIMELINE, TRAJECTORIES, TRACKING, EVENTS, ACTIVITY, CAPTURE_MESSAGES, DIGESTS)}

_STUDY = "the study was ended before its tables were written; the same command goes on with it"
_FIGURES = """
    score attainable_percent points_detected mean_quality greatest_share collisions frozen_uavs frozen_s without_work_s
    waiting_uavs braking_hits braking_meets ways_meet least_clearance_m least_separation_m waited_s idle_explorers_s
    idle_photographers_s distance_m planner_cpu_ms real_time_factor mission_time_s""".split()

FLIGHTS = Table("flights", "flights.csv", (
    *_columns("text", "", "scenario planner"), Column("seed", "seed"), Column("status", "text"),
    *_columns("number?", "", " ".join(_FIGURES)), Column("points_total", "number?"),
    *_columns("text", "", "digest problem folder")), _STUDY)

SUMMARY = Table("summary", "summary.csv", (
    *_columns("text", "", "scenario planner"), Column("flights", "count"),
    *(Column(f"{figure}_{what}", "number?") for figure in _FIGURES for what in ("median", "min", "max"))), _STUDY)

PAIRS = Table("pairs", "pairs.csv", (
    *_columns("text", "", "figure scenario first second"), Column("pairs", "count"),
    *_columns("number?", "", "median low high p p_holm")), _STUDY)

# In the file, a column test_N for each test follows the first three of these columns.
TOTALS = Table("totals", "totals.csv", (
    Column("place", "number?"), *_columns("text", "", "planner ranked_by"),
    *_columns("number?", "", "max median worst")),
    "only a contest has it (`skein.contest`)")

STUDY_TABLES = {table.name: table for table in (FLIGHTS, SUMMARY, PAIRS, TOTALS)}
