"""Plots of one flight: plan view, activities of the UAVs, and radio links."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..run import Run
from . import look

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Kinds of activities: colour, name, and the first words of the activities that UAVs report. As in web/src/modes.js.
_MODES = (
    (look.QUALITIES[0], "on the ground, takes off, lands", (
        "on the ground", "takes off", "waits to be shown its way up", "flies to its landing place")),
    (look.PLANNERS[0], "flies to goals, rests there", (
        "flies to a goal", "flies along", "flies to a set-point", "rests at its goal", "holds its place",
        "sends commands")),
    (look.PLANNERS[3], "shows another UAV its way up", ("shows ",)),
    (look.PLANNERS[4], "has no goal or way, recovers", (
        "has no goal", "looks for a way", "looks around", "flies nearer", "tries ", "climbs to see more", "flies back",
        "makes room")),
    (look.PLANNERS[1], "stands", ("stands: ",)),
    (look.PLANNERS[2], "brings captures home", ("returns", "delivers", "waits for a link", "stays ")),
    (look.QUALITIES[2], "other", ("",)),
)


def map(run: Run, ax: Axes | None = None) -> Axes:
    """Plan view of a flight: interest points by delivered quality, boxes, tracks, starts, station and collisions."""
    look.checked("run", run, Run)
    poses, points = run.trajectories, run.points
    sides = [max(np.ptp([*poses[axis], *points[axis]]), 1.0) for axis in ("x", "y")]
    with look.drawing(ax, 1.2 + float(np.clip(2.4 * sides[1] / sides[0], 0.8, 4.0))) as ax:
        _draw_boxes(run, ax)
        _draw_points(run, ax)
        explorers = [name for name, uav in zip(run.uavs, run.result["uavs"]) if uav.get("role") == "explorer"]
        handles = []
        for uav, colour in look.track_colours(run).items():
            track = poses[poses["uav"] == uav]
            width = 1.3 if uav in explorers else 0.7
            handles += ax.plot(track["x"], track["y"], color=colour, linewidth=width, alpha=0.9, zorder=4, label=uav)
            if len(track):
                ax.plot(track["x"][0], track["y"][0], "o", color=colour, markersize=3.5, markeredgecolor="white",
                        markeredgewidth=0.5, zorder=6)
        if station := run.result.get("station"):
            handles += ax.plot(*station["position"][:2], "^", color=look.INK, markersize=5, zorder=6, label="station",
                               linestyle="none")
        for i, collision in enumerate(run.result.get("collisions") or []):
            drawn = ax.plot(*collision["position"][:2], "x", color=look.BAD, markersize=6, markeredgewidth=1.6,
                            zorder=7, label="collision", linestyle="none")
            handles += drawn if i == 0 else []
        ax.set_aspect("equal")
        ax.set(xlabel="x [m]", ylabel="y [m]")
        look.legend_below(ax, handles, 4)
    return ax


def _draw_boxes(run: Run, ax: Axes) -> None:
    for box in run.scene["boxes"]:
        half = np.array(box["size"]) / 2.0
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
        ground = corners @ np.array(box["rotation"]).T[:, :2] + np.array(box["center"][:2])
        outline = _hull(ground)
        ax.fill(*outline.T, facecolor="none", edgecolor=look.SOFT, linewidth=0.6, linestyle=(0, (3, 2)), alpha=0.7,
                zorder=2)


def _hull(points: Any) -> Any:
    """The convex hull of points in the plane, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted({(round(float(x), 6), round(float(y), 6)) for x, y in points})
    halves = []
    for line in (ordered, ordered[::-1]):
        half: list[tuple[float, float]] = []
        for p in line:
            while len(half) > 1 and ((half[-1][0] - half[-2][0]) * (p[1] - half[-2][1])
                                     <= (half[-1][1] - half[-2][1]) * (p[0] - half[-2][0])):
                half.pop()
            half.append(p)
        halves.append(half[:-1])
    return np.array(halves[0] + halves[1])


def _draw_points(run: Run, ax: Axes) -> None:
    colours = look.matplotlib().colors
    points = run.points
    none = points["score"] <= 0.0
    ax.scatter(points["x"][none], points["y"][none], s=0.7, color=look.QUALITIES[0], linewidths=0, zorder=1)
    found = np.sort(points[~none], order=["score", "index"])  # the best on top
    steps = colours.ListedColormap(look.QUALITIES[1:])
    drawn = ax.scatter(found["x"], found["y"], s=3.0, c=found["score"], cmap=steps, linewidths=0, zorder=3,
                       norm=colours.BoundaryNorm([0.2, 0.4, 0.6, 0.8, 1.0], steps.N))
    bar = ax.figure.colorbar(drawn, cax=ax.inset_axes((1.02, 0.1, 0.025, 0.8)), ticks=[0.2, 0.4, 0.6, 0.8, 1.0])
    bar.set_label("delivered quality", fontsize=7)
    bar.ax.tick_params(labelsize=6.5, width=0.5, length=2)
    bar.outline.set_linewidth(0.4)


