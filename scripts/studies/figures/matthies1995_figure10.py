"""Matthies 1995, figure 10: mean relative error of its distance by stereo."""

from . import Figure
from .cylinder_curves import NEEDS, draw_curves


def draw(sources, _options):
    return draw_curves(sources, "stereo", "", 0, "mean error / distance", "Mean relative error of the distance by stereo")


FIGURE = Figure(name="matthies1995-10", title="mean relative error of its distance by stereo", runs=NEEDS, accepts=(1, 1), draw=draw)
