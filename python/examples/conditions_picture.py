"""Draws two flights side by side in plan view, one in an ideal world and one under conditions, and below them the
causes of their losses.

    python3 python/examples/conditions_picture.py runs/ideal runs/harsh picture.svg
"""

import sys

import skein
from skein import plots

*paths, file = sys.argv[1:]
runs = [skein.Run(path) for path in paths]
labels = [str(run.result.get("conditions") or "none") for run in runs]
maps, bars = plots.axes(2, 2, height=5.0, width=7.0)
for run, label, ax in zip(runs, labels, maps):
    plots.map(run, ax)
    ax.set_title(f"{label}: {run.score:.0f} points", fontsize="medium")
bars[1].remove()
bars[0].set_subplotspec(bars[0].get_gridspec()[1, :])
plots.losses(runs, bars[0], labels=labels)
plots.save(maps[0], file)
