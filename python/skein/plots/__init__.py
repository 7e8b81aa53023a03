"""Plots of runs and studies for papers, by matplotlib.

Each function takes a run (or several) or a study, and optionally the Axes to draw into, and returns these Axes. Without
Axes it makes a figure as wide as a column of a paper (3.5 inches). `save()` writes the same bytes for the same figure.
The colours are those of Skein's reports, which people with any colour vision can tell apart.
"""

from .flight import activity, links, links_over_time, map
from .scores import delivery, losses, quality, score
from .studies import curves, pairs, scores
from .look import axes, save, style

__all__ = ["activity", "axes", "curves", "delivery", "links", "links_over_time", "losses", "map", "pairs", "quality",
           "save", "score", "scores", "style"]
