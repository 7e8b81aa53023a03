"""Studies: their tables, their flights, and the pairs that the launcher computed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import skein


def test_every_flight_is_a_run(study: skein.Study) -> None:
    assert study.planners == ["patrol", "kios:voxel_m=4,lanes=3"] and study.scenarios == ["towers"]
    assert len(study.flights) == 10
    for i, flight in enumerate(study.flights):
        run = study.run(i)
        assert run.score == pytest.approx(flight["score"], abs=1e-4)
        assert run.seed == flight["seed"] and run.digest == flight["digest"]
        assert set(run.planner.values()) == {str(flight["planner"])}
    assert [run.seed for run in study.runs(planner="patrol")] == [0, 1, 2, 3, 4]
    assert study.runs(planner="patrol", seed=7) == []
    with pytest.raises(KeyError, match="planer"):
        study.runs(planer="patrol")
    assert study.settings["seeds"] == [0, 1, 2, 3, 4]
    assert "10 flights of patrol, kios:voxel_m=4,lanes=3 in towers" in repr(study)


def test_pairs_are_those_that_the_launcher_computed(study: skein.Study) -> None:
    (pair,) = study.pairs[study.pairs["figure"] == "score"]
    assert (pair["first"], pair["second"], pair["scenario"]) == ("patrol", "kios:voxel_m=4,lanes=3", "towers")
    assert pair["pairs"] == 5
    flights = study.flights
    by_planner = [flights["score"][flights["planner"] == planner] for planner in study.planners]
    assert pair["median"] == pytest.approx(np.median(by_planner[0] - by_planner[1]), abs=1e-3)
    assert pair["low"] <= pair["median"] <= pair["high"] and 0.0 < pair["p"] <= 1.0
    assert pair["p"] <= pair["p_holm"] <= 1.0
    (share,) = study.pairs[study.pairs["figure"] == "greatest_share"]
    shares = [flights["greatest_share"][flights["planner"] == planner] for planner in study.planners]
    assert share["pairs"] == np.count_nonzero(np.isfinite(shares[0] - shares[1]))
    assert list(study.summary["planner"]) == study.planners
    assert study.summary["score_median"][0] == pytest.approx(np.median(by_planner[0]), abs=1e-3)


@pytest.mark.parametrize("name", ["flights", "summary", "pairs"])
def test_a_frame_has_the_same_rows(study: skein.Study, name: str) -> None:
    frame, array = study.frame(name), study.table(name)
    assert tuple(frame.columns) == array.dtype.names and len(frame) == len(array)


def test_a_study_continues_where_it_was_stopped(study: skein.Study) -> None:
    before = {i: (study.run(i).path / "result.json").stat().st_mtime_ns for i in range(10)}
    again = skein.compare(["patrol", "kios:voxel_m=4,lanes=3"], seeds="0-5", duration=3, out=study.path, force=True)
    assert len(again.flights) == 12
    assert {i: (study.run(i).path / "result.json").stat().st_mtime_ns for i in range(10)} == before


def test_a_study_refuses_with_a_reason(study: skein.Study, tmp_path: Path) -> None:
    with pytest.raises(skein.InputError, match="other settings"):
        skein.compare(["patrol"], duration=4, out=study.path)
    with pytest.raises(skein.MissingError, match="contest"):
        study.totals
    with pytest.raises(KeyError, match="'flight'; it has flights"):
        study.table("flight")
    with pytest.raises(skein.MissingError, match="not a folder of a study"):
        skein.Study(tmp_path).settings


def test_an_unmet_requirement_raises_an_error_that_has_the_study(tmp_path: Path) -> None:
    with pytest.raises(skein.CheckError) as caught:
        skein.compare("hover", seeds=1, duration=1, require="score>=1", out=tmp_path / "study")
    assert caught.value.exit_code == 1
    assert caught.value.study is not None and len(caught.value.study.flights) == 1


def test_a_contest_has_totals(tmp_path: Path) -> None:
    study = skein.contest(["hover", "patrol"], scenarios="towers", tests=2, duration=1, out=tmp_path / "study")
    totals = study.totals
    assert totals.dtype.names == ("place", "planner", "ranked_by", "test_1", "test_2", "max", "median", "worst")
    assert set(totals["planner"]) == {"hover", "patrol"} and set(totals["ranked_by"]) == {"max"}
    assert set(study.pairs["scenario"]) == {"towers"}
