#!/usr/bin/env python3
"""What the calibration of odometer and gyro on level sand gives with the present rover and soil.

Drives scenarios/pathfinder/level_sand.json, the runs of Matthies 1995, section 5, and prints
  perception.dead_reckoning.distance_scale: what makes the mean distance error zero with a perfect
    encoder, as the rover's own calibration did (footnote 4),
  sensors.encoders.physics_variance_m2_per_m: variance that slip alone then gives the distance,
  sensors.encoders.level_sand_gain: the scale again, in closed form,
  sensors.gyro.level_sand_gain: how much faster squared heading errors grow along the runs than the
    noise alone, by the slope that figure 5 fits (column heading_growth_deg2_per_m).
With --readings also what the gyro's gain would be by two other readings of the same runs: the error
at the end, and drives that a gyro without scale error keeps straight. With --against SCENARIO,
exits with 1 where that scenario says otherwise by more than rounding or chance explain.

    scripts/calibrations/calibrate_odometer.py [--set PATH=VALUE]... [--against scenarios/pathfinder/nominal.json]
"""

import json
import math
import statistics
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from study import ROOT, ry  # noqa: E402

LEVEL_SAND = ROOT / "scenarios/pathfinder/level_sand.json"
SCALE = "perception.dead_reckoning.distance_scale"
VARIANCE = "sensors.encoders.physics_variance_m2_per_m"
ENCODER_GAIN = "sensors.encoders.level_sand_gain"
GYRO_GAIN = "sensors.gyro.level_sand_gain"
NO_ENCODER_ERROR = ["sensors.encoders.distance_variance_m2_per_m=0", f"{VARIANCE}=0", f"{SCALE}=1"]
PUBLISHED_DEG2_PER_M = 0.70  # Matthies 1995 sec. 5
# Largest differences between a scenario and its calibration that rounding explains.
TOLERANCE = {SCALE: 5e-5, VARIANCE: 5e-7, ENCODER_GAIN: 5e-5, GYRO_GAIN: 5e-3}
CHANCE = 4.0  # standard errors of the gyro's gain
# Turns to correct the heading grow a little slower than the noise, so that the gain is found anew
# with the noise that it leaves.
ROUNDS = 2


def odometer(rockyard, settings, trials, seed):
    """Scale, physics variance and gain of the encoders, by their paths."""
    columns = study.trials_of(rockyard, LEVEL_SAND, trials, seed, [*settings, *NO_ENCODER_ERROR])
    true, measured = columns["true_distance_m"], columns["dead_reckoned_distance_m"]
    scale = 1.0 / statistics.mean(measured / true)
    return {SCALE: scale, VARIANCE: statistics.variance(scale * measured - true) / statistics.mean(true), ENCODER_GAIN: scale}


def by_slope(columns):
    """Growth of the squared heading error, deg2/m, along the runs; with its standard error."""
    growth = columns.heading_growth_deg2_per_m
    return statistics.mean(growth), statistics.stdev(growth) / math.sqrt(len(growth))


def by_end(columns):
    """The same from the error at the end alone."""
    squares, distance_m = columns.heading_error_deg ** 2, statistics.mean(columns.true_distance_m)
    return statistics.mean(squares) / distance_m, statistics.stdev(squares) / math.sqrt(len(squares)) / distance_m


def gyro_gain(rockyard, settings, trials, seed, reading=by_slope):
    """The gain of the gyro's noise on level sand and its standard error.

    These many drives take the quasi-static rover, unless the settings name another.
    """
    gain = 1.0
    for _ in range(ROUNDS):
        held = ["rover.fidelity=quasi_static", *settings,
                f"sensors.gyro.heading_variance_deg2_per_m={PUBLISHED_DEG2_PER_M}",
                f"{GYRO_GAIN}={gain}"]
        growth, error = reading(study.trials_of(rockyard, LEVEL_SAND, trials, seed, held))
        gain, error = (value * gain / PUBLISHED_DEG2_PER_M for value in (growth, error))
    return gain, error


def calibrate(rockyard, settings, trials=40, seed=1, gyro_trials=2000):
    """The four values by their paths, and the standard error of the gyro's gain."""
    found = odometer(rockyard, settings, trials, seed)
    own = [f"{path}={value}" for path, value in found.items()]
    found[GYRO_GAIN], error = gyro_gain(rockyard, [*settings, *own], gyro_trials, seed)
    return found, error


def other_readings(rockyard, settings, found, trials, seed):
    """Gain and standard error by the other readings of level sand."""
    own = [*settings, *(f"{path}={value}" for path, value in found.items() if path != GYRO_GAIN)]
    return {"end of run": gyro_gain(rockyard, own, trials, seed, by_end),
            "straight line": gyro_gain(rockyard, [*own, "sensors.gyro.scale=1"], trials, seed)}


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser)
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--trials", type=int, default=40, help="of the odometer (default 40)")
    parser.add_argument("--gyro-trials", type=int, default=2000, help="of the gyro (default 2000)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--readings", action="store_true", help="the other readings as well")
    parser.add_argument("--against", type=Path, help="scenario that should hold these values")
    args = parser.parse_args()
    found, error = calibrate(args.rockyard, args.set, args.trials, args.seed, args.gyro_trials)
    print(json.dumps({**found, "standard error of the gyro's gain": error}, indent=2))
    if args.readings:
        others = other_readings(args.rockyard, args.set, found, args.gyro_trials, args.seed)
        print(json.dumps({name: {"gain": gain, "standard error": sd}
                          for name, (gain, sd) in others.items()}, indent=2))
    if args.against is None:
        return 0
    tolerance = {**TOLERANCE, GYRO_GAIN: TOLERANCE[GYRO_GAIN] + CHANCE * error}
    held = ry.Scenario(args.against)
    wrong = {path: held[path] for path in TOLERANCE if abs(held[path] - found[path]) > tolerance[path]}
    for path, value in wrong.items():
        print(f"{args.against}: {path} is {value}, calibration gives {found[path]:.6g}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
