"""Plots show the contents of the tables, and their files are the same each time."""

from __future__ import annotations

import json
import subprocess
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import skein
from skein import plots

OF_RUNS = [plots.score, plots.losses, plots.quality, plots.delivery]
OF_A_RUN = [*OF_RUNS, plots.map, plots.activity, plots.links, plots.links_over_time]
OF_A_STUDY = [plots.scores, plots.pairs, plots.curves]


@pytest.fixture(autouse=True)
def _close() -> Any:
    yield
    plt.close("all")


def same_files(draw: Callable[[], Any], folder: Path) -> None:
    for suffix in ("svg", "pdf", "png"):
        for name in ("one", "two"):
            plots.save(draw(), folder / f"{name}.{suffix}")
        data = (folder / f"one.{suffix}").read_bytes()
        assert data == (folder / f"two.{suffix}").read_bytes() and len(data) > 3000, suffix


@pytest.mark.parametrize("draw", OF_A_RUN, ids=lambda draw: draw.__name__)
def test_a_plot_of_a_run_draws_into_given_axes_and_saves_the_same_bytes(
        flown: skein.Run, tmp_path: Path, draw: Any) -> None:
    _, ax = plt.subplots()
    assert draw(flown, ax) is ax
    assert ax.has_data() or ax.images
    own = draw(flown)
    assert own.figure is not ax.figure and own.figure.get_size_inches()[0] == 3.5
    same_files(lambda: draw(flown), tmp_path)
    assert plt.rcParams["font.size"] == plt.rcParamsDefault["font.size"], "a plot changed the user's settings"


@pytest.mark.parametrize("draw", OF_A_STUDY, ids=lambda draw: draw.__name__)
def test_a_plot_of_a_study_draws_into_given_axes_and_saves_the_same_bytes(
        study: skein.Study, tmp_path: Path, draw: Any) -> None:
    _, ax = plt.subplots()
    assert draw(study, ax) is ax
    same_files(lambda: draw(study), tmp_path)


@pytest.mark.parametrize("draw", OF_RUNS, ids=lambda draw: draw.__name__)
def test_labels_of_several_runs_name_what_differs(study: skein.Study, draw: Any) -> None:
    def texts(runs: Any, **options: Any) -> str:
        ax = draw(runs, **options)
        legend = ax.get_legend().get_texts() if ax.get_legend() else []
        return " | ".join(text.get_text() for text in [*ax.get_yticklabels(), *legend])

    assert "seed 0" in texts(study.runs(planner="patrol")) and "patrol" not in texts(study.runs(planner="patrol"))
    assert "kios" in texts(study.runs(seed=1)) and "seed" not in texts(study.runs(seed=1))
    assert "first" in texts(study.runs(seed=1), labels=["first", "second"])
    with pytest.raises(ValueError, match="1 labels for 2 runs"):
        draw(study.runs(seed=1), labels=["first"])
    with pytest.raises(ValueError, match="no run"):
        draw([])


def test_the_curve_of_the_score_ends_at_the_delivered_score(flown: skein.Run) -> None:
    ax = plots.score(flown)
    delivered, earned = ax.get_lines()
    assert delivered.get_ydata()[-1] == pytest.approx(flown.score, abs=1e-6)
    assert earned.get_ydata()[-1] == pytest.approx(flown.result["score_earned"], abs=1e-6)
    assert delivered.get_xdata()[-1] == earned.get_xdata()[-1] == flown.sim_time_s
    spans = [patch.get_xy()[:, 0] for patch in ax.patches]
    ends = [flown.sim_time_s if fault["ended_step"] is None else fault["ended_step"] * 0.05
            for fault in flown.result["faults"]]
    assert [(span.min(), span.max()) for span in spans] == [
        (pytest.approx(fault["began_step"] * 0.05), pytest.approx(end))
        for fault, end in zip(flown.result["faults"], ends, strict=True)]
    assert len(plots.score(flown, earned=False).get_lines()) == 1


def test_the_curve_of_delivery_ends_at_the_share_that_was_delivered(flown: skein.Run) -> None:
    (line,) = plots.delivery(flown).get_lines()
    frame = flown.frame("captures").drop_duplicates(["uav", "capture"])
    assert line.get_ydata()[-1] == pytest.approx(100.0 * frame["delivered_at_s"].notna().mean())
    assert line.get_ydata()[-1] < 100.0, "all captures were delivered despite the blackout"
    assert line.get_xdata()[-1] == pytest.approx((frame["delivered_at_s"] - frame["time_s"]).max())
    assert line.get_xdata()[-1] > 1.0


