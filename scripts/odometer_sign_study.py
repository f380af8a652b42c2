#!/usr/bin/env python3
"""Which way the odometer errs, over three assumptions together that the paper leaves open.

Two of the 40 real runs of Matthies 1995, table 4, had a negative distance error (the odometer read
too little), and slip was 5 % worse than on rock-free terrain (section 8). What the simulated
odometer reads depends on whose wheels it counts (all six are too long on arcs), on how tight the
arcs are, and on how many small rocks the wheels climb. This drives nominal terrain, the same trials,
at every combination, the odometer calibrated for its wheels on level sand (straight runs, where
wheels and arcs hardly matter), and writes odometer_sign.csv and odometer_sign.md. No value is chosen
from it.

    scripts/odometer_sign_study.py [--trials 300]
"""

import argparse
import itertools
import statistics
import sys

import study
from calibrate_odometer import calibrate

SCENARIO = study.ROOT / "scenarios/pathfinder/nominal.json"
WHEELS = ("all", "unsteered", "forward")
ARCS_M = ((3.0, 1.0), (1.5, 0.75), (1.0, 0.5))  # wide, tight
SMALLEST_M = (0.05, 0.10, 0.14)
WHEELS_PATH = "perception.dead_reckoning.wheels"


def cells():
    """Names and settings of every cell."""
    for wheels, (wide, tight), smallest in itertools.product(WHEELS, ARCS_M, SMALLEST_M):
        row = {"wheels": wheels, "wide_arc_m": wide, "tight_arc_m": tight,
               "smallest_rock_m": smallest}
        yield row, [f"{WHEELS_PATH}={wheels}", f"navigation.pathfinder.wide_arc_radius_m={wide}",
                    f"navigation.pathfinder.tight_arc_radius_m={tight}",
                    f"terrain.rocks.min_diameter_m={smallest}"]


def measures(columns):
    """Share of negative errors, median and mean error, declared success; all in per cent."""
    errors = columns["distance_error_percent"]
    trials = len(errors)
    declared = sum(outcome in ("goal_reached", "false_goal") for outcome in columns["outcome"])
    below = sum(error < 0.0 for error in errors)
    percent = lambda count: tuple(100.0 * value for value in (
        count / trials, *study.wilson_interval(count, trials)))
    return {"below zero (%)": percent(below), "median error (%)": (statistics.median(errors),),
            "mean error (%)": study.mean_interval(errors), "declared (%)": percent(declared)}


def cell_text(values):
    return study.with_interval(values, 1) if len(values) == 3 else f"{values[0]:.1f}"


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    study.add_run_arguments(parser, trials=300, out="odometer_sign")
    return parser.parse_args()


def main():
    args = parse_arguments()
    held = ["rover.fidelity=quasi_static", *args.set]
    own = {}  # calibrated values, by wheels
    rows, lines, programs = [], [], set()
    for row, settings in cells():
        wheels = row["wheels"]
        if wheels not in own:
            found, _ = calibrate(args.rockyard, [*held, f"{WHEELS_PATH}={wheels}"], seed=args.seed)
            own[wheels] = [f"{path}={value}" for path, value in found.items()]
        folder = args.out / "_".join(str(value) for value in row.values())
        summary = study.run_scenario(args, SCENARIO, folder, [*held, *own[wheels], *settings])
        found = measures(study.trial_columns(folder))
        programs.add(study.program(summary))
        rows.append({**row, **{name + part: value for name, values in found.items()
                               for part, value in zip(("", " low", " high"), values)}})
        lines.append([wheels, f"{row['wide_arc_m']:g}, {row['tight_arc_m']:g}",
                      f"{row['smallest_rock_m']:g}", *(cell_text(each) for each in found.values())])
        print(f"\r{len(rows)}/27", end="", file=sys.stderr)
    print(file=sys.stderr)
    study.write_csv(args.out / "odometer_sign.csv", rows)
    text = study.table(["wheels", "arcs (m)", "smallest rock (m)", *found], lines)
    text += (f"\n\n{args.trials} trials a cell, seed {args.seed}, the same in each; 95 % intervals "
             f"(Wilson; of means by the normal law); held: {', '.join(held)}; made by rockyard "
             f"{', '.join(sorted(programs))}.\n")
    (args.out / "odometer_sign.md").write_text(text, encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
