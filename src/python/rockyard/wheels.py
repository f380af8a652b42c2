"""One wheel on level soil, as rigs measure it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Mapping

import numpy as np

from . import _core
from .errors import InputError, Problem, whole

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

FORCES = ("pull_N", "side_N", "torque_Nm", "sinkage_m", "resistance_N")


class Wheel:
    """A rigid wheel of one kind on one soil, by the law that the soil names.

    `soil`: settings of `terrain.ground.soil`, as scenario files have them; those that are left out are of
    its preset. `radius_m` reaches to the tips of the lugs. Laws of stresses over the rim are tabulated up
    to `largest_load_N` and within 1 % of the law from a thousandth of it on. Raises InputError with what
    is wrong, unknown settings by their names. src/rover/steady_wheel.h has the equations.
    """

    def __init__(self, soil: Mapping[str, Any], radius_m: float, width_m: float, lug_height_m: float = 0.0,
                 lug_count: int = 0, gravity_m_s2: float = 9.81, largest_load_N: float = 1000.0) -> None:
        try:
            text = json.dumps(dict(soil))
        except (TypeError, ValueError) as error:
            raise InputError([Problem("soil", str(error), "use a mapping of settings of terrain.ground.soil")]) from None
        self._core = _core.Wheel(text, float(radius_m), float(width_m), float(lug_height_m),
                                 whole("lug_count", lug_count, 1000), float(gravity_m_s2), float(largest_load_N))

    def steady(self, load_N: Any, slip: Any, slip_angle_rad: Any = 0.0) -> dict[str, "Array"]:
        """Returns what a carriage at a steady speed measures, by name, each in the shape of the arguments together.

        `slip` is (rim speed - travel speed) over the larger of the two, in (-1, 1): negative where the wheel
        skids. `slip_angle_rad`, in [-pi/2, pi/2], is the one between travel and the plane of the wheel.
        pull_N: forward in that plane; side_N: across it, of the sign of the slip angle; torque_Nm of the axle;
        sinkage_m; resistance_N: what of the pull the soil takes. Raises InputError where an argument is out
        of bounds, or a load above `largest_load_N`.
        """
        given = np.broadcast_arrays(*(np.asarray(value, float) for value in (load_N, slip, slip_angle_rad)))
        rows = self._core.steady(*(np.ravel(value) for value in given))
        return {name: row.reshape(given[0].shape) for name, row in zip(FORCES, rows)}
