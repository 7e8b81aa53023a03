"""Plots of studies: figures by scene and planner, scores over time, and differences between planners."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..run import Run
from ..study import Study
from ..tables import Array
from . import look

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_FEWEST_IN_A_BOX = 5  # quartiles of fewer flights say little


def scores(study: Study, ax: Axes | None = None, *, figure: str = "score") -> Axes:
    """A figure (a column of `study.flights`) by scene and planner: a dot for each flight, a line at the median. From 5
    flights on also a box between the quartiles, with whiskers to the least and the greatest value."""
    look.checked("study", study, Study)
    flights, planners, scenarios = study.flights, study.planners, study.scenarios
    slots = len(scenarios) * (len(planners) + 1) - 1
    with look.drawing(ax, 2.4, max(look.WIDTH, 0.16 * slots + 0.8)) as ax:
        for s, scenario in enumerate(scenarios):
            for p, planner in enumerate(planners):
                values = flights[figure][(flights["scenario"] == scenario) & (flights["planner"] == planner)]
                values = values[~np.isnan(values)]
                if len(values):
                    _draw_box(ax, s * (len(planners) + 1) + p, values, look.PLANNERS[p % len(look.PLANNERS)])
        middles = [s * (len(planners) + 1) + (len(planners) - 1) / 2.0 for s in range(len(scenarios))]
        ax.set_xticks(middles, scenarios)
        ax.tick_params(axis="x", length=0)
        ax.set_xlim(-0.8, slots - 0.2)
        ax.set_ylim(bottom=min(0.0, np.nanmin(flights[figure], initial=0.0)))
        ax.set_ylabel(figure.replace("_", " "))
        ax.grid(axis="y", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        patch = look.matplotlib().patches.Patch
        look.legend_below(ax, [patch(color=look.PLANNERS[p % len(look.PLANNERS)], label=planner)
                               for p, planner in enumerate(planners)], min(len(planners), 4), 0.25)
    return ax


def curves(study: Study, ax: Axes | None = None, *, scenario: str | None = None) -> Axes:
    """Scores over time in one scene: for each planner the median of its flights, in a band from the least to the
    greatest score. `scenario` may be left out if the study has only one."""
    look.checked("study", study, Study)
    if scenario is None and len(study.scenarios) > 1 or scenario is not None and scenario not in study.scenarios:
        raise ValueError(f"which scenario? There are {', '.join(study.scenarios)}, not {scenario!r}")
    with look.drawing(ax, 2.2) as ax:
        end_s = 0.0
        for p, planner in enumerate(study.planners):
            flights = [run for run in study.runs(planner=planner, scenario=scenario or study.scenarios[0])
                       if (run.path / "result.json").exists()]
            if not flights:
                continue
            times = np.unique(np.concatenate([[run.sim_time_s for run in flights],
                                              *(run.timeline["time_s"] for run in flights)]))
            known = np.array([_scores_at(run, times) for run in flights])
            colour = look.PLANNERS[p % len(look.PLANNERS)]
            ax.fill_between(times, known.min(axis=0), known.max(axis=0), step="post", color=colour, alpha=0.18,
                            linewidth=0)
            ax.step(times, np.median(known, axis=0), where="post", color=colour, label=planner,
                    linestyle=look.LINE_STYLES[p % len(look.LINE_STYLES)])
            end_s = max(end_s, times[-1])
        ax.set(xlabel="simulated time [s]", ylabel="score: median and range")
        ax.set_xlim(0.0, end_s or 1.0)
        ax.set_ylim(bottom=0.0)
        ax.grid(axis="y", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        ax.legend(loc="upper left")
    return ax


def _scores_at(run: Run, times: Array) -> Array:
    """The delivered score of a flight at each of these times: 0 before its first entry, the last one after its end."""
    scores = np.concatenate([[0.0], run.timeline["score"]])
    return scores[np.searchsorted(run.timeline["time_s"], times, side="right")]


def _draw_box(ax: Axes, x: float, values: Array, colour: str) -> None:
    low, median, high = np.percentile(values, [25, 50, 75])
    if len(values) >= _FEWEST_IN_A_BOX:
        ax.vlines(x, values.min(), values.max(), color=colour, linewidth=0.8, zorder=2)
        ax.bar(x, high - low, bottom=low, width=0.7, facecolor="white", edgecolor="white", zorder=2.5)
        ax.bar(x, high - low, bottom=low, width=0.7, facecolor=colour + "2e", edgecolor=colour, linewidth=0.8, zorder=3)
    ax.hlines(median, x - 0.35, x + 0.35, color=colour, linewidth=1.8, zorder=4)
    # Dots are spread sideways by the order of flights, not at random, so that the figure is the same each time.
    places = x + 0.16 * (np.arange(len(values)) % 3 - 1 if len(values) > 2 else np.zeros(len(values)))
    ax.plot(places, values, "o", color=colour, markersize=2.4, markeredgecolor="white", markeredgewidth=0.3, zorder=5)


def pairs(study: Study, ax: Axes | None = None, *, figure: str = "score") -> Axes:
    """Differences between planners in flights with the same seed: the median of the differences of scores, or of
    another figure of pairs.csv, and its 95 % interval if there are enough flights. The launcher computed them."""
    look.checked("study", study, Study)
    table = study.pairs[study.pairs["figure"] == figure]
    if not len(table):
        raise ValueError(f"which figure? There are {', '.join(dict.fromkeys(map(str, study.pairs['figure'])))}")
    with look.drawing(ax, 0.75 + 0.24 * len(table)) as ax:
        names = []
        for lane, row in enumerate(table):
            scene = str(row["scenario"]) or "all scenes"
            names.append(f"{scene}: {row['first']} \N{MINUS SIGN} {row['second']}")
            if not np.isnan(row["low"]):
                ax.hlines(lane, row["low"], row["high"], color=look.PLANNERS[0], linewidth=4.0, alpha=0.3)
            ax.plot(row["median"], lane, "o", color=look.PLANNERS[0], markersize=4)
        ax.axvline(0.0, color=look.INK, linewidth=0.8)
        ax.set_yticks(range(len(names)), names)
        ax.set_ylim(len(names) - 0.5, -0.5)
        ax.tick_params(axis="y", length=0)
        ax.grid(axis="x", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        ax.spines["left"].set_visible(False)
        what = "scores" if figure == "score" else figure
        ax.set_xlabel(f"difference of {what}: median, 95 % interval", loc="right")
    return ax
