#!/usr/bin/env python3
"""Laws of a wheel on soil against wheels and a rover that were measured, none of them fitted to what it is judged by.

Reads results/reference/wheels; with --wheels a file of other wheels in the same format, of which it prints the scores.
Tables (the page says what was declared before any law was scored):
  verdict      every law, and which is the default by the rule
  wheels       RMSE, skill and coverage on each wheel, by groups of rows
  soils        constants of each soil, and what the smooth KLS-1 wheel makes of its
  lugs         the lugged KLS-1 wheel by the soil as listed and as calibrated, and by the count of its lugs
  rover        slopes that a rover climbs at given slips, and what is assumed of it
  scaling      wheels of other sizes under other gravity, with equal load over density, gravity and size
  gravity      the VIPER wheel under the same load and less gravity
  resistance   torque less pull, and the most that a rim can meet
Writes wheel_soil.csv, a row each measured row and law, and wheel_soil.svg.

    scripts/studies/wheel_soil/wheel_soil.py [--wheels FILE] [--out FOLDER] [--markdown results/wheel_soil.md]
"""

import sys
from dataclasses import replace
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import numpy as np  # noqa: E402
import study  # noqa: E402
from wheel_soil import data, figure, laws, rover, scores, tables  # noqa: E402

MEASURED = study.ROOT / "results/reference/wheels"
# The soil of the second is calibrated on the first.
CALIBRATED = {"kls1_lug10": "kls1_smooth"}
LUGS_TRIED = (10, 13)
SIDE_SLIP = 0.5  # of the figure


def judge_all(wheels):
    """Judgements by wheel and law, in order; soils that were calibrated, by law."""
    by_name = {wheel.name: wheel for wheel in wheels}
    fitted = {}
    for source in set(CALIBRATED.values()) & set(by_name):
        for law in laws.LAWS:
            fitted[source, law] = scores.calibrated(by_name[source], law)
    found = {}
    for wheel in wheels:
        for law in laws.LAWS:
            made = scores.judge(wheel, law, fitted.get((CALIBRATED.get(wheel.name, wheel.name), law)))
            if made:
                found[wheel.name, law] = made
    return found, fitted


def csv_rows(judged):
    """A row each measured row and law."""
    rows = []
    for made in judged.values():
        wheel, groups = made.wheel, made.wheel.groups()
        for i in range(len(wheel.rows["slip"])):
            row = {"wheel": wheel.name, "law": made.law, "group": next(name for name, mask in groups.items() if mask[i]),
                   "slip": wheel.rows["slip"][i], "slip_angle_deg": wheel.rows["slip_angle_deg"][i],
                   "load_N": wheel.rows["load_N"][i]}
            for name in scores.QUANTITIES:
                row |= {f"{name}_measured": wheel.measured[name][i], name: made.predicted[name][i],
                        f"{name}_low": made.bands[name][0][i], f"{name}_high": made.bands[name][1][i]}
            rows.append({key: ("" if np.isnan(value) else round(float(value), 5)) if isinstance(value, float) else value
                         for key, value in row.items()})
    return rows


def curves(wheel, judged, quantity, angles_deg=None):
    """By law, and by Bekker's with slip sinkage last, which is drawn for reference; over slips, or slip angles."""
    load_N = float(np.nanmedian(wheel.rows["load_N"]))
    slips = np.linspace(0.0, max(0.6, float(wheel.rows["slip"].max())), 40)
    at = (slips, 0.0) if angles_deg is None else (SIDE_SLIP, np.radians(angles_deg))
    made = [laws.wheel_of(wheel, law, judged[wheel.name, law].soil) for law in laws.LAWS]
    made.append(laws.wheel_of(wheel, laws.CONTROL, judged[wheel.name, laws.CONTROL].soil, slip_sinkage=True))
    over = slips if angles_deg is None else angles_deg
    return [list(zip(over, laws.shares(each, wheel.radius_m, load_N, *at)[quantity])) for each in made]


