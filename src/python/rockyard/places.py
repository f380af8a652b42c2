"""Terrain and images as arrays. W: x along the course, y left, z up, m."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence

import numpy as np

from . import _core
from .errors import MOST_SEED, InputError, Problem, whole

if TYPE_CHECKING:
    from .scenario import Scenario

    Array = np.ndarray[Any, Any]

ROCK_COLUMNS = ("x_m", "y_m", "z_m", "semi_axis_x_m", "semi_axis_y_m", "semi_axis_z_m", "yaw_rad", "diameter_m", "height_m")


class Grid(NamedTuple):
    """Heights above the nodes of a grid."""

    x_m: "Array"  # nx
    y_m: "Array"  # ny
    height_m: "Array"  # ny x nx, of the highest surface
    ground_m: "Array"  # ny x nx, without rocks

    def __repr__(self) -> str:
        return f"<Grid: {len(self.x_m)} x {len(self.y_m)} heights in m>"


class Place:
    """The terrain of a trial: ground and rocks as they lie at the start."""

    def __init__(self, scenario: "Scenario", trial: int, seed: "int | None" = None) -> None:
        seed = scenario._core.seed if seed is None else whole("seed", seed, MOST_SEED)
        self._core = _core.Place(scenario._core, seed, whole("trial", trial))

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least and largest x, least and largest y of the area that can be driven, m."""
        return self._core.bounds

    def height(self, x_m: Any, y_m: Any) -> "Array":
        """Returns the heights of the highest surface, ground or rock, above points, m."""
        return self._core.height(*np.broadcast_arrays(x_m, y_m))

    def grid(self, step_m: float = 0.05) -> Grid:
        """Returns the heights on a grid over the bounds."""
        if not step_m > 0:
            raise InputError([Problem("step_m", f"is {step_m}", "use a number above 0")])
        x0, x1, y0, y1 = self.bounds
        x_m, y_m = np.arange(x0, x1 + step_m / 2, step_m), np.arange(y0, y1 + step_m / 2, step_m)
        at = np.meshgrid(x_m, y_m)
        return Grid(x_m, y_m, self._core.height(*at), self._core.ground(*at))

    def __repr__(self) -> str:
        x0, x1, y0, y1 = self.bounds
        return f"<Place: {len(self.rocks)} rocks, x {x0:g} .. {x1:g} m, y {y0:g} .. {y1:g} m>"

    @property
    def rocks(self) -> "Array":
        """A structured array, a row a rock: centre, semi-axes, yaw, diameter, height of its top above ground."""
        rows = self._core.rocks()
        made = np.empty(len(rows), [(name, "f8") for name in ROCK_COLUMNS])
        for place, name in enumerate(ROCK_COLUMNS):
            made[name] = rows[:, place]
        return made


class Images(NamedTuple):
    """One look of the stereo cameras."""

    left: "Array"  # rows x columns, counts from 0 to 255
    right: "Array"
    disparity_px: "Array"  # true, of the left image; NaN where the right eye does not see the point
    X_WR: "Array"  # 4 x 4: pose of the rover at rest

    def __repr__(self) -> str:
        rows, columns = self.left.shape
        x, y, z = self.X_WR[:3, 3]
        return f"<Images: two of {columns} x {rows} pixels, from ({x:.2f}, {y:.2f}, {z:.2f}) m>"


def images(scenario: "Scenario", trial: int = 0, pose: "Sequence[float] | None" = None, behind: bool = False) -> Images:
    """Returns what the stereo cameras of the scenario's rover see from x, y, heading (rad); None: the start.

    Cost: half a second for 512 x 512 pixels.
    """
    if pose is not None and (len(pose) != 3 or not np.all(np.isfinite(pose))):
        raise InputError([Problem("pose", f"is {pose!r}", "use x, y, heading (m, rad)")])
    x, y, heading = pose if pose is not None else (None, None, None)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scenario.json"
        scenario.save(file)
        return Images(*_core.images(str(file), scenario._core.seed, whole("trial", trial), x, y, heading, behind))
