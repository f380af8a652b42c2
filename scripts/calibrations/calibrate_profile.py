#!/usr/bin/env python3
"""How pointed rocks have to be to be seen as late as the paper says.

Rocks that the light stripe sensor typically sees as hazards are 7 to 8 cm or more high (Matthies
1995, section 6), about 7 cm (section 8). Runs scenarios/hazard_detection/height_factor.json, finds
the height from which on half of the rocks are seen on the way, and bisects
  terrain.rocks.pointedness
for which that height is --target, 7.25 cm. Prints the value with those for both ends of the range
that it stands for, 7 and 7.5 cm. An end that no pointedness reaches is null. With --against
SCENARIO, exits with 1 where that scenario's value gives a height outside of 7 to 7.5 cm.

    scripts/calibrations/calibrate_profile.py [--heights RATIO RATIO] [--set PATH=VALUE]...
                                 [--against scenarios/pathfinder/nominal.json]
"""

import functools
import json
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from study import ROOT, ry  # noqa: E402

HEIGHT_FACTOR = ROOT / "scenarios/hazard_detection/height_factor.json"
POINTEDNESS = "terrain.rocks.pointedness"
HEIGHT_RATIOS = ("terrain.rocks.min_height_ratio", "terrain.rocks.max_height_ratio")
# Height from which on half of the rocks are seen, m: between Matthies 1995 sec. 8 and the middle of
# sec. 6's 7 to 8 cm; its middle is the target.
SEEN_FROM_M = (0.070, 0.075)
TARGET_M = 0.0725
MOST_POINTED = 0.99
# Pointedness is found to this; the height then is known to some hundredths of a millimetre.
TOLERANCE = 5e-4


def crossing(curve, level=0.5):
    """The first abscissa, by linear interpolation, at which (x, y) pairs pass a level upwards."""
    before = None
    for x, y in curve:
        if y >= level:
            if before is None:
                return x
            x0, y0 = before
            return x0 + (x - x0) * (level - y0) / (y - y0)
        before = (x, y)
    return float("inf")


def seen_from(rockyard, pointedness, settings=(), trials=640, seed=1):
    """Height in m from which on half of the rocks are seen."""
    sums = study.trials_of(rockyard, HEIGHT_FACTOR, trials, seed, [*settings, f"{POINTEDNESS}={pointedness}"]).groupby(
        "height_m")[["scenes", "detected_double"]].sum()
    return crossing((sums.detected_double / sums.scenes).items())


def calibrate(height_at, target, tolerance=TOLERANCE):
    """The pointedness at which the rising function height_at gives the target; None where none."""
    low, high = 0.0, MOST_POINTED
    if height_at(low) > target or height_at(high) < target:
        return None
    while high - low > tolerance:
        middle = 0.5 * (low + high)
        if height_at(middle) < target:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser)
    parser.add_argument("--heights", type=float, nargs=2, metavar="RATIO",
                        help="smallest and largest ratio of full height to diameter")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    parser.add_argument("--target", type=float, default=TARGET_M, help="in m")
    parser.add_argument("--trials", type=int, default=640)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--against", type=Path, help="scenario that should hold such a value")
    args = parser.parse_args()
    settings = list(args.set)
    if args.heights:
        settings += [f"{path}={ratio}" for path, ratio in zip(HEIGHT_RATIOS, args.heights)]

    @functools.cache
    def height_at(pointedness):
        return seen_from(args.rockyard, pointedness, settings, args.trials, args.seed)

    if args.against is not None:
        value = ry.Scenario(args.against)[POINTEDNESS]
        height = height_at(value)
        print(json.dumps({POINTEDNESS: value, "seen_from_m": height}, indent=2))
        if SEEN_FROM_M[0] <= height <= SEEN_FROM_M[1]:
            return 0
        print(f"{args.against}: {POINTEDNESS} is {value}, with which half of the rocks are seen "
              f"from {height:.4f} m on, not from {SEEN_FROM_M[0]} to {SEEN_FROM_M[1]} m",
              file=sys.stderr)
        return 1
    found = {POINTEDNESS: calibrate(height_at, args.target)}
    for end in SEEN_FROM_M:
        found[f"{POINTEDNESS} for {end} m"] = calibrate(height_at, end)
    print(json.dumps(found, indent=2))
    return 0


if __name__ == "__main__":
    sys.exit(main())
