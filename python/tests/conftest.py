"""Code that the tests share: the import of this checkout's package, short flights, and plots without a window.

The variable SKEIN, which CTest sets, names the launcher; without it, the tests use this checkout's.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

os.environ["MPLBACKEND"] = "Agg"
os.environ.pop("SKEIN_DURATION", None)
ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "python"))

import skein  # noqa: E402


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Keeps every SKEIN_TURNS-th test, a different share at each commit (SKEIN_TURN; without it all run)."""
    turn, turns = os.environ.get("SKEIN_TURN"), int(os.environ.get("SKEIN_TURNS", "1"))
    if turn is None:
        return
    first = -int(turn) % turns
    chosen = items[first::turns]
    config.hook.pytest_deselected(items=[item for number, item in enumerate(items) if number % turns != first])
    items[:] = chosen


@pytest.fixture(scope="session")
def root() -> Path:
    return ROOT


@pytest.fixture(scope="session")
def faults(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fault file: links lose messages, and a UAV has no radio for a while and at the end."""
    file = tmp_path_factory.mktemp("faults") / "faults.yaml"
    file.write_text("faults:\n"
                    "  - {at_s: 0, until_s: 45, link: {loss: 0.3}}\n"
                    "  - {at_s: 20, until_s: 21, blackout: raffles}\n"
                    "  - {at_s: 35, blackout: raffles}\n")
    return file


@pytest.fixture(scope="session")
def flown(tmp_path_factory: pytest.TempPathFactory, faults: Path) -> skein.Run:
    """A flight with captures, losses and faults."""
    return skein.run("towers", planner="patrol", seed=2, one_process=True, duration=45, faults=faults,
                     out=tmp_path_factory.mktemp("flown") / "run")


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> skein.Study:
    """A study of two planners with five seeds, which suffice for an interval."""
    return skein.compare(["patrol", "kios:voxel_m=4,lanes=3"], seeds=range(5), duration=3,
                         out=tmp_path_factory.mktemp("flown") / "study")


@pytest.fixture(scope="session", autouse=True)
def _leave_nothing(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Deletes all results after the tests, because they need much space; after a failure they stay."""
    yield
    if not request.session.testsfailed:
        shutil.rmtree(tmp_path_factory.getbasetemp(), ignore_errors=True)
