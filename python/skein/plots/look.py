"""Style of the plots, and functions that all plots share."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ..errors import InputError, missing_package
from ..run import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK, SOFT, LINE = "#1b2330", "#5c6675", "#d5dae1"
# The colours of report/style.hpp: planners (c), tracks (t), qualities (q), causes of losses (k), links, faults.
PLANNERS = ("#0072b2", "#d55e00", "#009e73", "#b8578f", "#b97f00", "#3b8fc4", "#6b6b6b")
TRACKS = ("#d55e00", "#00855f", "#c0609a", "#c98a00", "#2a2f38", "#8b5a2b")
QUALITIES = ("#cfd4db", "#a9cbe8", "#6aa6d8", "#2d7bbf", "#0b4a86")
CAUSES = {
    "out_of_reach": ("#8a8f98", "no UAV fits there"),
    "never_in_picture": ("#332288", "never in the picture"),
    "below_threshold": ("#cc6677", "too poor to count"),
    "voided": ("#882255", "UAV collided"),
    "not_delivered": ("#c98a00", "not delivered"),
    "distance": ("#3a9fcf", "from too far away"),
    "tilt": ("#2f9585", "too much from the side"),
    "blur": ("#8f8f2a", "blurred"),
    "drift": ("#aa4499", "position was off"),
    "wind": ("#5b7fa6", "pushed by wind"),
    "energy": ("#a5501e", "battery empty"),
}
DIRECT, RELAYED, FAULT, BAD = "#2f9585", "#a3d3cb", "#d55e00", "#b3261e"
LINE_STYLES = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)))  # for prints without colours

WIDTH = 3.5  # width of a column [inches]
_TICKS = {"labelsize": 7, "width": 0.6, "length": 2.5, "color": SOFT, "labelcolor": INK, "which": "both"}
_STYLE = {
    "font.family": "DejaVu Sans", "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 8, "legend.fontsize": 7,
    "xtick.labelsize": 7, "ytick.labelsize": 7, "figure.titlesize": 8,
    "text.color": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK,
    "axes.edgecolor": SOFT, "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False,
    "lines.linewidth": 1.2, "patch.linewidth": 0.6, "legend.frameon": False, "legend.handlelength": 1.6,
    "figure.constrained_layout.use": True, "figure.dpi": 150, "savefig.dpi": 300,
    "svg.hashsalt": "skein", "pdf.fonttype": 42, "ps.fonttype": 42,
}


def matplotlib() -> Any:
    """The package matplotlib, with pyplot imported. Raises DependencyError if it is not installed."""
    try:
        import matplotlib.pyplot
    except ImportError:
        raise missing_package("matplotlib") from None
    return matplotlib


@contextlib.contextmanager
def style() -> Iterator[None]:
    """A `with` block in which matplotlib's own functions draw in this style, too."""
    with matplotlib().rc_context(_STYLE):
        yield


def axes(rows: int = 1, columns: int = 1, height: float = 2.2, width: float = WIDTH) -> Any:
    """Axes in a new figure in this style: one, or an array as `matplotlib.pyplot.subplots` returns. Sizes in inches."""
    with style():
        _, made = matplotlib().pyplot.subplots(rows, columns, figsize=(width, height))
        for ax in [made] if rows * columns == 1 else made.flat:
            ax.tick_params(**_TICKS)
        return made


def save(drawn: Axes | Figure, file: str | os.PathLike[str]) -> None:
    """Writes a figure, or the figure of these Axes, as SVG, PDF or PNG. The same figure gives the same bytes."""
    figure = getattr(drawn, "figure", drawn)
    suffix = os.fspath(file).rpartition(".")[2].lower()
    dates: dict[str, dict[str, None]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with style():
        figure.savefig(file, metadata=dates.get(suffix))


@contextlib.contextmanager
def drawing(ax: Axes | None, height: float, width: float = WIDTH) -> Iterator[Axes]:
    """A context in this style, with the Axes to draw into: `ax`, or those of a new figure (sizes in inches)."""
    with style():
        yield axes(height=height, width=width) if ax is None else ax


def several(runs: Run | Iterable[Run]) -> list[Run]:
    all_runs = [runs] if isinstance(runs, Run) else list(runs) if isinstance(runs, Iterable) else []
    if not (isinstance(runs, Iterable) or all_runs) or not all(isinstance(run, Run) for run in all_runs):
        raise InputError(f"runs must be a skein.Run or a list of them, not {runs!r:.80}")
    if not all_runs:
        raise ValueError("there is no run to draw")
    return all_runs


def checked(name: str, value: Any, kind: type[Any]) -> None:
    """Raises InputError if the value is not of this kind."""
    if not isinstance(value, kind):
        raise InputError(f"{name} must be a skein.{kind.__name__}, not {value!r:.80}")


def end_s(run: Run) -> float:
    """Where the time axis of a run ends [s]: an aborted run may have lasted no time, or an unknown one."""
    return run.sim_time_s if run.sim_time_s > 0.0 else 1.0


def labels_of(runs: Sequence[Run], labels: Sequence[str] | None) -> list[str]:
    """Labels for runs: `labels`, or what differs between the runs."""
    if labels is not None:
        if isinstance(labels, str) or not isinstance(labels, Sequence) or not all(isinstance(x, str) for x in labels):
            raise InputError(f"labels must be a list of texts, not {labels!r:.80}")
        if len(labels) != len(runs):
            raise ValueError(f"there are {len(labels)} labels for {len(runs)} runs")
        return list(labels)
    # Of a program, only the file's name, without its folder.
    planners = [", ".join(dict.fromkeys(p if ":" in p else p.rpartition("/")[2] or p for p in run.planner.values()))
                for run in runs]
    parts = [(run.scenario, planner, f"seed {run.seed}") for run, planner in zip(runs, planners)]
    differing = [i for i in range(3) if len({part[i] for part in parts}) > 1]
    names = [", ".join(part[i] for i in differing) or part[1] for part in parts]
    return names if len(set(names)) == len(names) else [f"{name} ({run.path.name})" for name, run in zip(names, runs)]


def track_colours(run: Run) -> dict[str, str]:
    """Colours of the tracks, by name of the UAV, in fleet order."""
    return {uav: TRACKS[i % len(TRACKS)] for i, uav in enumerate(run.uavs)}


def legend_below(ax: Axes, handles: Sequence[Any], columns: int, inches: float = 0.45) -> None:
    """Adds a legend below the Axes. `inches`: distance from the x axis, for its ticks and its label."""
    down = matplotlib().transforms.ScaledTranslation(0.0, -inches, ax.figure.dpi_scale_trans)
    ax.legend(handles=handles, ncol=columns, loc="upper center", bbox_to_anchor=(0.5, 0.0),
              bbox_transform=ax.transAxes + down, columnspacing=1.2, handlelength=1.2, borderaxespad=0.0)
