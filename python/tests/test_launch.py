"""How skein.run() builds the command line, finds the launcher, and turns exit codes into exceptions."""

from __future__ import annotations

import os
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import skein
from skein.launch import option_arguments


def launcher_that(folder: Path, *lines: str) -> Path:
    """Writes a shell script that replaces the launcher."""
    file = folder / "launcher"
    file.write_text("#!/bin/sh\n" + "\n".join(lines) + "\n")
    file.chmod(0o755)
    return file


def test_options_are_those_of_the_command_line() -> None:
    words = option_arguments({"planner": "kios:voxel_m=4", "seed": np.int64(3), "one_process": True, "native": False,
                              "duration": 60, "stop_at": np.float64(12.5), "faults": Path("a b/c.yaml"), "agent": None,
                              "log": ["jurong=debug", "gcs=info"], "keep_maps": np.True_, "record": "all"})
    assert words == ["--planner=kios:voxel_m=4", "--seed=3", "--one-process", "--duration=60", "--stop-at=12.5",
                     "--faults=a b/c.yaml", "--log=jurong=debug", "--log=gcs=info", "--keep-maps", "--record=all"]
    assert option_arguments({"seeds": range(1, 4), "planners": ["a", "b:x=1,y=2"], "scenarios": ("s", "t")}) == [
        "--seeds=1,2,3", "--planners=a", "--planners=b:x=1,y=2", "--scenarios=s", "--scenarios=t"]


def test_drawn_numbers_arrive_as_they_are() -> None:
    draw = random.Random(1)
    for _ in range(300):
        whole, broken = draw.randrange(1 << 64), draw.uniform(0, 10.0 ** draw.randrange(-6, 6))
        seed, duration = option_arguments({"seed": whole, "duration": broken})
        assert int(seed.removeprefix("--seed=")) == whole
        assert float(duration.removeprefix("--duration=")) == broken


@pytest.mark.parametrize("value", [{"jurong": "kios"}, object(), [["a"]], b"a", 1j, float,
                                   [np.zeros(2)], np.array("a")])
def test_a_value_of_a_wrong_type_is_refused(value: object) -> None:
    with pytest.raises(skein.InputError, match="planner"):
        option_arguments({"planner": value})


@pytest.mark.parametrize("scenario", ["--help", "", "-v", 5, None, b"towers"])
def test_a_scenario_that_is_neither_a_name_nor_a_path_is_refused(scenario: Any) -> None:
    with pytest.raises(skein.InputError, match="scenario must be a name or a path"):
        skein.run(scenario)


def test_a_value_that_is_not_a_path_is_refused() -> None:
    for call in (skein.Run, skein.Study, skein.find_launcher):
        for wrong in (5, b"a", ["a"]):
            with pytest.raises(skein.InputError, match="must be a path"):
                call(wrong)  # type: ignore[arg-type]


def test_the_launcher_is_found_by_argument_then_variable_then_path(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    for folder in (one, two):
        folder.mkdir()
        launcher_that(folder, "exit 0").rename(folder / "skein")
    monkeypatch.setenv("SKEIN", str(one / "skein"))
    assert skein.find_launcher(two / "skein") == str(two / "skein")
    assert skein.find_launcher() == str(one / "skein")
    monkeypatch.setenv("SKEIN", str(tmp_path / "none"))
    with pytest.raises(skein.InputError, match="SKEIN"):
        skein.find_launcher()
    monkeypatch.delenv("SKEIN")
    assert skein.find_launcher() == str(Path(skein.__file__).absolute().parents[2] / "skein"), "not this checkout's"
    monkeypatch.setattr("skein.launch.__file__", str(tmp_path / "lib" / "skein" / "launch.py"))
    monkeypatch.setenv("PATH", str(two))
    assert skein.find_launcher() == str(two / "skein"), "it is not the launcher on the PATH"
    monkeypatch.setenv("PATH", "")
    with pytest.raises(skein.InputError, match="install"):
        skein.find_launcher()


@pytest.mark.parametrize("code, kind", [(1, skein.CheckError), (2, skein.InputError), (3, skein.ProcessError),
                                        (130, skein.Interrupted), (7, skein.Error)])
def test_exit_codes_are_exceptions(tmp_path: Path, code: int, kind: type[skein.Error]) -> None:
    program = launcher_that(tmp_path, "echo 'simulated 3 s, mission 1 of 2 s' >&2", f"echo 'code {code}: alas' >&2",
                            f"echo 'results   {tmp_path}'", f"exit {code}")
    with pytest.raises(skein.Error) as caught:
        skein.run(launcher=program)
    assert type(caught.value) is kind
    assert str(caught.value) == f"code {code}: alas", "the message contains lines of progress"
    assert caught.value.exit_code == code
    assert caught.value.run is not None and caught.value.run.path == tmp_path


def test_a_launcher_that_dies_or_cannot_start_is_reported(tmp_path: Path) -> None:
    with pytest.raises(skein.Error, match="signal 9\nit was here") as caught:
        skein.run(launcher=launcher_that(tmp_path, "echo it was here >&2", "kill -9 $$"))
    assert caught.value.exit_code == -9 and caught.value.run is None
    with pytest.raises(skein.Error, match="no results folder.*\n.*Usage"):
        skein.run(launcher=launcher_that(tmp_path, "echo Usage"))
    with pytest.raises(skein.InputError, match="no program"):
        skein.run(launcher=tmp_path / "none")
    with pytest.raises(skein.InputError, match="cannot be started"):
        skein.run("nul\0", launcher=launcher_that(tmp_path, "exit 0"))


def test_a_run_prints_nothing_unless_it_is_verbose(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    program = launcher_that(tmp_path, "echo working >&2", f"echo 'results   {tmp_path}'")
    assert skein.run(launcher=program).path == tmp_path
    assert capfd.readouterr() == ("", "")
    skein.run(launcher=program, verbose=True)
    assert capfd.readouterr() == (f"results   {tmp_path}\n", "working\n")


def test_a_character_that_arrives_in_two_parts_is_printed_as_one(
        tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    program, read = launcher_that(tmp_path, f"echo 'results   {tmp_path}'", "printf 'é€\\303' >&2"), os.read
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("os.read", lambda descriptor, _size: read(descriptor, 1))
        skein.run(launcher=program, verbose=True)
    assert capfd.readouterr().err == "é€\ufffd"


def test_wrong_input_says_what_would_be_right(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(skein.InputError, match="towers") as caught:
        skein.run("twoers")
    assert caught.value.exit_code == 2
    with pytest.raises(skein.InputError, match="--durations=3"):
        skein.run("towers", durations=3)
    with pytest.raises(skein.InputError, match="partol.*patrol"):
        skein.compare(["partol"], duration=3)
    assert list(tmp_path.iterdir()) == [], "a refused call has left files"
