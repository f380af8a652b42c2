"""The figures that scripts/studies/figures/figures.py can draw: modules, found by their FIGURES.

A new figure is a new file in this folder that defines

    FIGURES = (Figure(name="author1999-12", title="one line", runs="what RUN... must be",
                      accepts=(1, 2), draw=draw),)

where draw(sources, options) gets a Source (source.py) for each RUN and the command's options, and
returns Drawn: the matplotlib figure, its caption, and the numbers that were drawn.
"""

import importlib
import pkgutil
from dataclasses import dataclass, field
from typing import Callable


class FigureError(Exception):
    """What is wrong with the input, in one line that says what would be right."""


@dataclass(frozen=True)
class Figure:
    name: str       # as the command takes it
    title: str      # one line for --list
    runs: str       # what RUN... are
    accepts: tuple  # fewest and most of them
    draw: Callable
    defaults: tuple = ()  # files of the repository that are RUN... where none is given
    chosen: Callable = lambda source: 0  # the trial that is drawn where none is named


@dataclass
class Drawn:
    figure: object  # of matplotlib
    caption: str
    # Name of a curve: list of rows that were drawn, for the file beside the picture.
    numbers: dict = field(default_factory=dict)


def all_figures():
    """Name: Figure, sorted by name. Needs matplotlib, as the figures do."""
    found = {}
    for module in pkgutil.iter_modules(__path__):
        found |= {figure.name: figure for figure in getattr(importlib.import_module(f"{__name__}.{module.name}"), "FIGURES", ())}
    return dict(sorted(found.items()))
