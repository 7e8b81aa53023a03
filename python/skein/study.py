"""Studies, which compare planners: `skein.compare()` and `skein.contest()` fly them, `Study` reads them."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import columns
from .errors import Error, InputError
from .launch import Finished, fly, option_arguments
from .run import Run, existing_folder, frame_of, read_json
from .tables import Array, read_study_table, read_wide_table

if TYPE_CHECKING:
    import pandas


def compare(planners: list[str] | str, *, launcher: str | os.PathLike[str] | None = None, verbose: bool = False,
            **options: Any) -> Study:
    """Compares planners, as `skein compare` does, and returns the study.

    Every option of `skein compare --help` is a keyword: `scenarios=["towers", "sail"]`, `seeds="0-4"` or `range(5)`,
    `duration=60`, `jobs=2`. If the study exists already, this continues it and repeats no flight.

    Raises the same exceptions as `skein.run`; a `ProcessError` or `CheckError` (`require=...`) has the attribute
    `study`.
    """
    return _fly("compare", planners, launcher, verbose, options)


def contest(planners: list[str] | str, *, launcher: str | os.PathLike[str] | None = None, verbose: bool = False,
            **options: Any) -> Study:
    """Flies planners by the protocol of the contest, as `skein contest` does: `tests=5`, `rank="median"`. Returns and
    raises the same as `compare`."""
    return _fly("contest", planners, launcher, verbose, options)


def _fly(command: str, planners: list[str] | str, launcher: str | os.PathLike[str] | None, verbose: bool,
         options: dict[str, Any]) -> Study:
    words = [command, *option_arguments({"planners": planners, **options})]
    return fly(words, study_folder, Study, "study", launcher=launcher, verbose=verbose)


def study_folder(finished: Finished) -> Path | None:
    """The study's folder, from the launcher's output."""
    named = re.findall(r"^report: (.+)/report\.html$", finished.out, re.MULTILINE)
    named = named or re.findall(r"^[0-9]+ flights, results in (.+)$", finished.err, re.MULTILINE)
    return Path(named[-1]) if named else None


class Study:
    """The folder of a comparison or a contest. It reads a file when you first ask for its contents.

    The tables are read-only structured arrays of NumPy, with the columns of docs/studies.md;
    `study.frame("flights")` returns the same table as a pandas frame.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = existing_folder(path)
        self._tables: dict[str, Array] = {}
        self._settings: dict[str, Any] | None = None

    def __repr__(self) -> str:
        try:
            what = f"{len(self.flights)} flights of {', '.join(self.planners)} in {', '.join(self.scenarios)}"
        except Error as error:
            what = str(error)
        return f"<skein.Study {self.path}: {what}>"

    @property
    def settings(self) -> dict[str, Any]:
        """study.json: all settings on which the results of the study depend."""
        if self._settings is None:
            self._settings = read_json(self.path / "study.json", "it is not a folder of a study")
        return self._settings

    def table(self, name: str) -> Array:
        """One of the tables below, by its name."""
        if not isinstance(name, str):
            raise InputError(f"the name of a table is a text, not {name!r:.80}")
        if name not in self._tables:
            if name not in columns.STUDY_TABLES:
                raise KeyError(f"a study has no table {name!r}; it has {', '.join(columns.STUDY_TABLES)}")
            table = columns.STUDY_TABLES[name]
            self._tables[name] = (read_wide_table(self.path, table, 3, r"test_[0-9]+") if name == "totals" else
                                  read_study_table(self.path, table))
        return self._tables[name]

    def frame(self, name: str) -> pandas.DataFrame:
        """A copy of one of the tables below as a pandas frame."""
        return frame_of(self.table(name))

    @property
    def flights(self) -> Array:
        """flights.csv: a row for each flight, with all figures."""
        return self.table("flights")

    @property
    def summary(self) -> Array:
        """summary.csv: a row for each scene and planner, with median, least and greatest value over the seeds."""
        return self.table("summary")

    @property
    def pairs(self) -> Array:
        """pairs.csv: paired differences (same seed) of scores and other figures of planners: median, interval and p."""
        return self.table("pairs")

    @property
    def totals(self) -> Array:
        """totals.csv, which only a contest has: a row for each planner, in order of rank."""
        return self.table("totals")

    @property
    def planners(self) -> list[str]:
        """Names of the planners, in the order in which the study named them."""
        return list(dict.fromkeys(map(str, self.flights["planner"])))

    @property
    def scenarios(self) -> list[str]:
        """Names of the scenarios, in the order in which the study named them."""
        return list(dict.fromkeys(map(str, self.flights["scenario"])))

    def run(self, number: int) -> Run:
        """The run of row `number` of `flights`."""
        if isinstance(number, bool) or not isinstance(number, (int, np.integer)):
            raise InputError(f"number must be the whole number of a row, not {number!r:.80}")
        return Run(self.path / str(self.flights[number]["folder"]))

    def runs(self, **where: Any) -> list[Run]:
        """The runs of all rows of `flights` whose columns have these values: `planner="kios"`, `seed=3`."""
        flights = self.flights
        for name in where:
            if name not in columns.FLIGHTS.names:
                raise KeyError(f"flights have no column {name!r}; they have {', '.join(columns.FLIGHTS.names)}")
        return [self.run(i) for i, flight in enumerate(flights)
                if all(flight[name] == value for name, value in where.items())]
