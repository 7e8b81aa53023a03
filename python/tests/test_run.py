"""The folder of a run: its result, its tables and their consistency, and missing files."""

from __future__ import annotations

import inspect
import shutil
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import skein
from skein import columns


def test_a_run_has_the_values_of_its_result(flown: skein.Run) -> None:
    result = flown.result
    assert (flown.scenario, flown.seed, flown.status) == ("towers", 2, "completed")
    assert flown.uavs == ["jurong", "raffles", "sentosa", "changi", "nanyang"]
    assert flown.planner == dict.fromkeys(flown.uavs, "patrol")
    assert flown.score == result["score"] > 1.0
    assert flown.digest == result["digest"] and len(result["digest"]) == 64
    assert flown.sim_time_s == result["sim_time_s"] >= 45.0
    assert len(flown.scene["points"]) == result["points_total"] == len(flown.points)
    assert f"towers, seed 2, completed: score {flown.score:.1f}" in repr(flown)


def test_the_tables_of_a_run_add_up(flown: skein.Run) -> None:
    assert flown.points["score"].sum() == pytest.approx(flown.score)
    assert flown.timeline["score"][-1] == pytest.approx(flown.score, abs=1e-6)
    assert flown.timeline["points"][-1] == flown.result["points_detected"] == (flown.points["score"] > 0).sum()
    assert flown.earned()["score"][-1] == pytest.approx(flown.result["score_earned"], abs=1e-6)
    assert (np.diff(flown.earned()["score"]) > 0).all()
    counts = flown.captures[flown.captures["reason"] == ""]
    assert counts["q"].sum() == pytest.approx(flown.score, abs=1e-6)
    losses, causes = flown.losses, flown.score_losses
    for cause, size in causes.items():
        assert losses["loss"][losses["cause"] == cause].sum() == pytest.approx(size)
    poor = losses["cause"] == "below_threshold"
    assert ((losses["part"] != "") == poor).all()
    for part, sums in flown.result["losses"]["below_threshold"]["by_part"].items():
        assert losses["loss"][losses["part"] == part].sum() == pytest.approx(sums["score"])
    assert flown.score + sum(causes.values()) == pytest.approx(flown.result["attainable"]["score"])
    assert set(flown.work["uav"]) == set(flown.trajectories["uav"]) == set(flown.uavs)
    assert flown.digests["digest"][-1] == flown.digest
    assert flown.digests.dtype.names[2] == "jurong.position"
    assert np.isnan(flown.captures["delivered_at_s"]).any(), "all captures were received"
    assert len(flown.capture_messages) > 0, "the faulty links lost no messages"


def test_losses_of_earlier_versions_have_no_parts(flown: skein.Run, tmp_path: Path) -> None:
    shutil.copy(flown.path / "result.json", tmp_path)
    lines = (flown.path / "losses.csv").read_text().splitlines()
    (tmp_path / "losses.csv").write_text("".join(line.rpartition(",")[0] + "\n" for line in lines))
    losses = skein.Run(tmp_path).losses
    assert losses.dtype.names == flown.losses.dtype.names[:-1]
    assert np.array_equal(losses["cause"], flown.losses["cause"])


def test_the_intervals_of_links_agree_with_their_events(flown: skein.Run) -> None:
    links = flown.links
    assert (links["from_s"] <= links["to_s"]).all() and (np.diff(links["from_s"]) >= 0).all()
    # After each event, the open links are those whose interval contains the time.
    up: set[tuple[str, str]] = set()
    changes = flown.events[np.isin(flown.events["event"], ["link_up", "link_down"])]
    assert len(np.unique(changes["time_s"])) > 2
    for time_s in np.unique(changes["time_s"]):
        for row in changes[changes["time_s"] == time_s]:
            (up.add if row["event"] == "link_up" else up.remove)((str(row["subject"]), str(row["object"])))
        now = links[(links["from_s"] <= time_s) & (links["to_s"] > time_s)]
        assert {(str(row["a"]), str(row["b"])) for row in now} == up
    assert set(links["to_s"][[(str(row["a"]), str(row["b"])) in up for row in links]]) >= {flown.sim_time_s}


def test_impossible_events_of_links_are_reported_as_damage(flown: skein.Run, tmp_path: Path) -> None:
    shutil.copy(flown.path / "result.json", tmp_path)
    text = (flown.path / "events.csv").read_text()
    line = next(line for line in text.splitlines() if ",link_up," in line)
    (tmp_path / "events.csv").write_text(text.replace(line, f"{line}\n{line}", 1))
    with pytest.raises(skein.DamagedError, match=r"events\.csv: at 0\.0 s there is a second link_up"):
        skein.Run(tmp_path).links


def test_the_earned_score_can_be_computed_with_any_index_of_a_point(flown: skein.Run, tmp_path: Path) -> None:
    shutil.copy(flown.path / "result.json", tmp_path)
    header, *rows = (flown.path / "captures.csv").read_text().splitlines()
    place = header.split(",").index("point")
    for row in range(0, len(rows), 7):
        cells = rows[row].split(",")
        cells[place] = str((2**62, -3)[row % 2])
        rows[row] = ",".join(cells)
    (tmp_path / "captures.csv").write_text("\n".join([header, *rows, ""]))
    assert (np.diff(skein.Run(tmp_path).earned()["score"]) > 0).all()


