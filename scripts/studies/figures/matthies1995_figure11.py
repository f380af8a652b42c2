"""Matthies 1995, figure 11: standard deviation of its angle."""

from . import Figure
from .cylinder_curves import NEEDS, draw_curves


def draw(sources, _options):
    return draw_curves(sources, "orientation", "_deg", 1, "standard deviation (deg)", "Standard deviation of the measured angle")


FIGURE = Figure(name="matthies1995-11", title="standard deviation of its angle", runs=NEEDS, accepts=(1, 1), draw=draw)
