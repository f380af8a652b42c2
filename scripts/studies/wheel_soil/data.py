"""Measured wheels and slopes (results/reference/wheels), and files of others in the format of its wheels.

Rows of a wheel are lists, named by its `columns`, or objects; those with a slip angle may stand apart, in
`rows_with_slip_angle`.
"""

import json
from dataclasses import dataclass, field, replace

import numpy as np

# Of the load: what pull scatters by between repeats of one wheel (VIPER's on GRC-3, 8 degrees of freedom).
PULL_SCATTER = 0.046
LOCKED = 0.999  # slip that stands for 1, at which the speed of the rim, or of travel, is 0
DRIVEN = -0.05  # a slip above it is driven

# Declared before any law was scored; soils of others are taken as their files tell.
DECLARED = {
    "Ding2011_planetary_simulant": {"density_kg_m3": 1605.0, "phi_deg": 31.9, "c_Pa": 250.0, "n": 1.1, "kc": 15.6e3,
                                    "kphi": 2407.4e3, "K_m": 0.011},
    "CMU_testbed_sand": {"density_kg_m3": 1330.0, "phi_deg": 29.0, "c_Pa": 0.0, "n": 1.441, "kc": 0.0,
                         "kphi": 9354e3, "K_m": 0.010},
    "KLS-1": {"density_kg_m3": 1600.0, "phi_deg": 40.6, "c_Pa": 1716.0, "n": 1.2594, "kc": -44055.4,
              "kphi": 3581810.6, "K_m": 0.018},
    "GRC-3": {"pairs": ((1627.0, 37.8), (1734.0, 42.0), (1839.0, 47.8)), "c_Pa": 0.0, "n": 0.9, "kc": 1e3,
              "kphi": 700e3, "K_m": 0.018},
    "GRC-1": {"pairs": ((1660.0, 33.4), (1730.0, 37.2), (1760.0, 38.4)), "plates_c_Pa": 250.0, "n": 0.8, "kc": 0.7e3,
              "kphi": 505e3, "K_m": 0.018},
}
ASSUMED_K_M = 0.018
LUGS_ADDED = ("kls1_lug10",)  # wheels whose radius is told without the lugs


@dataclass(frozen=True)
class Soil:
    """Constants, SI but for degrees; None: nobody knows. `pairs`: density and friction angle of several states, which
    those who tell them take without cohesion; `plates_c_Pa`: what a catalogue tells with its constants of plates."""
    phi_deg: float | None = None
    density_kg_m3: float | None = None
    c_Pa: float = 0.0
    n: float | None = None
    kc: float = 0.0
    kphi: float | None = None
    K_m: float = ASSUMED_K_M
    pairs: tuple = ()
    plates_c_Pa: float | None = None

    def at_pair(self, share):
        """The state that lies by that share in [0, 1] from the first pair to the last."""
        places = np.linspace(0.0, 1.0, len(self.pairs))
        density, phi = (float(np.interp(share, places, values)) for values in zip(*self.pairs))
        return replace(self, density_kg_m3=density, phi_deg=phi)


@dataclass(frozen=True)
class MeasuredWheel:
    name: str
    label: str
    radius_m: float
    width_m: float
    lug_height_m: float
    lug_count: int
    gravity_m_s2: float
    soil: Soil
    rows: dict = field(repr=False)  # arrays by column, NaN where nothing was measured
    scatter: dict = field(repr=False)  # of the measurement, by the same names as `measured`

    @property
    def measured(self):
        """Shares of the load, and mm."""
        load = self.rows["load_N"]
        with np.errstate(invalid="ignore"):
            pull = np.where(np.isfinite(self.rows["pull_N"]), self.rows["pull_N"] / load, self.rows["pull_over_load"])
            return {"pull": pull, "torque": self.rows["torque_Nm"] / (self.radius_m * load),
                    "side": self.rows["lateral_N"] / load, "sinkage": self.rows["sinkage_mm"]}

    def groups(self):
        """Rows of each group that the wheel has, as masks."""
        slip, angle = self.rows["slip"], np.abs(self.rows["slip_angle_deg"])
        found = {"driven": (angle == 0) & (slip > DRIVEN), "skidding": (angle == 0) & (slip <= DRIVEN),
                 "slip angle 15..30": (angle > 0) & (angle < 40), "slip angle 45..90": angle >= 40}
        return {name: mask for name, mask in found.items() if mask.any()}