@pytest.mark.parametrize("name", [*columns.RUN_TABLES, "links"])
def test_a_frame_has_the_same_rows(flown: skein.Run, name: str) -> None:
    array, frame = flown.table(name), flown.frame(name)
    assert tuple(frame.columns) == array.dtype.names and len(frame) == len(array)
    for column in frame:
        values = frame[column].to_numpy()
        assert np.array_equal(values, array[column], equal_nan=array[column].dtype.kind == "f"), column
        assert array[column].dtype.kind != "U" or all(type(value) is str for value in values)
    frame.iloc[:1] = frame.iloc[1:2].to_numpy()  # the frame is a copy
    assert not array.flags.writeable


def test_each_table_is_an_attribute_of_the_run(flown: skein.Run) -> None:
    for name in [*columns.RUN_TABLES, "links"]:
        assert getattr(flown, name) is flown.table(name), "the table was read twice"
    with pytest.raises(ValueError, match="read-only"):
        flown.captures["q"] = 0.0
    with pytest.raises(KeyError, match="'capture'; it has .*captures"):
        flown.table("capture")


def test_an_error_about_missing_data_names_the_reason(tmp_path: Path) -> None:
    run = skein.run("towers", planner="hover", one_process=True, duration=2, no_oracle=True, no_report=True,
                    out=tmp_path / "run")
    with pytest.raises(skein.MissingError, match="no_oracle"):
        run.losses
    with pytest.raises(skein.MissingError, match="no_oracle"):
        run.score_losses
    with pytest.raises(skein.MissingError, match="by hand"):
        run.hand("jurong")
    with pytest.raises(KeyError, match="jurnog"):
        run.hand("jurnog")
    assert len(run.capture_messages) == 0, "no link lost a message, so the table must be empty"
    assert run.capture_messages.dtype.names == columns.CAPTURE_MESSAGES.names
    assert len(run.captures) == 0 and len(run.earned()) == 1
    with pytest.raises(skein.MissingError, match="no folder"):
        skein.Run(tmp_path / "none")
    with pytest.raises(skein.MissingError, match="not a results folder"):
        skein.Run(tmp_path).result
    assert "not a results folder" in repr(skein.Run(tmp_path))


def test_a_number_that_is_null_or_missing_is_nan(tmp_path: Path) -> None:
    (tmp_path / "result.json").write_text('{"score": null, "digest": null, "uavs": null}')
    run = skein.Run(tmp_path)
    assert np.isnan(run.score) and np.isnan(run.sim_time_s) and run.digest is None
    for name in ("uavs", "seed", "planner", "status"):
        with pytest.raises(skein.DamagedError, match=rf"result\.json:1: {name} must be"):
            getattr(run, name)


@pytest.mark.parametrize("text", ["{}", "[]", "null", '{"score": "4.1", "sim_time_s": true, "uavs": {"a": 1}}'])
def test_a_file_that_is_no_result_is_refused_with_file_and_key(tmp_path: Path, text: str) -> None:
    (tmp_path / "result.json").write_text(text)
    run = skein.Run(tmp_path)
    for name in ("uavs", "seed", "planner", "status", "scenario"):
        with pytest.raises(skein.DamagedError, match=rf"result\.json:1: ({name} must be|is damaged: it is not a JSON)"):
            getattr(run, name)
    assert "result.json:1: " in repr(run)
    if "score" in text:
        for name in ("score", "sim_time_s"):
            with pytest.raises(skein.DamagedError, match=rf"result\.json:1: {name} must be a number"):
                getattr(run, name)


def test_results_go_where_the_command_line_puts_them(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    options = {"planner": "hover", "one_process": True, "duration": 1, "no_report": True, "no_oracle": True}
    runs = [skein.run("towers", **options) for _ in range(2)]
    assert [run.path for run in runs] == [tmp_path / "runs" / name for name in ("towers-hover-0", "towers-hover-0-2")]
    assert runs[0].digest == runs[1].digest
    with pytest.raises(skein.InputError, match="force"):
        skein.run("towers", out=runs[0].path, **options)
    assert skein.run("towers", out=runs[0].path, force=True, **options).path == runs[0].path


def test_runs_side_by_side_are_the_same(tmp_path: Path) -> None:
    def fly(number: int) -> str | None:
        return skein.run("towers", planner="hover", one_process=True, duration=2, no_report=True, no_oracle=True,
                         out=tmp_path / str(number)).digest

    with ThreadPoolExecutor(3) as pool:
        digests = list(pool.map(fly, range(3)))
    assert digests[0] is not None and len(set(digests)) == 1


def test_a_process_that_fails_leaves_its_results(tmp_path: Path) -> None:
    with pytest.raises(skein.ProcessError) as caught:
        skein.run("towers", planner="hover,jurong=exec:exit 9", duration=2, no_report=True, out=tmp_path / "run")
    assert caught.value.exit_code == 3 and "jurong" in str(caught.value)
    assert caught.value.run is not None
    assert caught.value.run.result["lost_members"][0]["member"] == "jurong"


def test_all_public_names_have_types_and_docstrings() -> None:
    for name in skein.__all__:
        thing = getattr(skein, name)
        assert inspect.getdoc(thing) or isinstance(thing, dict), name
    for owner in (skein, skein.plots, skein.Run, skein.Study):
        for name in getattr(owner, "__all__", vars(owner)):
            function = getattr(getattr(owner, name), "fget", getattr(owner, name))
            if name.startswith("_") or not inspect.isfunction(function):
                continue
            signature = inspect.signature(function)
            assert signature.return_annotation is not signature.empty, name
            assert all(p.annotation is not p.empty for p in signature.parameters.values() if p.name != "self"), name
