"""Plots of runs' scores: score over time, losses, delays of delivery, and quality."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..run import Run
from ..tables import Array
from . import look

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def score(runs: Run | Iterable[Run], ax: Axes | None = None, *, labels: Sequence[str] | None = None,
          earned: bool | None = None) -> Axes:
    """The delivered score over time. For a single run also the earned score (dashed), and faults as bars.

    `earned`: whether to draw the earned score; by default only for a single run.
    """
    all_runs = look.several(runs)
    names = look.labels_of(all_runs, labels)
    alone = len(all_runs) == 1
    with look.drawing(ax, 2.2) as ax:
        for i, (run, name) in enumerate(zip(all_runs, names)):
            colour = look.PLANNERS[i % len(look.PLANNERS)]
            dashes = look.LINE_STYLES[0 if alone else (i // len(look.PLANNERS) + i) % len(look.LINE_STYLES)]
            ax.step(*_to_the_end(run.timeline, run.sim_time_s), where="post", color=colour, linestyle=dashes,
                    label="delivered" if alone and labels is None else name, zorder=3)
            if alone if earned is None else earned:
                ax.step(*_to_the_end(run.earned(), run.sim_time_s), where="post",
                        color=colour if not alone else look.SOFT, linestyle=(0, (2, 1.5)), linewidth=0.9, zorder=2,
                        label="earned" if alone else f"{name}, earned")
            if alone:
                _draw_faults(run, ax)
        ax.set(xlabel="simulated time [s]", ylabel="score")
        ax.set_xlim(0.0, max(look.end_s(run) for run in all_runs))
        ax.set_ylim(bottom=0.0)
        ax.grid(axis="y", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        ax.legend(loc="upper left")
    return ax


def _to_the_end(curve: Array, end_s: float) -> tuple[list[float], list[float]]:
    """Times and scores of a curve, whose last score lasts until `end_s`. A run that was aborted may have no score."""
    times_s, scores = [*curve["time_s"]], [*curve["score"]]
    return (times_s + [end_s], scores + scores[-1:]) if scores else ([], [])


def _draw_faults(run: Run, ax: Axes) -> None:
    label: str | None = "fault"
    for fault in run.result.get("faults") or []:
        if fault.get("began_step") is None:
            continue
        step_s = run.result["exchange_period_s"]
        ended = fault.get("ended_step")
        until_s = run.sim_time_s if ended is None else max(ended, fault["began_step"] + 1) * step_s
        ax.axvspan(fault["began_step"] * step_s, until_s, color=look.FAULT, alpha=0.13, linewidth=0, label=label)
        label = None


def losses(runs: Run | Iterable[Run], ax: Axes | None = None, *, labels: Sequence[str] | None = None) -> Axes:
    """A bar for each run, from the delivered to the attainable score, with a segment for each cause of loss."""
    all_runs = look.several(runs)
    names = look.labels_of(all_runs, labels)
    with look.drawing(ax, 1.35 + 0.26 * len(all_runs)) as ax:
        patch = look.matplotlib().patches.Patch
        lost = [run.score_losses for run in all_runs]
        causes = [cause for cause in look.CAUSES if any(part.get(cause, 0.0) > 0.0 for part in lost)]
        for i, (run, part) in enumerate(zip(all_runs, lost)):
            ax.barh(i, run.score, height=0.62, color=look.PLANNERS[0])
            begin = run.score
            for cause in causes:
                size = max(part.get(cause, 0.0), 0.0)
                ax.barh(i, size, left=begin, height=0.62, color=look.CAUSES[cause][0], edgecolor="white", linewidth=0.4)
                begin += size
            attainable = run.score + sum(part.values())
            ax.plot([attainable] * 2, [i - 0.42, i + 0.42], color=look.INK, linewidth=1.0, solid_capstyle="butt")
        ax.set_yticks(range(len(names)), names)
        ax.set_ylim(len(names) - 0.5, -0.5)
        ax.set_xlim(left=0.0)
        ax.tick_params(axis="y", length=0)
        ax.set_xlabel("score; the line is what was attainable")
        handles = [patch(color=look.PLANNERS[0], label="delivered")]
        handles += [patch(color=look.CAUSES[cause][0], label=look.CAUSES[cause][1]) for cause in causes]
        look.legend_below(ax, handles, 2)
    return ax


def delivery(runs: Run | Iterable[Run], ax: Axes | None = None, *, labels: Sequence[str] | None = None) -> Axes:
    """The share of the captures that had reached the station, by delay. Captures that were never delivered keep it
    below 100 %."""
    all_runs = look.several(runs)
    names = look.labels_of(all_runs, labels)
    with look.drawing(ax, 2.0) as ax:
        longest = 0.0
        for i, (run, name) in enumerate(zip(all_runs, names)):
            # A capture is delivered as a whole; it has a row for each of its points.
            _, first = np.unique(run.captures[["uav", "capture"]], return_index=True)
            taken = run.captures[first]
            delays = np.sort((taken["delivered_at_s"] - taken["time_s"])[~np.isnan(taken["delivered_at_s"])])
            longest = max(longest, delays.max(initial=0.0))
            ax.step([0.0, *delays], 100.0 * np.arange(len(delays) + 1) / max(len(taken), 1), where="post",
                    color=look.PLANNERS[i % len(look.PLANNERS)], label=f"{name}: {len(taken)} captures",
                    linestyle=look.LINE_STYLES[i % len(look.LINE_STYLES)])
        ax.set(xlabel="time from picture to station [s]", ylabel="% of the captures")
        ax.set_xlim(0.0, longest or 1.0)
        ax.set_ylim(0.0, 102.0)
        ax.grid(axis="y", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        ax.legend(loc="lower right")
    return ax


def quality(runs: Run | Iterable[Run], ax: Axes | None = None, *, labels: Sequence[str] | None = None,
            bins: int = 20) -> Axes:
    """Histogram of the delivered quality of the points that scored, with `bins` bins from 0 to 1, or to the best
    quality if that is above 1."""
    all_runs = look.several(runs)
    names = look.labels_of(all_runs, labels)
    with look.drawing(ax, 2.0) as ax:
        scores = [run.points["score"][run.points["score"] > 0.0] for run in all_runs]
        # Under some rules, a quality can be above 1.
        edges = np.linspace(0.0, max([1.0, *(values.max(initial=0.0) for values in scores)]), bins + 1)
        for i, (values, name) in enumerate(zip(scores, names)):
            counts = np.histogram(values, edges)[0]
            colour = look.PLANNERS[i % len(look.PLANNERS)]
            if len(all_runs) == 1:
                ax.bar(edges[:-1], counts, np.diff(edges), align="edge", color=colour, edgecolor="white", linewidth=0.4)
            else:
                ax.stairs(counts, edges, color=colour, linestyle=look.LINE_STYLES[i % len(look.LINE_STYLES)],
                          linewidth=1.1, label=f"{name}: {len(values)} points", baseline=None)
        ax.set(xlabel="delivered quality of a point", ylabel="points")
        ax.set_xlim(0.0, edges[-1])
        ax.set_ylim(bottom=0.0)
        ax.grid(axis="y", color=look.LINE, linewidth=0.5)
        ax.set_axisbelow(True)
        if len(all_runs) > 1:
            ax.legend(loc="upper left")
    return ax
