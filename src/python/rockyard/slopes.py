"""How a rover gets on on slopes and over steps: what the command mobility does."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterable, Iterator, Mapping

import numpy as np

from . import _core
from .campaigns import INTERRUPTED, _listed, _shown
from .errors import MOST_SEED, InputError, Problem, whole
from .scenario import Scenario, assignments

if TYPE_CHECKING:
    from os import PathLike

    from .campaigns import Progress

    Array = np.ndarray[Any, Any]

TABLES = ("slopes", "wheel", "limits")


def _array(cells: list[Any]) -> "Array":
    if any(isinstance(cell, str) for cell in cells):
        return np.array(cells)
    return np.array([np.nan if cell is None else cell for cell in cells], dtype=float)


class Mobility(Mapping[str, "dict[str, Array]"]):
    """Three tables, each a dict of columns that pandas.DataFrame takes as it is.

    `slopes`: a row a soil, load, way ("up", "down", "across") and slope; `wheel`: a row a soil, load and slip of a
    wheel under its mean load; `limits`: a row a soil and load. Units stand in the names of columns; NaN where there
    is nothing. NAME_low and NAME_high are 5 and 95 % points over the soils that were drawn.
    """

    def __init__(self, document: "dict[str, Any]", svg: str) -> None:
        self.document = document  # what `rockyard mobility --json` prints
        self.svg = svg
        self._tables = {name: {column: _array(cells) for column, cells in document[name].items()} for name in TABLES}

    def __getitem__(self, table: str) -> "dict[str, Array]":
        return self._tables[table]

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)

    def save(self, file: "str | PathLike[str]") -> Path:
        """Writes the charts as SVG and returns the file."""
        path = Path(file)
        path.write_text(self.svg, encoding="utf-8")
        return path

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        rows = ", ".join(f"{name} of {len(next(iter(table.values())))} rows" for name, table in self.items())
        return f"<Mobility of {self.document['rover']}: {rows}>"


def mobility(rover: "str | PathLike[str] | Scenario", *, set: "Mapping[str, Any] | None" = None,
             soils: "str | Iterable[str]" = (), slopes: "Iterable[float]" = range(26),
             loads: "Iterable[float]" = (1.0,), slip_limit: float = 0.8, draws: int = 20, seed: int = 1,
             points: "str | PathLike[str] | None" = None, steps: bool = True, fidelity: str = "quasi_static",
             threads: int = 0, progress: "Progress | None" = None) -> Mobility:
    """Returns how a rover gets on on slopes (deg) and over steps, on one soil and under one load after another.

    `rover`: a scenario, its name, a rover file or a URDF file. `soils`: presets of terrain.ground.soil, and "own"
    for that of the scenario; none: landscaping_sand, mars_drift and hard_ground. `loads`: factors of all masses. Bands come from `draws` soils drawn
    by terrain.ground.soil.spread. What comes back does not depend on `threads`. Raises InputError. Cost: about half
    a minute of one processor for three soils, 26 slopes and 20 draws.
    """
    if fidelity not in ("quasi_static", "multibody"):
        raise InputError([Problem("fidelity", f"is {fidelity!r}", "use quasi_static or multibody")])
    if not 0.0 < slip_limit <= 1.0:
        raise InputError([Problem("slip_limit", f"is {slip_limit}", "use a slip above 0, at most 1")])
    factors = [float(load) for load in loads]
    if not factors or not all(0.01 <= load <= 100 for load in factors):
        raise InputError([Problem("loads", f"are {factors}", "use factors from 0.01 to 100")])
    with tempfile.TemporaryDirectory() as folder:
        source = str(rover)
        if isinstance(rover, Scenario):
            source = str(Path(folder) / f"{Path(rover.name).name or 'rover'}.json")
            rover.save(source)
        outcome, text, svg = _core.mobility(
            source, assignments(set), _listed(soils), factors, [float(slope) for slope in slopes], slip_limit,
            whole("draws", draws, 1000), whole("seed", seed, MOST_SEED), steps, fidelity == "multibody",
            "" if points is None else str(points), whole("threads", threads, 256), _shown(progress))
    if outcome == INTERRUPTED:
        raise KeyboardInterrupt
    return Mobility(json.loads(text), svg)
