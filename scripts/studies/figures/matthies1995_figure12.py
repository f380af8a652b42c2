"""Matthies 1995, figure 12: standard deviation of its distance by stereo."""

from . import Figure
from .cylinder_curves import NEEDS, draw_curves


def draw(sources, _options):
    return draw_curves(sources, "stereo", "", 1, "standard deviation / distance", "Standard deviation of the normalized distance by stereo")


FIGURE = Figure(name="matthies1995-12", title="standard deviation of its distance by stereo", runs=NEEDS, accepts=(1, 1), draw=draw)