def _number(value):
    return float(value) if isinstance(value, (int, float)) else None


def _soil(told):
    """Of the members of a file: as declared, or as told."""
    if told.get("id") in DECLARED:
        return _central(Soil(**DECLARED[told["id"]]))
    known = {name: _number(told.get(name)) for name in ("phi_deg", "density_kg_m3", "n")}
    cohesion, kc, kphi = (_number(told.get(name)) for name in ("c_kPa", "kc_kN_m_n1", "kphi_kN_m_n2"))
    if kphi is None:
        kc, kphi = 0.0, _number(told.get("keq_kN_m_n2"))
    shear = told.get("K_used_mm", told.get("K_shear_mm"))
    shear = np.mean(shear) if isinstance(shear, list) else _number(shear)
    return _central(Soil(**known, c_Pa=1e3 * (cohesion or 0.0), kc=1e3 * (kc or 0.0), kphi=kphi and 1e3 * kphi,
                         K_m=ASSUMED_K_M if shear is None else 1e-3 * shear,
                         pairs=tuple(map(tuple, told.get("candidates_density_phi", ())))))


def _central(soil):
    return soil.at_pair(0.5) if soil.pairs else soil


COLUMNS = ("slip", "slip_angle_deg", "load_N", "pull_N", "lateral_N", "torque_Nm", "sinkage_mm", "pull_over_load")


def _rows(told):
    listed = told["rows"] + told.get("rows_with_slip_angle", [])
    rows = [row if isinstance(row, dict) else dict(zip(told["columns"], row)) for row in listed]
    default = {"slip_angle_deg": 0.0, "load_N": _number(told.get("load_N"))}
    values = {name: np.array([_number(row.get(name, default.get(name))) for row in rows], float) for name in COLUMNS}
    values["slip"] = np.clip(values["slip"], -LOCKED, LOCKED)
    return values


def _wheel(told, lugs_added):
    shape, scatter = told["wheel"], told.get("uncertainty", {})
    rows = _rows(told)
    lug_m = 1e-3 * (_number(shape.get("lug_height_mm")) or 0.0)
    radius_m = 1e-3 * shape["radius_mm"] + (lug_m if told["wheel_id"] in lugs_added else 0.0)
    load_N = float(np.nanmedian(rows["load_N"])) if np.isfinite(rows["load_N"]).any() else float("nan")
    stated = {name: _number(scatter.get(name)) or float("nan") for name in ("torque_Nm", "lateral_N", "pull_N", "sinkage_mm")}
    side_N = stated["lateral_N"] if np.isfinite(stated["lateral_N"]) else stated["pull_N"]
    return MeasuredWheel(
        told["wheel_id"], told["label"], radius_m, 1e-3 * shape["width_mm"], lug_m, int(shape.get("lug_count") or 0),
        _number(told.get("gravity_m_s2")) or 9.81, _soil(told["soil"]), rows,
        {"pull": PULL_SCATTER, "torque": stated["torque_Nm"] / (radius_m * load_N), "side": side_N / load_N,
         "sinkage": stated["sinkage_mm"]})


def read_wheels(path, lugs_added=()):
    """The wheels of a file; lugs_added: names of those whose radius_mm is without the lugs."""
    with open(path, encoding="utf-8") as file:
        return [_wheel(told, (*LUGS_ADDED, *lugs_added)) for told in json.load(file)["wheels"]]


def read_slopes(path):
    """The rover's document and its campaigns: arrays of slopes and slips by year."""
    with open(path, encoding="utf-8") as file:
        told = json.load(file)
    rows = np.array(told["rows"], float)
    return told, {int(year): (rows[rows[:, 0] == year, 1], rows[rows[:, 0] == year, 2]) for year in np.unique(rows[:, 0])}
