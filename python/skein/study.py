"""Studies: planners side by side, flown by `skein.compare()` or `skein.contest()`, or read by `Study`."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import columns
from .errors import Error
from .launch import Finished, fly, option_arguments
from .run import Run, existing_folder, frame_of, read_json
from .tables import Array, read_study_table, read_wide_table

if TYPE_CHECKING:
    import pandas


def compare(planners: list[str] | str, *, launcher: str | os.PathLike[str] | None = None, verbose: bool = False,
            **options: Any) -> Study:
    """Flies planners side by side, as `skein compare` does, and returns the study.

    Every option of `skein compare --help` is a keyword: `scenarios=["towers", "sail"]`, `seeds="0-4"` or `range(5)`,
    `duration=60`, `jobs=2`. A study that is there already goes on: what was flown is not flown again.

    Raises as `skein.run` does; `ProcessError` and `CheckError` (of `require=...`) have the study in their `study`.
    """
    return _fly("compare", planners, launcher, verbose, options)


def contest(planners: list[str] | str, *, launcher: str | os.PathLike[str] | None = None, verbose: bool = False,
            **options: Any) -> Study:
    """Flies the contest's protocol, as `skein contest` does: `tests=5`, `rank="median"`. See `compare`."""
    return _fly("contest", planners, launcher, verbose, options)


def _fly(command: str, planners: list[str] | str, launcher: str | os.PathLike[str] | None, verbose: bool,
         options: dict[str, Any]) -> Study:
    words = [command, *option_arguments({"planners": planners, **options})]
    return fly(words, study_folder, Study, "study", launcher=launcher, verbose=verbose)


def study_folder(finished: Finished) -> Path | None:
    """As the launcher named it."""
    named = re.findall(r"^report: (.+)/report\.html$", finished.out, re.MULTILINE)
    named = named or re.findall(r"^[0-9]+ flights, results in (.+)$", finished.err, re.MULTILINE)
    return Path(named[-1]) if named else None


class Study:
    """The folder of a comparison or a contest. A file is read when it is asked for first.

    The tables are structured arrays of NumPy, read only, with the columns of docs/how-to-compare-planners.md;
    `study.frame("flights")` is the same for pandas.
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
        """study.json: all that the results of the study depend on."""
        if self._settings is None:
            self._settings = read_json(self.path / "study.json", "it is no folder of a study")
        return self._settings

    def table(self, name: str) -> Array:
        """One of the tables below, by its name."""
        if name not in self._tables:
            if name not in columns.STUDY_TABLES:
                raise KeyError(f"a study has no table {name!r}; it has {', '.join(columns.STUDY_TABLES)}")
            table = columns.STUDY_TABLES[name]
            self._tables[name] = (read_wide_table(self.path, table, 3, r"test_[0-9]+") if name == "totals" else
                                  read_study_table(self.path, table))
        return self._tables[name]

    def frame(self, name: str) -> pandas.DataFrame:
        """One of the tables below as a pandas frame of its own."""
        return frame_of(self.table(name))

    @property
    def flights(self) -> Array:
        """flights.csv: a row for each flight, with all figures."""
        return self.table("flights")

    @property
    def summary(self) -> Array:
        """summary.csv: a row for each scene and planner: median, least and greatest over the seeds."""
        return self.table("summary")

    @property
    def pairs(self) -> Array:
        """pairs.csv: differences of planners' scores and other figures with the same seed: median, interval and p."""
        return self.table("pairs")

    @property
    def totals(self) -> Array:
        """totals.csv, of a contest: a row for each planner in order of rank."""
        return self.table("totals")

    @property
    def planners(self) -> list[str]:
        """In the order in which they were named."""
        return list(dict.fromkeys(map(str, self.flights["planner"])))

    @property
    def scenarios(self) -> list[str]:
        """Scenes, in the order in which they were named."""
        return list(dict.fromkeys(map(str, self.flights["scenario"])))

    def run(self, number: int) -> Run:
        """The flight of a row of `flights`."""
        return Run(self.path / str(self.flights[number]["folder"]))

    def runs(self, **where: Any) -> list[Run]:
        """The flights of all rows of `flights` whose columns have these values: `planner="kios"`, `seed=3`."""
        flights = self.flights
        for name in where:
            if name not in columns.FLIGHTS.names:
                raise KeyError(f"flights have no column {name!r}; they have {', '.join(columns.FLIGHTS.names)}")
        return [self.run(i) for i, flight in enumerate(flights)
                if all(flight[name] == value for name, value in where.items())]
