"""An estimator of one's own in Python: where the rover believes to be.

    class Mine(Estimator):
        name, doc = "mine", "encoders and gyro"
        def start(self, setup): ...
        def propagate(self, duration_s, wheel_turn_rad, steer_rad, turn_rad): ...
        def place(self, x_m, y_m, heading_rad, mirrored): ...
        def estimate(self): return estimate(x_m, y_m, heading_rad, distance_m)

SI units, radians; wheels left front, middle, rear, right front, middle, rear. It is asked at every tick
of a drive, 20 times a simulated second: some microseconds each.
"""

from __future__ import annotations

import json
from typing import Any, Sequence, Tuple

from .navigator import Parameters, Values

Pose = Tuple[float, float, float, float]
Estimate = Tuple[Pose, "Pose | None", Tuple[float, float, float], Any]


def estimate(x_m: float, y_m: float, heading_rad: float, distance_m: float, *, odometry: "Pose | None" = None,
             roll_rad: float = 0.0, pitch_rad: float = 0.0, z_m: float = 0.0, covariance: Any = None) -> Estimate:
    """Returns what an estimator believes.

    The pose is that by which a goal is reached, in the frame in which goals are told; distance_m is the
    odometer. `odometry` (x, y, heading, odometer) is the pose that aids leave alone; None: the same.
    `covariance`: 6 x 6, of x, y, z, roll, pitch, heading (m, rad); None: no account is kept.
    """
    return (x_m, y_m, heading_rad, distance_m), odometry, (roll_rad, pitch_rad, z_m), covariance


class Estimator:
    """One object drives one trial. self.p: parameters; self.own: own values by name."""

    name, doc, version = "", "", "1"
    parameters: list[Any] = []  # of rockyard.navigator.parameter()
    own_values: list[Any] = []  # of (name, unit, meaning): columns of the record
    takes_fixes = False  # poses that aids measure
    takes_motions = False  # motions between two moments (visual odometry)

    p: Any
    own: dict[str, float]

    def start(self, setup: Any) -> None:
        """Begins a drive. setup: start (x, y, heading), wheel_radius_m, radius_ratio, wheel_x_m, wheel_y_m,
        steered, lander (x, y, standard deviation of its pan) or None, and what the scenario says of dead
        reckoning: distance_scale, odometry_wheels (all, unsteered, forward), step_heading (midpoint, start),
        attitude_source (level, accelerometers), attitude_filter_s, height (level, integrated)."""

    def propagate(self, duration_s: float, wheel_turn_rad: Sequence[float], steer_rad: Sequence[float],
                  turn_rad: float) -> None:
        """Takes one tick: turns of the wheels, steering angles at its end, the gyro's turn (left positive)."""
        raise NotImplementedError("propagate()")

    def feel(self, felt: Any, duration_s: float) -> None:
        """Takes what the rover felt: articulation_rad, specific_force_R, motor_current_A, contact, or None each."""

    def place(self, x_m: float, y_m: float, heading_rad: float, mirrored: bool) -> None:
        """Operators moved the rover by hand."""
        raise NotImplementedError("place()")

    def capture(self, number: int) -> None:
        """Keeps the present moment, at which an aid takes its data."""

    def forget(self, number: int) -> None:
        """No more data of that moment will come."""

    def fix(self, capture: int, measured: Sequence[bool], pose: Any, covariance: Any, in_lander_frame: bool) -> str:
        """Takes a measured pose; returns used, gated_out, used_in_doubt, unknown or no_interest."""
        return "no_interest"

    def motion(self, start: int, end: int, motion_F: Any, covariance: Any) -> str:
        """Takes a motion between two moments; returns as fix()."""
        return "no_interest"

    def estimate(self) -> Estimate:
        """Returns estimate(...): what is believed now."""
        raise NotImplementedError("estimate()")


def _own_list(made: Estimator) -> list[float]:
    """Returns the own values in the order in which they are declared."""
    names = [value[0] for value in made.own_values]
    for name in made.own:
        if name not in names:
            raise KeyError(f"own value {name} is not declared: there are {', '.join(names)}")
    return [float(made.own[name]) for name in names]


def Made(cls: "type[Estimator]", parameters: str, setup: dict[str, Any]) -> Estimator:
    """Makes the estimator of a drive."""
    made = cls()
    made.p = Parameters(json.loads(parameters, object_hook=Values))
    made.own = {value[0]: 0.0 for value in cls.own_values}
    made.own_list = lambda: _own_list(made)  # type: ignore[attr-defined]
    made.feels = cls.feel is not Estimator.feel  # type: ignore[attr-defined]
    made.start(Values(setup))
    return made
