#!/usr/bin/env python3
"""What the odometer's calibration on level sand gives with the present rover and soil.

Drives scenarios/pathfinder/level_sand.json with a perfect encoder and a distance scale of 1, as the
rover's own calibration did (Matthies 1995, footnote 4), and prints
  perception.dead_reckoning.distance_scale: what makes the mean distance error zero,
  sensors.encoders.physics_variance_m2_per_m: variance that slip alone gives the distance.
With --against SCENARIO, exits with 1 where that scenario says otherwise.

    scripts/calibrate_odometer.py [--set PATH=VALUE]... [--against scenarios/pathfinder/nominal.json]
"""

import argparse
import csv
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LEVEL_SAND = ROOT / "scenarios/pathfinder/level_sand.json"
NO_ENCODER_ERROR = ["sensors.encoders.distance_variance_m2_per_m=0",
                    "sensors.encoders.physics_variance_m2_per_m=0",
                    "perception.dead_reckoning.distance_scale=1"]
SCALE = "perception.dead_reckoning.distance_scale"
VARIANCE = "sensors.encoders.physics_variance_m2_per_m"
# Largest differences between a scenario and its calibration that rounding explains.
TOLERANCE = {SCALE: 5e-5, VARIANCE: 5e-7}


def calibrate(rockyard, settings, trials=40, seed=1):
    """The two values, by their paths. Raises CalledProcessError where the run fails."""
    with tempfile.TemporaryDirectory() as folder:
        command = [rockyard, "run", LEVEL_SAND, "--trials", trials, "--seed", seed, "--out",
                   f"{folder}/run", "--quiet"]
        command += [part for setting in (*settings, *NO_ENCODER_ERROR)
                    for part in ("--set", setting)]
        subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)
        with open(f"{folder}/run/trials.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    true = [float(row["true_distance_m"]) for row in rows]
    measured = [float(row["dead_reckoned_distance_m"]) for row in rows]
    scale = 1.0 / statistics.mean(m / t for m, t in zip(measured, true))
    errors = [scale * m - t for m, t in zip(measured, true)]
    return {SCALE: scale, VARIANCE: statistics.variance(errors) / statistics.mean(true)}


def value_at(rockyard, scenario, path):
    """The effective value of a parameter in a scenario."""
    text = subprocess.run([str(rockyard), "parameters", str(scenario), "--csv"], check=True,
                          capture_output=True, text=True).stdout
    return next(float(row["value"]) for row in csv.DictReader(text.splitlines())
                if row["path"] == path)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--trials", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--against", type=Path, help="scenario that should hold these values")
    args = parser.parse_args()
    found = calibrate(args.rockyard, args.set, args.trials, args.seed)
    print(json.dumps(found, indent=2))
    if args.against is None:
        return 0
    wrong = {path: value_at(args.rockyard, args.against, path) for path, value in found.items()
             if abs(value_at(args.rockyard, args.against, path) - value) > TOLERANCE[path]}
    for path, value in wrong.items():
        print(f"{args.against}: {path} is {value}, calibration gives {found[path]:.6g}",
              file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
