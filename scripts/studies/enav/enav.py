#!/usr/bin/env python3
"""ACE and p-ACE beside Ghosh 2018, and from the map to the wheels.

Runs scenarios/arc_planning/ghosh_2018.json, as it is and with what the paper leaves open changed, and the program
tests/navigation/enav/enav_study.cc, and prints tables:
  enav_success   maps with a path by cover and risk, beside figure 9
  enav_poses     poses that ACE refuses, beside figures 7 and 8
  enav_envelope  both with one assumption changed
  enav_chain     poses that ACE passes though the rover would break a limit, by cells, errors of heights and sinkage
  enav_space     how far a stance in space leaves ACE's bounds, by the length of the wheel boxes

    scripts/studies/enav/enav.py --program BUILD/tests/navigation/enav_study [--markdown results/enav.md]
"""

import argparse
import csv
import math
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

SCENARIO = study.ROOT / "scenarios/arc_planning/ghosh_2018.json"
# Figure 9 by cover, %: ACE, then p-ACE at the risks.
PUBLISHED = {1: (1, 1, 1, 1, 1), 3: (.862, .862, .931, .933, .933), 5: (.405, .553, .590, .689, .690),
             7: (0, .053, .333, .463, .524), 10: (0, 0, .030, .286, .457), 12: (0, 0, 0, .038, .158),
             15: (0, 0, 0, 0, .058)}
GEOMETRY, GROUND = "rover.geometry.", "terrain.ground."
# What is changed, and how: each with 100 maps a cell, those of FEWER with 20.
VARIANTS = {
    "as assumed": [],
    "three quarters of the size, clearance kept": [f"{GEOMETRY}{name}={value}" for name, value in {
        "wheelbase_m": 0.63, "length_m": 0.83, "width_m": 0.65, "belly_length_m": 0.5, "belly_width_m": 0.36,
        "arm_y_m": 0.2, "rocker_pivot_x_m": 0.075}.items()],
    "five quarters of the size, clearance kept": [f"{GEOMETRY}{name}={value}" for name, value in {
        "wheelbase_m": 1.05, "length_m": 1.3, "width_m": 1.04, "belly_length_m": 0.82, "belly_width_m": 0.65,
        "arm_y_m": 0.36, "rocker_pivot_x_m": 0.125}.items()],
    "suspension of the Athena SDM": [f"{GEOMETRY}rocker_pivot_z_m=0.29", f"{GEOMETRY}bogie_pivot_z_m=0.2"],
    "wheel boxes of two diameters": ["navigation.enav.ace.wheel_box_diameters=2"],
    "wheel boxes of half a diameter": ["navigation.enav.ace.wheel_box_diameters=0.5"],
    "cells of 10 cm": ["arc_planning.map_cell_m=0.1"],
    "cells of 2.5 cm": ["arc_planning.map_cell_m=0.025"],
    "ground of 2 cm rms": [f"{GROUND}roughness_rms_m=0.02"],
    "ground of 5 cm rms": [f"{GROUND}roughness_rms_m=0.05"],
    "rocks from 5 cm": ["terrain.rocks.min_diameter_m=0.05"],
    "rocks from 20 cm": ["terrain.rocks.min_diameter_m=0.2"],
    "rocks up to 2 m": ["terrain.rocks.max_diameter_m=2"],
    "goal within 0.3 m": ["arc_planning.goal_tolerance_m=0.3"],
    "ends not kept free": ["terrain.rocks.clear_radius_m=0"],
}
FEWER = {"ground of 5 cm rms", "rocks from 5 cm", "rocks from 20 cm", "rocks up to 2 m", "goal within 0.3 m", "ends not kept free"}


def share(count, total):
    low, high = rates.exact_interval(int(count), int(total))
    return study.with_interval((count / total, low, high), 2) if total else "-"


def verdicts(args, run):
    """Of the rows of the reference, by id."""
    path = args.out / "verdicts.csv"
    study.called([args.rockyard, "check", run, "--against", study.ROOT / "results/reference/enav.json", "--csv", path],
                 codes=(0, 1, 2))
    return {row["id"]: row["verdict"] for row in study.read_csv(path)}


