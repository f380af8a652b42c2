"""How far laws are from measured wheels, group by group of rows."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
from wheel_soil import laws

QUANTITIES = ("pull", "torque", "side", "sinkage")
PRESSURE_FACTOR = math.log(2.0)  # that a calibration may change the pressure by
NODES, ROUNDS = 13, 7


@dataclass(frozen=True)
class Judged:
    """A law on a wheel: predictions in its rows by one soil and by others about it (`draws`), and their bands."""
    wheel: object
    law: str
    soil: object
    predicted: dict = field(repr=False)
    draws: dict = field(repr=False)
    bands: dict = field(repr=False)

    def errors(self, quantity, mask):
        """Predicted less measured in the rows of a group in which it was measured."""
        error = (self.predicted[quantity] - self.wheel.measured[quantity])[mask]
        return error[np.isfinite(error)]

    def score(self, quantity, group, control):
        """RMSE, the same over the scatter of the measurement, skill against the control, and how many of the measured
        points lie in the bands; None where the group has none."""
        mask = self.wheel.groups()[group]
        error = self.errors(quantity, mask)
        if not error.size:
            return None
        mean = np.mean(error**2)
        low, high, noisy_low, noisy_high = (end[mask] for end in self.bands[quantity])
        value = self.wheel.measured[quantity][mask]
        return {"rows": error.size, "rmse": math.sqrt(mean), "bias": float(np.mean(error)),
                "over_scatter": math.sqrt(mean) / self.wheel.scatter[quantity],
                "skill": 1.0 - mean / np.mean(control.errors(quantity, mask)**2),
                "inside": int(((value >= low) & (value <= high)).sum()),
                "inside_noisy": int(((value >= noisy_low) & (value <= noisy_high)).sum())}


    def drawn_skill(self, quantity, group, control):
        """Skill in each of the soils, the control in the same."""
        def squares(judged):
            error = (judged.draws[quantity] - self.wheel.measured[quantity])[:, self.wheel.groups()[group]]
            return np.nanmean(error**2, axis=1)

        return 1.0 - squares(self) / squares(control)


def judge(wheel, law, soil=None):
    """None where the law needs a constant that is not known of the soil."""
    soil = soil or wheel.soil
    predicted = laws.predict(wheel, law, soil)
    if predicted is None:
        return None
    draws = laws.draw(wheel, law, soil)
    return Judged(wheel, law, soil, predicted, draws, laws.bands(wheel, draws))


def calibrated(wheel, law):
    """The soil with the friction angle and the pressure (density, or both moduli) that are best for a law on one
    wheel: least squares of pull, torque and sinkage over their scatter, on a grid that is refined."""
    if laws.predict(wheel, law) is None:
        return None

    def soil_of(phi_deg, log_factor):
        factor = math.exp(log_factor)
        return replace(wheel.soil, phi_deg=phi_deg, density_kg_m3=wheel.soil.density_kg_m3 * factor,
                       kphi=wheel.soil.kphi * factor, kc=wheel.soil.kc * factor)

    def loss(soil):
        predicted, measured = laws.predict(wheel, law, soil), wheel.measured
        return sum(np.nansum(((predicted[name] - measured[name]) / wheel.scatter[name])**2)
                   for name in ("pull", "torque", "sinkage"))

    middle, half = (35.0, 0.0), (25.0, PRESSURE_FACTOR)
    for _ in range(ROUNDS):
        tried = [(phi, factor) for phi in np.linspace(middle[0] - half[0], middle[0] + half[0], NODES)
                 for factor in np.linspace(middle[1] - half[1], middle[1] + half[1], NODES)
                 if 5.0 <= phi <= 59.0 and abs(factor) <= PRESSURE_FACTOR]
        middle = min(tried, key=lambda each: loss(soil_of(*each)))
        half = (half[0] / 2.5, half[1] / 2.5)
    return soil_of(*map(float, middle))


def most_resistance(wheel):
    """Rows of slip, resistance over load (torque less pull) and the most that a rim can meet at the sinkage told.

    With stresses into the rim and along it, R = r b int (sigma sin + tau (1 - cos)), W = r b int (sigma cos + tau sin),
    so that R / W is no more than tan(theta_1), cos(theta_1) = 1 - z / r: (1 - cos) / sin is less than sin / cos, and the
    rim of a driven wheel slides back everywhere, tau >= 0.
    """
    measured = wheel.measured
    entry = np.arccos(1.0 - 1e-3 * measured["sinkage"] / wheel.radius_m)
    return [row for row in zip(wheel.rows["slip"], measured["sinkage"], measured["torque"] - measured["pull"], np.tan(entry))
            if np.all(np.isfinite(row))]
