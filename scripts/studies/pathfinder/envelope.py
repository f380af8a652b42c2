#!/usr/bin/env python3
"""Envelope of the predictions over the ranges of the assumed parameters.

Draws a Latin hypercube over every assumed parameter that has a study range, and a balanced random
choice for every assumed option, runs each scenario at each point, and prints the spread of each
prediction over the points. Runs that are there already are resumed, so that it can be stopped and
started again. At each point odometer and gyro are calibrated anew on level sand, as the rover's own
were.

    scripts/studies/pathfinder/envelope.py --points 50 --trials 40 --set rover.fidelity=quasi_static \\
        --set terrain.rocks.mobility=fixed scenarios/pathfinder/nominal.json ...
"""

import csv
import functools
import json
import random
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import ry  # noqa: E402
from calibrations import calibrate_profile  # noqa: E402
from calibrations.calibrate_odometer import calibrate  # noqa: E402

# Of a point's pointedness: a quarter of a millimetre in the height from which rocks are seen.
PROFILE_TOLERANCE = 0.005

# Where each prediction stands in summary.json.
METRICS = {
    "declared success rate": ("declared_success", "rate"),
    "true success rate": ("true_success", "rate"),
    "distance min (m)": ("distance_m", "min"),
    "distance mode (m)": ("distance_m", "mode"),
    "distance error mode (%)": ("dead_reckoning", "distance_error_percent", "mode"),
    "heading error mode (deg)": ("dead_reckoning", "heading_error_deg", "mode"),
    "position error mode (m)": ("dead_reckoning", "position_error_m", "mode"),
    "position error max (m)": ("dead_reckoning", "position_error_m", "max"),
}


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("scenarios", nargs="+", type=Path)
    parser.add_argument("--points", type=int, default=50, help="points of the design (default 50)")
    study.add_run_arguments(parser, trials=40, out="envelope")
    return parser.parse_args()


def wrong(scenario, values):
    """What is wrong with values in a scenario: problems, none where it is valid."""
    try:
        ry.Scenario(scenario, set=values)
    except ry.InputError as error:
        return error.problems
    return []


def assumed_parameters(rockyard, scenario):
    """Rows of the parameter table that the design varies; options that are invalid are left out."""
    table = csv.DictReader(study.run([rockyard, "parameters", scenario, "--csv"]).splitlines())
    rows = [row for row in table if row["origin"] == "assumed"]
    for row in rows:
        row["options"] = [option for option in filter(None, row["choices"].split("|"))
                          if not wrong(scenario, {row["path"]: option})]
    return [row for row in rows if row["options"] or row["study_low"]]


def column(row, points, rng):
    """One value a point: stratified where continuous, balanced where a choice."""
    if row["options"]:
        values = [row["options"][i % len(row["options"])] for i in range(points)]
    else:
        low, high = float(row["study_low"]), float(row["study_high"])
        values = [low + (high - low) * (i + rng.random()) / points for i in range(points)]
        if row["kind"] == "integer":
            values = [round(value) for value in values]
    rng.shuffle(values)
    return values


def design(rows, points, seed):
    rng = random.Random(seed)
    columns = {row["path"]: column(row, points, rng) for row in rows}
    return [{path: values[i] for path, values in columns.items()} for i in range(points)]


def repaired(point, rows, scenario, rng):
    """Draws anew what contradicts other values of the point (its ranges taken one by one overlap).

    Where the program blames a parameter that the design does not vary, what it varies in the same group
    is drawn anew. Returns the names of the parameters that were drawn again.
    """
    by_path = {row["path"]: row for row in rows}
    redrawn = []
    for _ in range(100):
        problems = wrong(scenario, point)
        if not problems:
            return redrawn
        blamed = {problem.path for problem in problems}
        group = lambda path: path.rpartition(".")[0]
        again = [path for path in by_path if path in blamed or group(path) in map(group, blamed - set(by_path))]
        if not again:
            sys.exit("\n".join(map(str, problems)))
        for path in again:
            point[path] = column(by_path[path], 1, rng)[0]
            redrawn.append(path)
    sys.exit(f"found no valid values for {', '.join(sorted(set(redrawn)))}")


