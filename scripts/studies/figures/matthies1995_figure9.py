"""Matthies 1995, figure 9: mean angular error of the coloured cylinder."""

from . import Figure
from .cylinder_curves import NEEDS, draw_curves


def draw(sources, _options):
    return draw_curves(sources, "orientation", "_deg", 0, "mean error (deg)", "Mean angular error")


FIGURE = Figure(name="matthies1995-9", title="mean angular error of the coloured cylinder", runs=NEEDS, accepts=(1, 1), draw=draw)
