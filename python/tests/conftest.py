"""What the tests share: the package of this checkout, short flights, and pictures that nobody looks at.

The launcher is the one that SKEIN names, as CTest sets it, else this checkout's.
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


@pytest.fixture(scope="session")
def root() -> Path:
    return ROOT


@pytest.fixture(scope="session")
def faults(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Links that lose messages, and a UAV that is cut off."""
    file = tmp_path_factory.mktemp("faults") / "faults.yaml"
    file.write_text("faults:\n"
                    "  - {at_s: 0, until_s: 45, link: {loss: 0.3}}\n"
                    "  - {at_s: 35, until_s: 40, blackout: raffles}\n")
    return file


@pytest.fixture(scope="session")
def flown(tmp_path_factory: pytest.TempPathFactory, faults: Path) -> skein.Run:
    """A flight with captures, losses and faults."""
    return skein.run("towers", planner="patrol", seed=2, one_process=True, duration=45, faults=faults,
                     out=tmp_path_factory.mktemp("flown") / "run")


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> skein.Study:
    """Two planners, five seeds: enough for an interval."""
    return skein.compare(["patrol", "kios:voxel_m=4,lanes=3"], seeds=range(5), duration=3,
                         out=tmp_path_factory.mktemp("flown") / "study")


@pytest.fixture(scope="session", autouse=True)
def _leave_nothing(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Flights take room; what a test that failed has flown stays."""
    yield
    if not request.session.testsfailed:
        shutil.rmtree(tmp_path_factory.getbasetemp(), ignore_errors=True)
