"""Laws of a wheel on soil, what they say of a measured wheel, and bands of soils that are not known better."""

import math
from dataclasses import replace

import numpy as np
from study import ry

# By name: law and pressure of terrain.ground.soil. The first is the negative control.
LAWS = {"bekker": ("bekker", "plate"), "wong_reece": ("wong_reece", "plate"),
        "resistive_force": ("resistive_force", "density"), "intrusion": ("intrusion", "density"),
        "intrusion, plate": ("intrusion", "plate")}
CONTROL = "bekker"
# Standard deviations of soils, those of terrain.ground.soil.spread: degrees, and natural logarithms.
PHI_DEG, LOG_DENSITY, LOG_MODULUS, LOG_COHESION, LOG_SHEAR = 2.0, 0.04, 0.25, 0.5, 0.5
DRAWS, SEED = 200, 2011
BAND = (0.05, 0.95)


def settings(law, soil, width_m, slip_sinkage=False):
    """terrain.ground.soil of a law, or None where a constant that it needs is not known."""
    name, pressure = LAWS[law]
    needed = (soil.phi_deg, soil.density_kg_m3) if pressure == "density" else (soil.phi_deg, soil.n, soil.kphi)
    if None in needed:
        return None
    cohesion_Pa = soil.c_Pa if pressure == "density" or soil.plates_c_Pa is None else soil.plates_c_Pa
    made = {"law": name, "pressure": pressure, "cohesion_Pa": cohesion_Pa, "friction_angle_deg": soil.phi_deg,
            "shear_modulus_m": soil.K_m, "slip_sinkage": {"enabled": slip_sinkage}}
    if pressure == "density":
        return made | {"density_kg_m3": soil.density_kg_m3}
    # A fit may give a negative k_c: the sum over the width of this wheel is what counts.
    kc, kphi = (soil.kc, soil.kphi) if soil.kc >= 0.0 else (0.0, soil.kphi + soil.kc / width_m)
    return made | {"sinkage_exponent": soil.n, "cohesive_modulus_N_per_mn1": kc, "frictional_modulus_N_per_mn2": kphi}


def wheel_of(measured, law, soil=None, largest_N=None, **more):
    """The wheel of rockyard that stands for a measured one, or None."""
    values = settings(law, soil or measured.soil, measured.width_m, **more)
    if values is None:
        return None
    return ry.Wheel(values, measured.radius_m, measured.width_m, measured.lug_height_m, measured.lug_count,
                    measured.gravity_m_s2, largest_N or 4.0 * float(np.nanmax(measured.rows["load_N"])))


def predict(measured, law, soil=None):
    """Shares of the load and mm, as MeasuredWheel.measured, in its rows, NaN without a load; None where the law cannot
    be asked."""
    rows = measured.rows
    known = np.isfinite(rows["load_N"]) & np.isfinite(rows["slip"])
    wheel = wheel_of(measured, law, soil) if known.any() else None
    if wheel is None:
        return None
    found = {name: np.full(known.shape, np.nan) for name in measured.measured}
    told = shares(wheel, measured.radius_m, *(rows[name][known] for name in ("load_N", "slip")),
                  np.radians(rows["slip_angle_deg"][known]))
    for name, values in told.items():
        found[name][known] = values
    return found


def shares(wheel, radius_m, load_N, slip, angle_rad=0.0):
    told = wheel.steady(load_N, slip, angle_rad)
    return {"pull": told["pull_N"] / load_N, "torque": told["torque_Nm"] / (radius_m * load_N),
            "side": told["side_N"] / load_N, "sinkage": 1e3 * told["sinkage_m"]}


def drawn(soil):
    """Soils about one of which no more is known: DRAWS of them, the same random numbers for every law."""
    random = np.random.default_rng(SEED)
    for _ in range(DRAWS):
        phi, density, modulus, cohesion, shear = random.standard_normal(5)
        share = random.uniform()
        known = soil.at_pair(share) if soil.pairs else replace(
            soil, phi_deg=min(max(soil.phi_deg + PHI_DEG * phi, 1.0), 59.0),
            density_kg_m3=soil.density_kg_m3 and soil.density_kg_m3 * math.exp(LOG_DENSITY * density))
        factor = math.exp(LOG_MODULUS * modulus)
        yield replace(known, kphi=known.kphi and known.kphi * factor, kc=known.kc * factor,
                      c_Pa=known.c_Pa * math.exp(LOG_COHESION * cohesion), K_m=known.K_m * math.exp(LOG_SHEAR * shear))


def draw(measured, law, soil):
    """Predictions over soils about one, by quantity: a line each soil."""
    all_of = [predict(measured, law, each) for each in drawn(soil)]
    return {name: np.array([one[name] for one in all_of]) for name in measured.measured}


def bands(measured, draws):
    """Ends of the band of predictions over soils, by quantity: arrays of the rows. With them those of what would be
    measured, with the scatter of the measurement."""
    random = np.random.default_rng(SEED + 1)
    found = {}
    for name, values in draws.items():
        scatter = measured.scatter[name]
        noisy = values + (scatter if math.isfinite(scatter) else 0.0) * random.standard_normal(values.shape)
        found[name] = (*np.quantile(values, BAND, axis=0), *np.quantile(noisy, BAND, axis=0))
    return found
