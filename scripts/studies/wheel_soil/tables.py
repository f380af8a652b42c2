"""Tables of the page results/wheel_soil.md."""

import math
from dataclasses import replace

import numpy as np
import study
from wheel_soil import laws, rover as climbing, scores

SHOWN = {"pull": ("pull / load", 3), "torque": ("torque / (r load)", 3), "side": ("side / load", 3), "sinkage": ("sinkage, mm", 1)}
# The rule of the default: the largest mean skill of pull and sinkage on driven wheels whose soil was measured,
# among laws that are no worse than the control on these.
BY_SKILL = ("ding2011_smooth", "cmu_k10mini_smooth")
NOT_WORSE_ON = "nasa_trec_viper_grc3"
PREDICTED = "kls1_lug10"


def _score(judged, wheel, law, quantity, group="driven"):
    made = judged.get((wheel, law))
    if made is None or group not in made.wheel.groups():
        return None
    return made.score(quantity, group, judged[wheel, laws.CONTROL])


def _shown(score, key, digits):
    return "n/a" if score is None or not math.isfinite(score[key]) else f"{score[key]:.{digits}f}"


def mean_skill(judged, law):
    return float(np.mean([_score(judged, wheel, law, quantity)["skill"] for wheel in BY_SKILL
                          for quantity in ("pull", "sinkage")]))


def mean_skill_band(judged, law):
    """Of the mean skill over the soils that the wheels may have stood on."""
    drawn = [judged[wheel, law].drawn_skill(quantity, "driven", judged[wheel, laws.CONTROL]) for wheel in BY_SKILL
             for quantity in ("pull", "sinkage")]
    return np.quantile(np.mean(drawn, axis=0), laws.BAND)


def rover_errors(climbs, law):
    """Distance of the slope at each slip from the nearest campaign, degrees; a rover that does not climb is at 0."""
    return [min(abs((0.0 if math.isnan(slope) else slope) - campaign[i]) for campaign in climbs["measured"].values())
            for i, slope in enumerate(climbs["laws"][law]["loosest"])]


def default_law(judged, climbs):
    """The law by the rule, and by law whether it may be it."""
    def rms(law):
        return math.sqrt(np.mean(np.square(rover_errors(climbs, law))))

    allowed = {law: rms(law) <= rms(laws.CONTROL) and
               _score(judged, NOT_WORSE_ON, law, "pull")["rmse"] <= _score(judged, NOT_WORSE_ON, laws.CONTROL, "pull")["rmse"]
               for law in laws.LAWS}
    return max((law for law in laws.LAWS if allowed[law]), key=lambda law: mean_skill(judged, law)), allowed


def verdict(judged, climbs):
    best, allowed = default_law(judged, climbs)
    lines = []
    for law in laws.LAWS:
        def cell(wheel, quantity):
            return _shown(_score(judged, wheel, law, quantity), "rmse", SHOWN[quantity][1])
        errors = rover_errors(climbs, law)
        low, high = mean_skill_band(judged, law)
        held = sum(error <= climbing.TOLERANCE_DEG for error in errors)
        word = ("negative control" if law == laws.CONTROL else "not worse than bekker on VIPER and rover"
                if allowed[law] else "worse than bekker on VIPER or rover")
        lines.append([f"`{law}`", *(f"{cell(wheel, 'pull')}, {cell(wheel, 'sinkage')}" for wheel in (*BY_SKILL, PREDICTED)),
                      cell(NOT_WORSE_ON, "pull"), f"{math.sqrt(np.mean(np.square(errors))):.1f} ({held} of {len(errors)})",
                      f"{mean_skill(judged, law):+.2f} ({low:+.2f}..{high:+.2f})", f"{word}; **the default by the rule**" if law == best else word])
    return study.table(["law", "Ding: pull / load, sinkage mm", "CMU", "KLS-1 with lugs", "VIPER: pull / load",
                        "rover: slope, deg (within 2 deg)", "mean skill, Ding and CMU", "verdict"], lines)


def wheels(measured, judged):
    """A line for each wheel, group, quantity: RMSE, over scatter, skill, coverage by law."""
    lines = []
    for wheel in measured:
        for group in wheel.groups():
            for quantity, (words, digits) in SHOWN.items():
                found = [_score(judged, wheel.name, law, quantity, group) for law in laws.LAWS]
                rows = next((score["rows"] for score in found if score), 0)
                if rows:
                    lines.append([wheel.label, f"{group} ({rows})", words] + [
                        "n/a" if score is None else
                        f"{score['rmse']:.{digits}f}, {score['over_scatter']:.1f}, {score['skill']:+.2f}, "
                        f"{score['inside']}/{score['inside_noisy']}" for score in found])
        if not any((wheel.name, law) in judged for law in laws.LAWS):
            lines.append([wheel.label, "all", "not judged: no constants of the soil, or no load"] + ["n/a"] * len(laws.LAWS))
    return study.table(["wheel", "rows", "of", *(f"`{law}`" for law in laws.LAWS)], lines)


def with_lugs(wheel, count):
    return replace(wheel, lug_count=count)


