"""Pictures for papers and pages: one look, and the same bytes from the same numbers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable

from .errors import need

if TYPE_CHECKING:
    from os import PathLike

    from matplotlib.figure import Figure

FORMATS = ("svg", "png")
PNG_DPI = 160
INK, PALE = "#1a1a1a", "#d9d9d9"  # of axes and words, of the grid

# What matplotlib is told (rcParams); the rest are its defaults.
STYLE: dict[str, Any] = {
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "font.size": 9.0,
    "axes.titlesize": 10.0, "axes.titlelocation": "left", "axes.titleweight": "bold",
    "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": INK,
    "axes.labelcolor": INK, "text.color": INK, "xtick.color": INK, "ytick.color": INK,
    "axes.grid": True, "grid.color": PALE, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "lines.linewidth": 1.6, "legend.frameon": False, "figure.facecolor": "white",
    "savefig.facecolor": "white", "svg.fonttype": "none", "svg.hashsalt": "rockyard",
    "path.simplify": False,
    "text.parse_math": False,  # names of runs are text, whatever signs they hold
}


def pyplot() -> Any:
    """Returns matplotlib.pyplot in this look for the rest of the program, which draws into files only."""
    need("matplotlib", "python3-matplotlib", "rockyard.pictures").use("Agg")
    found = need("matplotlib.pyplot", "python3-matplotlib", "rockyard.pictures")
    found.rcdefaults()
    found.rcParams.update(STYLE)
    return found


def save(figure: "Figure", folder: "str | PathLike[str]", name: str, formats: Iterable[str] = FORMATS,
         creator: str = "rockyard") -> list[Path]:
    """Writes folder/name.svg and .png without dates, and closes the figure. Returns their paths."""
    paths = []
    for kind in formats:
        path = Path(folder) / f"{name}.{kind}"
        metadata = {"Creator": creator, "Date": None} if kind == "svg" else {"Software": None}
        figure.savefig(path, format=kind, dpi=PNG_DPI, metadata=metadata)
        if kind == "svg":
            _round_numbers(path)
        paths.append(path)
    need("matplotlib.pyplot", "python3-matplotlib", "rockyard.pictures").close(figure)
    return paths


def _round_numbers(path: Path) -> None:
    """Leaves two decimals of a point in path data, which make most of an SVG."""
    def rounded(found: "re.Match[str]") -> str:
        return f"{float(found[0]):.2f}".rstrip("0").rstrip(".")

    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r' d="([^"]*)"', lambda found: f' d="{re.sub(r"-?[0-9]+[.][0-9]+", rounded, found[1])}"', text),
                    encoding="utf-8")