def spread(values):
    """Smallest, quantiles and largest of what has a value."""
    ordered = sorted(value for value in values if value is not None)
    if not ordered:
        return {}
    at = {"min": 0.0, "p05": 0.05, "median": 0.5, "p95": 0.95, "max": 1.0}
    return {name: ordered[min(len(ordered) - 1, int(share * len(ordered)))] for name, share in at.items()}


def pointedness(args, point, rows, rng):
    """What single rocks ask for at a point; the nearer end where they ask for none."""
    valid = dict(point)
    repaired(valid, rows, calibrate_profile.HEIGHT_FACTOR, rng)
    values = [f"{path}={value}" for path, value in valid.items()]

    @functools.cache
    def height_at(value):
        return calibrate_profile.seen_from(args.rockyard, value, values, trials=64, seed=args.seed)

    found = calibrate_profile.calibrate(height_at, calibrate_profile.TARGET_M, PROFILE_TOLERANCE)
    if found is not None:
        return found
    return 0.0 if height_at(0.0) > calibrate_profile.TARGET_M else calibrate_profile.MOST_POINTED


def calibrations(args, points, rows):
    """Calibrated values by path for each point, as found on level sand and on single rocks."""
    stored = args.out / "calibrations.json"
    found = json.loads(stored.read_text(encoding="utf-8")) if stored.exists() else []
    for index, point in enumerate(points[len(found):], len(found)):
        values = [f"{path}={value}" for path, value in point.items()]
        own = calibrate(args.rockyard, values, trials=20, seed=args.seed, gyro_trials=1000)[0]
        own[calibrate_profile.POINTEDNESS] = pointedness(args, point, rows, random.Random(f"{args.seed} {index}"))
        found.append(own)
        stored.write_text(json.dumps(found) + "\n", encoding="utf-8")
    return found


def run_points(args, scenario, points, calibrated, rows, rng):
    """summary.json of the scenario at every point."""
    summaries = []
    for index, (point, own) in enumerate(zip(points, calibrated)):
        valid = dict(point)  # a value may contradict this scenario and no other
        repaired(valid, rows, scenario, rng)
        folder = args.out / scenario.stem / f"{index:03d}"
        assignments = [f"{path}={value}" for path, value in {**valid, **own}.items()]
        summaries.append(study.run_scenario(args, scenario, folder, assignments).summary)
        print(f"\r{scenario.stem}: {index + 1}/{len(points)}", end="", file=sys.stderr)
    print(file=sys.stderr)
    return summaries


def main():
    args = parse_arguments()
    held = dict(setting.split("=", 1) for setting in args.set)
    rows = [row for row in assumed_parameters(args.rockyard, args.scenarios[0]) if row["path"] not in held]
    points = [{**point, **held} for point in design(rows, args.points, args.seed)]
    rng = random.Random(args.seed + 1)
    redrawn = [path for point in points for path in repaired(point, rows, args.scenarios[0], rng)]
    args.out.mkdir(parents=True, exist_ok=True)
    (args.out / "design.json").write_text(json.dumps(points, indent=1) + "\n", encoding="utf-8")
    calibrated = calibrations(args, points, rows)
    print(f"{len(points)} points over {len(rows)} assumed parameters, {args.trials} trials each; "
          f"{len(redrawn)} values drawn again because they contradicted others")
    result = {"points": len(points), "parameters": len(rows), "trials": args.trials,
              "held": args.set, "scenarios": {}}
    for scenario in args.scenarios:
        summaries = run_points(args, scenario, points, calibrated, rows, rng)
        print(f"\n{scenario.stem:<28} {'min':>9} {'p05':>9} {'median':>9} {'p95':>9} {'max':>9}")
        metrics = result["scenarios"].setdefault(scenario.stem, {})
        for name, path in METRICS.items():
            values = spread([functools.reduce(dict.__getitem__, path, summary) for summary in summaries])
            metrics[name] = {"path": path, **values}
            print(f"  {name:<26} " + " ".join(f"{value:9.3f}" for value in values.values()))
        sys.stdout.flush()
        # After each scenario, so that a run that is stopped leaves those it has.
        (args.out / "envelope.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
