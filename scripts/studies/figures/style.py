"""How every figure looks: that of rockyard.pictures, with colours of its own.

Colours: Okabe and Ito (2008), told apart by colour-blind people; every curve has a line style or a
mark of its own too, so that nothing is lost in grey.
"""

import math

from study import ry  # noqa: F401  (where the package is)
from rockyard import pictures
from rockyard.pictures import FORMATS, INK, PALE  # noqa: F401

plt = pictures.pyplot()
from matplotlib.collections import PolyCollection  # noqa: E402  pylint: disable=wrong-import-position

BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE, ORANGE, SKY = "#CC79A7", "#E69F00", "#56B4E9"
GREY = "#767676"
RAMP = "cividis"  # even steps of lightness: the same order in grey


def new_figure(width_in, height_in, **grid):
    """A figure and its axes, as plt.subplots gives them."""
    return plt.subplots(figsize=(width_in, height_in), layout="constrained", **grid)


def octagons(axes, rocks, **look):
    """A regular octagon for each (x, y, diameter): its sides touch the circle of that diameter."""
    corners = [(math.cos(angle), math.sin(angle)) for angle in (math.pi / 8 * (2 * i + 1) for i in range(8))]
    stretch = 0.5 / math.cos(math.pi / 8)
    shapes = [[(x + stretch * diameter * c, y + stretch * diameter * s) for c, s in corners]
              for x, y, diameter in rocks]
    return axes.add_collection(PolyCollection(shapes, **look))


def save(figure, folder, name, formats=FORMATS):
    """Writes the pictures; their paths."""
    return pictures.save(figure, folder, name, formats, "rockyard scripts/studies/figures/figures.py")