def _lanes(ax: Axes, names: list[str], end_s: float) -> None:
    ax.set_yticks(range(len(names)), names)
    ax.set_ylim(len(names) - 0.5, -0.5)
    ax.set_xlim(0.0, end_s)
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)
    ax.set_xlabel("simulated time [s]")


def activity(run: Run, ax: Axes | None = None) -> Axes:
    """What each UAV did over time, as its program reported it, with a colour for each kind of activity. Strokes above a
    UAV's bar are its captures."""
    look.checked("run", run, Run)
    uavs = run.uavs
    with look.drawing(ax, 1.5 + 0.24 * len(uavs)) as ax:
        said, captures = run.activity, run.captures
        kinds = set()
        for lane, uav in enumerate(uavs):
            own = said[said["uav"] == uav]
            ends = [*own["time_s"][1:], run.sim_time_s]
            for row, end_s in zip(own, ends):
                kind = next(i for i, (_, _, begins) in enumerate(_MODES) if str(row["mode"]).startswith(begins))
                kinds.add(kind)
                ax.barh(lane + 0.08, end_s - row["time_s"], left=row["time_s"], height=0.52, color=_MODES[kind][0],
                        linewidth=0)
            taken = np.unique(captures["time_s"][captures["uav"] == uav])
            ax.vlines(taken, lane - 0.38, lane - 0.22, color=look.INK, linewidth=0.35)
        _lanes(ax, uavs, look.end_s(run))
        patches = look.matplotlib().patches
        handles = [patches.Patch(color=_MODES[kind][0], label=_MODES[kind][1]) for kind in sorted(kinds)]
        handles.append(look.matplotlib().lines.Line2D([], [], color=look.INK, linewidth=0.6, marker="|", markersize=5,
                                                      linestyle="none", label="capture"))
        look.legend_below(ax, handles, 2)
    return ax


def links(run: Run, ax: Axes | None = None) -> Axes:
    """The share of the run's time in which each radio link was open. Rows are senders, columns receivers."""
    look.checked("run", run, Run)
    nodes = ["gcs", *run.uavs]
    with look.drawing(ax, 2.9) as ax:
        share = np.full((len(nodes), len(nodes)), np.nan)
        np.putmask(share, ~np.eye(len(nodes), dtype=bool), 0.0)
        for row in run.links:
            if row["a"] in nodes and row["b"] in nodes:
                share[nodes.index(row["a"]), nodes.index(row["b"])] += row["to_s"] - row["from_s"]
        # An aborted run may have lasted no time, or an unknown one: then there is no share.
        share = 100.0 * share / run.sim_time_s if run.sim_time_s > 0.0 else np.full_like(share, np.nan)
        steps = look.matplotlib().colors.LinearSegmentedColormap.from_list("links", ["#ffffff", look.DIRECT])
        ax.imshow(share, cmap=steps, vmin=0.0, vmax=100.0)
        for (i, j), value in np.ndenumerate(share):
            if not np.isnan(value):
                ax.text(j, i, f"{value:.0f}", ha="center", va="center", fontsize=7,
                        color="white" if value > 65.0 else look.INK)
        ax.set_xticks(range(len(nodes)), nodes, rotation=45, ha="right", rotation_mode="anchor")
        ax.set_yticks(range(len(nodes)), nodes)
        ax.tick_params(length=0)
        for spine in ax.spines.values():
            spine.set_visible(False)
        ax.set(xlabel="receives", ylabel="sends", title="link there, % of the time")
    return ax


def links_over_time(run: Run, ax: Axes | None = None) -> Axes:
    """When each UAV was linked to the station, directly or through other UAVs."""
    look.checked("run", run, Run)
    uavs = run.uavs
    with look.drawing(ax, 1.1 + 0.24 * len(uavs)) as ax:
        up = run.links
        times = np.unique([0.0, *up["from_s"], *up["to_s"], run.sim_time_s])
        spans: dict[tuple[int, str], list[list[float]]] = {}  # begin and end, by lane and colour
        for begin_s, end_s in zip(times[:-1], times[1:]):
            now = up[(up["from_s"] <= begin_s) & (up["to_s"] > begin_s)]
            direct = set(now["a"][now["b"] == "gcs"])
            reached, more = {"gcs"}, True
            while more:
                found = set(now["a"][np.isin(now["b"], sorted(reached))]) - reached
                reached |= found
                more = bool(found)
            for lane, uav in enumerate(uavs):
                if uav not in reached:
                    continue
                own = spans.setdefault((lane, look.DIRECT if uav in direct else look.RELAYED), [])
                if own and own[-1][1] == begin_s:
                    own[-1][1] = end_s
                else:
                    own.append([begin_s, end_s])
        for (lane, colour), all_spans in spans.items():
            for begin_s, end_s in all_spans:
                ax.barh(lane, end_s - begin_s, left=begin_s, height=0.6, linewidth=0, color=colour)
        _lanes(ax, uavs, look.end_s(run))
        patch = look.matplotlib().patches.Patch
        look.legend_below(ax, [patch(color=look.DIRECT, label="linked to the station"),
                               patch(color=look.RELAYED, label="by way of others")], 2)
    return ax