def success(args, runs):
    run = runs("as assumed")
    judged = verdicts(args, run.folder)
    cells = study.cells_of(study.counted(run), ("cover", "risk"))
    lines = []
    for cover, published in PUBLISHED.items():
        for (_, risk), printed in zip(sorted(key for key in cells if round(100 * key[0]) == cover), published):
            rows = cells[next(key for key in cells if round(100 * key[0]) == cover and key[1] == risk)]
            name = "ace" if risk == 0 else f"1e-{round(-math.log10(risk))}"
            lines.append([f"{cover}", "ACE" if risk == 0 else name, f"{printed:.3f}",
                          share(rows.found.sum(), rows.open_maps.sum()),
                          f"{rows.open_maps.sum():.0f} of {rows.maps.sum():.0f}", judged[f"success.{name}.{cover}"]])
    return study.table(["cover, %", "risk", "figure 9", "found", "open maps", "verdict"], lines)


def poses(args, runs):
    run = runs("as assumed")
    judged = verdicts(args, run.folder)
    rows = study.counted(run)
    part = {cover: rows[abs(rows.cover - cover / 100) < 1e-6] for cover in (5, 10)}
    lines = [[f"refused by ACE, rocks on {cover} %", f"{printed:.3f}",
              share(part[cover].refused.sum(), part[cover].poses.sum()), judged[f"refused.{cover}"]]
             for cover, printed in ((5, 0.114), (10, 0.319))]
    lines += [[f"of the refused: {what}", printed, share(rows[column].sum(), rows.refused.sum()), judged[column]]
              for column, what, printed in (("unlikely", "risk of at most 0.01", "0.150"),
                                            ("likely", "risk above 0.9", "0.397"))]
    return study.table(["poses", "figures 7 and 8", "here", "verdict"], lines)


def envelope(_, runs):
    lines = []
    for name in VARIANTS:
        rows = study.counted(runs(name))
        line = [name]
        for risk in (0.0, 1e-3):
            for cover in (0.05, 0.1):
                cell = rows[(abs(rows.cover - cover) < 1e-6) & (rows.risk == risk)]
                line.append(share(cell.found.sum(), cell.open_maps.sum()))
        line += [share(part.refused.sum(), part.poses.sum())
                 for part in (rows[abs(rows.cover - cover) < 1e-6] for cover in (0.05, 0.1))]
        lines.append(line)
    lines.append(["Ghosh 2018", "0.405", "0.000", "0.690", "0.457", "0.114", "0.319"])
    return study.table(["changed", "found by ACE, 5 %", "10 %", "p-ACE at 1e-3, 5 %", "10 %", "refused, 5 %", "10 %"],
                       lines)


def printed(args, part):
    return list(csv.DictReader(study.run([args.program, part, args.grounds]).splitlines()))


def chain(args, _):
    def of(column, base):
        return lambda row: f"{100 * int(row[column]) / max(1, int(row[base])):.2f}"
    return study.listed(printed(args, "chain"), {
        "cells, cm": lambda row: f"{100 * float(row['cell_m']):g}",
        "error of a cell, cm": lambda row: f"{100 * float(row['error_m']):g}",
        "sinkage up to, cm": lambda row: f"{100 * float(row['sinkage_m']):g}",
        "poses": "{poses}", "unsafe, %": of("unsafe", "poses"), "passed, %": of("passed", "poses"),
        "false safe, % of passed": of("false_safe", "passed"),
        "of these tilt, joints, clearance": "{tilt}, {joints}, {clearance}",
        "false unsafe, % of poses": of("false_unsafe", "poses")})


def space(args, _):
    return study.listed(printed(args, "space"), {
        "box, diameters": "{diameters}", "poses": "{poses}",
        "outside of a bound, %": lambda row: f"{100 * int(row['outside']) / int(row['poses']):.1f}",
        "mean excess, deg": "{mean_excess_deg}", "largest, deg": "{largest_excess_deg}",
        "largest of the height, m": "{largest_excess_m}"})


TABLES = {f"enav_{f.__name__}": f for f in (success, poses, envelope, chain, space)}


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, 3500, "enav")
    parser.add_argument("--program", type=Path, help="the built enav_study, for enav_chain and enav_space")
    parser.add_argument("--grounds", type=int, default=100, help="random grounds of 100 poses (100)")
    args = study.parse_with_tables(parser, TABLES)
    args.out.mkdir(parents=True, exist_ok=True)
    made = {}

    def runs(name):
        if name not in made:
            folder = args.out / name.replace(" ", "_").replace(",", "")
            trials = args.trials // 5 if name in FEWER else args.trials
            made[name] = study.run_scenario(argparse.Namespace(**{**vars(args), "trials": trials}), SCENARIO, folder,
                                            [*VARIANTS[name], *args.set])
        return made[name]

    study.show(args, {name: TABLES[name](args, runs) for name in args.tables.split(",")})


if __name__ == "__main__":
    main()