def draw(path, wheels, judged, climbs, campaigns):
    words = {"pull": "pull over load", "torque": "torque over radius and load", "sinkage": "sinkage, mm"}
    panels = []
    for wheel in wheels:
        known = all((wheel.name, law) in judged for law in laws.LAWS)
        mask = wheel.groups()["driven"]
        for quantity, what in words.items():
            values = wheel.measured[quantity]
            if not np.isfinite(values[mask]).any():
                continue
            scatter = wheel.scatter[quantity] if known else np.nan
            points = [(wheel.rows["slip"][i], values[i], scatter) for i in np.flatnonzero(mask)]
            panels.append((f"{wheel.label}: {what}", "slip", points,
                           curves(wheel, judged, quantity) if known else []))
        side, turned = wheel.measured["side"], np.abs(wheel.rows["slip"] - SIDE_SLIP) < 0.02
        if np.isfinite(side[turned]).any():
            points = [(wheel.rows["slip_angle_deg"][i], side[i], wheel.scatter["side"]) for i in np.flatnonzero(turned)]
            panels.append((f"{wheel.label}: side force over load, slip {SIDE_SLIP:g}", "slip angle, deg", points,
                           curves(wheel, judged, "side", np.linspace(0.0, 90.0, 40))))
    points = [(slip, slope, 0.3) for slopes, slips in campaigns.values() for slope, slip in zip(slopes, slips)]
    panels.append(("MGRU3 on GRC-1: slope, deg", "slip", points, climbs["curves"]))
    figure.write(path, panels, [*laws.LAWS, "bekker, slip sinkage"])


def climb_all(told, campaigns):
    """Slopes of the rover by law and slip: central, over the band of soils, without levers; curves for the figure."""
    shape, soil = told["rover"]["wheel"], data.Soil(**data.DECLARED[told["soil"]["id"]])
    weight_N = told["rover"]["wheels"] * told["rover"]["load_kg"] * 9.81
    found = {"measured": {year: [rover.crossing_deg(*campaign, slip) for slip in rover.SLIPS]
                          for year, campaign in campaigns.items()}, "laws": {}, "curves": []}

    def wheel(law, share, **other):
        state = replace(soil.at_pair(share), **other)
        values = laws.settings(law, state, 1e-3 * shape["width_mm"])
        return study.ry.Wheel(values, 1e-3 * shape["radius_mm"], 1e-3 * shape["width_mm"], 1e-3 * shape["lug_height_mm"],
                              shape["lug_count"], 9.81, weight_N)

    def slopes(made, slips=rover.SLIPS, **more):
        return [rover.slope_deg(made, weight_N, slip, **more) for slip in slips]

    for law in laws.LAWS:
        loosest, densest = wheel(law, 0.0), wheel(law, 1.0)
        found["laws"][law] = {"loosest": slopes(loosest), "densest": slopes(densest),
                              "loosest, equal loads": slopes(loosest, levers=False)} | {
            f"loosest, c {c_Pa:g} Pa": slopes(wheel(law, 0.0, c_Pa=c_Pa, plates_c_Pa=c_Pa)) for c_Pa in (0.0, soil.plates_c_Pa)}
        over = np.linspace(0.02, 0.95, 40)
        found["curves"].append(list(zip(over, slopes(loosest, over))))
    return found


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser)
    study.add_page(parser)
    parser.add_argument("--wheels", type=Path, metavar="FILE", help="wheels to score instead, by the same rules")
    parser.add_argument("--lugs-added", default="", metavar="NAMES", help="wheels of that file whose radius is told without lugs")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/studies")
    args = parser.parse_args()
    wheels = data.read_wheels(args.wheels or MEASURED / "wheel_soil.json", args.lugs_added.split(","))
    judged, fitted = judge_all(wheels)
    if args.wheels:
        study.show(args, {"wheels": tables.wheels(wheels, judged)})
        return
    climbs = climb_all(*(campaign := data.read_slopes(MEASURED / "slopes.json")))
    listed = {law: scores.judge(wheel, law) for wheel in wheels if wheel.name in CALIBRATED for law in laws.LAWS}
    lugged = {count: scores.judge(tables.with_lugs(wheel, count), law, fitted[CALIBRATED[wheel.name], law])
              for wheel in wheels if wheel.name in CALIBRATED for law in ("intrusion",) for count in LUGS_TRIED}
    args.out.mkdir(parents=True, exist_ok=True)
    study.write_csv(args.out / "wheel_soil.csv", csv_rows(judged))
    draw(args.out / "wheel_soil.svg", wheels, judged, climbs, campaign[1])
    study.show(args, {"verdict": tables.verdict(judged, climbs), "wheels": tables.wheels(wheels, judged),
                      "soils": tables.soils(wheels, fitted), "lugs": tables.lugs(judged, listed, lugged), "rover": tables.rover(climbs),
                      "scaling": tables.scaling(), "gravity": tables.gravity(wheels), "resistance": tables.resistance(wheels)})


if __name__ == "__main__":
    main()