def test_curves_end_at_the_median_of_the_final_scores(study: skein.Study) -> None:
    for planner, line in zip(study.planners, plots.curves(study).get_lines()):
        finals = [run.score for run in study.runs(planner=planner)]
        assert line.get_ydata()[-1] == pytest.approx(np.median(finals), abs=1e-6)
        assert line.get_label() == planner
    with pytest.raises(ValueError, match="which scenario.* towers, not 'sail'"):
        plots.curves(study, scenario="sail")


def study_of(folder: Path, timelines: dict[int, list[tuple[int, int]]]) -> skein.Study:
    """A study of one planner with these entries (time, score) of score_timeline.csv by seed; all flights last 6 s."""
    header = ",".join(skein.STUDY_TABLES["flights"].names)
    lines = [f"s,p,{seed}{',' * (header.count(',') - 2)}{seed}" for seed in timelines]
    (folder / "flights.csv").write_text("\n".join([header, *lines]) + "\n")
    for seed, changes in timelines.items():
        (folder / str(seed)).mkdir()
        (folder / str(seed) / "result.json").write_text('{"sim_time_s": 6}')
        (folder / str(seed) / "score_timeline.csv").write_text(
            "time_s,points,score\n" + "".join(f"{time_s},1,{score}\n" for time_s, score in changes))
    return skein.Study(folder)


def test_curves_have_the_median_at_any_time(tmp_path: Path) -> None:
    study = study_of(tmp_path, {0: [(0, 0), (2, 5)], 1: [(0, 0), (1, 1), (4, 2)], 2: [(0, 0), (3, 9)]})
    (line,) = plots.curves(study).get_lines()
    assert [(x, y) for x, y in zip(*line.get_data())] == [(0, 0), (1, 0), (2, 1), (3, 5), (4, 5), (6, 5)]


def test_a_flight_has_no_score_before_its_first_entry(tmp_path: Path) -> None:
    study = study_of(tmp_path, {0: [], 1: [(1, 4)], 2: [(3, 9)]})
    (line,) = plots.curves(study).get_lines()
    assert [(x, y) for x, y in zip(*line.get_data())] == [(1, 0), (3, 4), (6, 4)]


def test_the_parts_of_a_loss_add_up(flown: skein.Run) -> None:
    ax = plots.losses([flown, flown])
    lost = flown.score_losses
    bars = [bar for bar in ax.patches if bar.get_y() < 0.0]
    parts = [bar.get_width() for bar in bars]
    assert [bar.get_x() for bar in bars] == pytest.approx([sum(parts[:i]) for i in range(len(parts))])
    assert parts[0] == pytest.approx(flown.score)
    assert sum(parts[1:]) == pytest.approx(sum(size for size in lost.values() if size > 0.0))
    # The line is at the attainable score, which is less than the sum of the bars if points scored above the estimate.
    assert ax.get_lines()[0].get_xdata()[0] == pytest.approx(flown.result["attainable"]["score"])
    shown = {text.get_text() for text in ax.get_legend().get_texts()}
    assert len(shown) == 1 + sum(size > 0.0 for size in lost.values())


def test_the_picture_of_links_shows_shares_of_the_time(flown: skein.Run) -> None:
    ax = plots.links(flown)
    nodes = [text.get_text() for text in ax.get_yticklabels()]
    assert nodes == ["gcs", *flown.uavs]
    shares = {(nodes[int(y)], nodes[int(x)]): int(text.get_text()) for text in ax.texts
              for x, y in [text.get_position()]}
    assert len(shares) == 30
    lengths = dict.fromkeys(shares, 0.0)
    for row in flown.links:
        lengths[(str(row["a"]), str(row["b"]))] += row["to_s"] - row["from_s"]
    assert shares == {link: round(100.0 * length / flown.sim_time_s) for link, length in lengths.items()}
    assert min(shares.values()) < 95, "all links were open for most of the time despite the blackout"
    linked = sum(bar.get_width() for bar in plots.links_over_time(flown).patches if round(bar.get_y() + 0.3) == 1)
    direct = lengths[("raffles", "gcs")]
    assert direct <= linked + 1e-9 < flown.sim_time_s


