"""How every figure looks, and how it is saved so that the same numbers give the same bytes.

Colours: Okabe and Ito (2008), told apart by colour-blind people; every curve has a line style or a
mark of its own too, so that nothing is lost in grey.
"""

import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  pylint: disable=wrong-import-position

BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE, ORANGE, SKY = "#CC79A7", "#E69F00", "#56B4E9"
INK, GREY, PALE = "#1a1a1a", "#767676", "#d9d9d9"
RAMP = "cividis"  # even steps of lightness: the same order in grey
FORMATS = ("svg", "png")
PNG_DPI = 160

plt.rcdefaults()
plt.rcParams.update({
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 9.0,
    "axes.titlesize": 10.0, "axes.titlelocation": "left", "axes.titleweight": "bold",
    "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": INK,
    "axes.labelcolor": INK, "text.color": INK, "xtick.color": INK, "ytick.color": INK,
    "axes.grid": True, "grid.color": PALE, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "lines.linewidth": 1.6, "legend.frameon": False, "figure.facecolor": "white",
    "savefig.facecolor": "white", "svg.fonttype": "none", "svg.hashsalt": "rockyard",
    "path.simplify": False,
    "text.parse_math": False,  # names of runs are text, whatever signs they hold
})


def new_figure(width_in, height_in, **grid):
    """A figure and its axes, as plt.subplots gives them."""
    return plt.subplots(figsize=(width_in, height_in), layout="constrained", **grid)


def octagons(axes, rocks, **look):
    """A regular octagon for each (x, y, diameter): its sides touch the circle of that diameter."""
    from matplotlib.collections import PolyCollection  # pylint: disable=import-outside-toplevel
    import math  # pylint: disable=import-outside-toplevel
    corners = [(math.cos(angle), math.sin(angle))
               for angle in (math.pi / 8 * (2 * i + 1) for i in range(8))]
    stretch = 0.5 / math.cos(math.pi / 8)
    shapes = [[(x + stretch * diameter * c, y + stretch * diameter * s) for c, s in corners]
              for x, y, diameter in rocks]
    return axes.add_collection(PolyCollection(shapes, **look))


def save(figure, folder, name, formats=FORMATS):
    """Writes the pictures without dates; two decimals of a point are plenty in an SVG. Their paths."""
    paths = []
    for kind in formats:
        path = folder / f"{name}.{kind}"
        metadata = {"Creator": "rockyard scripts/studies/figures/figures.py", "Date": None} if kind == "svg" else \
            {"Software": None}
        figure.savefig(path, format=kind, dpi=PNG_DPI, metadata=metadata)
        if kind == "svg":
            _round_numbers(path)
        paths.append(path)
    plt.close(figure)
    return paths


def _round_numbers(path):
    """Fewer digits in path data, which make most of an SVG."""
    def shorter(match):
        return f' d="{re.sub(number, round_one, match.group(1))}"'

    def round_one(match):
        return f"{float(match.group(0)):.2f}".rstrip("0").rstrip(".")

    number = r"-?\d+\.\d+"
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r' d="([^"]*)"', shorter, text), encoding="utf-8")