def soils(measured, fitted):
    lines = []
    for wheel in measured:
        soil = wheel.soil
        if soil.phi_deg is not None and not any(wheel.soil is other.soil for other in measured[:measured.index(wheel)]):
            lines.append([wheel.label, "all", f"{soil.phi_deg:g}", f"{soil.density_kg_m3:g}", f"{soil.c_Pa:g}",
                          f"{soil.n:g}", f"{(soil.kc / wheel.width_m + soil.kphi) / 1e3:.0f}", f"{1e3 * soil.K_m:g}", "as listed"])
    for (name, law), soil in fitted.items():
        width = next(wheel.width_m for wheel in measured if wheel.name == name)
        lines.append([name, f"`{law}`", f"{soil.phi_deg:.1f}", f"{soil.density_kg_m3:.0f}" if "density" in laws.LAWS[law] else "-",
                      f"{soil.c_Pa:g}", f"{soil.n:g}", "-" if "density" in laws.LAWS[law] else
                      f"{(soil.kc / width + soil.kphi) / 1e3:.0f}", f"{1e3 * soil.K_m:g}",
                      "friction angle and pressure calibrated on this wheel"])
    return study.table(["soil of", "law", "phi, deg", "density, kg/m3", "c, Pa", "n", "k_c / b + k_phi, kN/m^(n+2)", "K, mm", ""], lines)


def lugs(judged, listed, lugged):
    """The lugged KLS-1 wheel: by the soil as listed and as calibrated, and by the count of its lugs."""
    def cells(made):
        return [f"{made.score(name, 'driven', made)['rmse']:.{digits}f}" for name, (_, digits) in SHOWN.items() if name != "side"]

    lines = [[f"`{law}`", "as listed", "16", *cells(listed[law])] for law in laws.LAWS]
    lines += [[f"`{law}`", "calibrated on the smooth wheel", "16", *cells(judged[PREDICTED, law])] for law in laws.LAWS]
    lines += [["`intrusion`", "calibrated on the smooth wheel", str(count), *cells(made)] for count, made in lugged.items()]
    return study.table(["law", "soil", "lugs", "RMSE of pull / load", "torque / (r load)", "sinkage, mm"], lines)


def rover(climbs):
    lines = [[f"measured {year}", "", *(f"{slope:.1f}" for slope in slopes), ""] for year, slopes in climbs["measured"].items()]
    for law, found in climbs["laws"].items():
        errors = rover_errors(climbs, law)
        for name, slopes in found.items():
            within = ", ".join("yes" if error <= climbing.TOLERANCE_DEG else f"no ({error:.1f})" for error in errors)
            lines.append([f"`{law}`", name, *("none" if math.isnan(slope) else f"{slope:.1f}" for slope in slopes),
                          within if name == "loosest" else ""])
    return study.table(["", "soil", *(f"slip {slip:g}" for slip in climbing.SLIPS), "within 2 deg of the nearest campaign"], lines)


SIZES, GRAVITIES, GRAVITY_SLIP = (0.5, 1.0, 2.0), (1.62, 3.71, 9.81), 0.2


def scaling():
    """Largest difference in pull over load and sinkage over radius from the wheel of size 1 under 9.81 m/s2."""
    soil = {"cohesion_Pa": 0.0, "friction_angle_deg": 35.0, "density_kg_m3": 1600.0}
    slips = np.linspace(0.05, 0.9, 18)

    def of(law, size, gravity):
        name, pressure = laws.LAWS[law]
        load_N = 120.0 * gravity / 9.81 * size**3
        made = study.ry.Wheel(soil | {"law": name, "pressure": pressure}, 0.15 * size, 0.12 * size, 0.008 * size, 20,
                              gravity, 4.0 * load_N)
        told = made.steady(load_N, slips)
        return told["pull_N"] / load_N, told["sinkage_m"] / (0.15 * size)

    lines = []
    for law in laws.LAWS:
        base = of(law, 1.0, 9.81)
        apart = [[float(np.max(np.abs(a - b))) for a, b in zip(of(law, size, gravity), base)] for size in SIZES for gravity in GRAVITIES]
        pull, depth = (max(column) for column in zip(*apart))
        share = max(np.max(np.abs(of(law, size, gravity)[1] / base[1] - 1.0)) for size in SIZES for gravity in GRAVITIES)
        claims = "density" in laws.LAWS[law]
        lines.append([f"`{law}`", "yes" if claims else "no", f"{pull:.4f}", f"{depth:.4f} ({100 * share:.1f} %)",
                      "holds" if pull < 0.01 and share < 0.01 else "does not"])
    return study.table(["law", "claims it", "pull / load differs by", "sinkage / radius differs by", "to 1 %"], lines)


def gravity(measured):
    """The VIPER wheel under one load and ever less gravity: what a rover of reduced mass on Earth does not show."""
    wheel = next(each for each in measured if each.name == NOT_WORSE_ON)
    load_N = float(wheel.rows["load_N"][0])

    def cell(law, gravity_m_s2):
        told = laws.shares(laws.wheel_of(replace(wheel, gravity_m_s2=gravity_m_s2), law), wheel.radius_m, load_N, GRAVITY_SLIP)
        return f"{told['sinkage']:.0f}, {told['pull']:+.2f}"

    return study.table([f"law, {load_N:.0f} N, slip {GRAVITY_SLIP:g}: sinkage mm, pull / load", *(f"{g:g} m/s2" for g in reversed(GRAVITIES))],
                       [[f"`{law}`", *(cell(law, g) for g in reversed(GRAVITIES))] for law in laws.LAWS])


def resistance(measured):
    lines = [[wheel.label, f"{slip:g}", f"{depth:g}", f"{resists:.3f}", f"{most:.3f}", "more than it can" if resists > most else ""]
             for wheel in measured for slip, depth, resists, most in scores.most_resistance(wheel)]
    return study.table(["wheel", "slip", "sinkage, mm", "(torque / r - pull) / load", "most, tan(theta_1)", ""], lines)