def test_the_lanes_show_the_reported_activities(flown: skein.Run) -> None:
    ax = plots.activity(flown)
    for lane, uav in enumerate(flown.uavs):
        bars = [bar for bar in ax.patches if abs(bar.get_y() + 0.26 - lane - 0.08) < 0.01]
        said = flown.activity[flown.activity["uav"] == uav]
        assert [bar.get_x() for bar in bars] == list(said["time_s"])
        assert sum(bar.get_width() for bar in bars) == pytest.approx(flown.sim_time_s - said["time_s"][0])


def test_the_histogram_has_every_point(flown: skein.Run) -> None:
    assert sum(bar.get_height() for bar in plots.quality(flown).patches) == (flown.points["score"] > 0).sum()


def test_words_and_colours_are_those_of_the_report(root: Path) -> None:
    style, causes = (root / "report/run_style.cpp").read_text(), (root / "results/causes.hpp").read_text()
    for i, (cause, (colour, words)) in enumerate(plots.look.CAUSES.items()):
        assert f"--k{i}: {colour};" in style
        assert f'"{cause}", "{words}"' in causes
    base = (root / "report/style.cpp").read_text()
    for letter, name in (("c", "PLANNERS"), ("t", "TRACKS"), ("q", "QUALITIES")):
        for i, colour in enumerate(getattr(plots.look, name)):
            assert f"--{letter}{i}: {colour};" in base
    modes = (root / "web/src/modes.js").read_text()
    for _, words, begins in plots.flight._MODES:
        assert f"text: '{words}'" in modes
        assert all(f"'{begin}'" in modes for begin in begins)


@pytest.mark.parametrize("sim_time_s", ["0", "null", "45"])
@pytest.mark.parametrize("draw", [plots.score, plots.activity, plots.links, plots.links_over_time],
                         ids=lambda draw: draw.__name__)
def test_an_aborted_run_is_drawn(flown: skein.Run, tmp_path: Path, draw: Any, sim_time_s: str) -> None:
    for file in flown.path.glob("*.csv"):  # tables without rows
        (tmp_path / file.name).write_text(file.read_text().splitlines()[0] + "\n")
    result = json.loads((flown.path / "result.json").read_text())
    del result["checksum"]
    result["sim_time_s"] = json.loads(sim_time_s)
    (tmp_path / "result.json").write_text(json.dumps(result))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ax = draw(skein.Run(tmp_path))
        plots.save(ax, tmp_path / "drawn.svg")
    assert ax.get_xlim()[1] > ax.get_xlim()[0]
    assert "nan" not in [text.get_text() for text in ax.texts], "the plot labels an unknown value"


def test_a_study_without_flights_that_count_is_drawn(study: skein.Study, tmp_path: Path) -> None:
    for file in study.path.glob("*.csv"):
        lines = file.read_text().splitlines()
        if file.name == "flights.csv":  # the second planner has no result
            empty = "," * (lines[0].count(",") - 4)
            lines = [lines[0], *(f"towers,kios,{seed},{empty}crashed,none" for seed in (0, 1)),
                     *(line for line in lines if ",patrol,3," in line)]
        (tmp_path / file.name).write_text("\n".join(lines) + "\n")
    ax = plots.scores(skein.Study(tmp_path))
    assert len(ax.get_lines()) == 1
    assert np.isnan(skein.Study(tmp_path).flights["score"][0])


@pytest.mark.parametrize("package, use", [("matplotlib", "skein.plots.axes()"),
                                          ("pandas", "skein.Run('.').frame('events')")])
def test_a_package_that_is_not_installed_is_named(flown: skein.Run, package: str, use: str) -> None:
    code = (f"import sys; sys.path.insert(0, {str(Path(skein.__file__).parents[1])!r})\n"
            f"sys.modules[{package!r}] = None\nimport skein\n"
            f"try: {use}\nexcept skein.DependencyError as error: print(error)")
    said = subprocess.run([sys.executable, "-c", code], cwd=flown.path, capture_output=True, text=True, check=True)
    assert said.stdout == f"this needs {package}, which is not installed: apt-get install python3-{package}\n"
