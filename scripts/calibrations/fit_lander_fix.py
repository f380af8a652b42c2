#!/usr/bin/env python3
"""Fits the law by which the lander finds the coloured cylinder to rendered views, and checks it on another seed.

scenarios/cylinder/views.json is run with orientations as a factor, one view and one measurement a run. Of a finder's
rows (src/sensing/aids.h has the law) come
  found, wrong     the most likely logistic laws of ln(width / 20 px), "no blue is seen", sin(2 theta) and the sine of
                   the sun's elevation, with a normal prior of deviation 10 on each coefficient; wrong: of what was found
  heading, range,  variance = least^2 + (pixels step)^2 of what was right, about the mean error where that is more
  bearing          than three standard errors from 0; steps of equations 18, 19, 22 and of a pixel
  wrong_turn       sqrt(3) times the root mean square of wrong headings, at most 180 deg
  wrong_range      root mean square of the logarithm of wrong depths by stereo over the true ones
A pose that is called right and points beside the cylinder, its bearing off by more than radius / distance, is of
another thing: it counts as wrong here.

Distances are those of the cells: each view is up to `distance_spread` off. Clutter is averaged over. Runs that are
there already are resumed; after a change of the code delete them.

    scripts/calibrations/fit_lander_fix.py --finder published [--seed 1] [--confirm 2] [--trials 10000] \\
        [--scenario scenarios/localization/drive_cylinder.json] [--markdown PAGE]
"""

import json
import math
import sys
from pathlib import Path

import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from study import rates  # noqa: E402
from calibrations.fit_visual_motion import fit_logistic, fit_variance, rounded  # noqa: E402

SCENARIO = study.ROOT / "scenarios/cylinder/views.json"
ORIENTATIONS = "cylinder_sighting.orientations_deg=" + json.dumps(list(range(-165, 180, 30)))
# Matthies 1995, app. A, and the parameters image_width_px and field_of_view_deg of the law.
IMAGE_WIDTH_PX = 512.0
TAN_HALF_VIEW = math.tan(math.radians(29.33) / 2)
RADIUS_M = 0.096
PIXEL_RAD = 2 * TAN_HALF_VIEW / IMAGE_WIDTH_PX
NAMES = ("intercept", "width", "no_blue", "pink_aside", "light")  # of the coefficients of a chance
BIAS_STANDARD_ERRORS = 3.0
# Column of the errors of what was right, and its factor to radians or shares.
ERRORS = {
    "heading": ("orientation_{}_deg", math.pi / 180),
    "range": ("range_{}", 1.0),
    "bearing": ("bearing_{}_mrad", 1e-3),
}


def width_px(distance_m):
    """m of equation 16."""
    return IMAGE_WIDTH_PX / ((distance_m / RADIUS_M - RADIUS_M / distance_m) * TAN_HALF_VIEW)


def features(rows):
    """Of the logistic laws: a row for each of the rows."""
    turn_deg = rows.orientation_deg
    return np.array([np.ones(len(rows)), np.log(width_px(rows.distance_m) / 20), (-180 < turn_deg) & (turn_deg < -90),
                     np.sin(2 * np.radians(turn_deg)), np.sin(np.radians(rows.sun_elevation_deg))]).T


def steps(rows, name):
    """What one pixel is worth, by error."""
    m, turn = width_px(rows.distance_m), np.radians(rows.orientation_deg)
    if name == "heading":
        return 2 / (m * np.cos(turn - math.pi / 2 * np.round(turn / (math.pi / 2))))
    return 1 / m if name == "range" else m * 0.0 + PIXEL_RAD


def chance(law, rows):
    """By the coefficients of a logistic law."""
    return 1 / (1 + np.exp(-features(rows) @ list(law.values())))


def fit_chance(rows, numbers, happened):
    return dict(zip(NAMES, map(rounded, fit_logistic(features(rows), numbers, happened))))


def right_of(rows, finder, name):
    """The right rows, and their errors in radians or shares."""
    column, factor = ERRORS[name]
    right = rows[rows[f"{finder}_right"] > 0]
    return right, factor * right[f"{finder}_right_{column.format('bias')}"]


def fit_bias(errors):
    """The mean where it is significant, else 0."""
    significant = len(errors) > 1 and abs(errors.mean()) > BIAS_STANDARD_ERRORS * errors.sem()
    return errors.mean() if significant else 0.0


def fit_deviation(pixels, squares):
    """least and pixels, of squared errors by what a pixel is worth. With one step alone all of it is pixels."""
    groups = squares.groupby(pixels).agg(["size", "mean"])
    if groups.empty:
        sys.exit("no right pose to fit a deviation to")
    if len(groups) == 1:
        return 0.0, math.sqrt(groups["mean"].iloc[0]) / groups.index[0]
    return fit_variance([(step, 0.0, n, square) for step, n, square in groups.itertuples()])[:2]


def judged(rows, finder):
    """The rows with those of right poses that point beside the cylinder among the wrong."""
    right, bearing_mrad = rows[f"{finder}_right"], rows[f"{finder}_right_bearing_bias_mrad"]
    beside = (right > 0) & (bearing_mrad.abs() > 1e3 * RADIUS_M / rows.distance_m)
    return rows.assign(**{f"{finder}_wrong": rows[f"{finder}_wrong"].mask(beside, 1), f"{finder}_right": right.mask(beside, 0)})


def check_rows(rows, finder):
    """Ends with a message where the rows are not what the fit needs."""
    if rows.empty:
        sys.exit("no rows")
    for column in ("orientation_deg", f"{finder}_found"):
        if column not in rows:
            sys.exit(f"the rows have no column {column}")
    if (rows.measurements != 1).any():
        sys.exit("a row is to be one measurement of one view")


def fit(rows, finder):
    """The group `cylinder` of sensors.aids.lander_fix."""
    check_rows(rows, finder)
    rows = judged(rows, finder)
    found, wrong = rows[f"{finder}_found"], rows[f"{finder}_wrong"]
    law = {"found": fit_chance(rows, rows.measurements, found), "wrong": fit_chance(rows, found, wrong)}
    for name in ERRORS:
        right, errors = right_of(rows, finder, name)
        bias = 0.0 if name == "bearing" else fit_bias(errors)
        least, pixels = fit_deviation(steps(right, name), (errors - bias) ** 2)
        if name == "range":
            law[name] = {"least": rounded(least), "pixels": rounded(pixels)}
            law["range_bias"] = rounded(bias)
        else:
            law[name] = {"least_deg": rounded(math.degrees(least)), "pixels": rounded(pixels)}
        if name == "heading":
            law["heading_bias_deg"] = rounded(math.degrees(bias))
    wrong = rows[wrong > 0]
    if len(wrong):
        rms = lambda values: math.sqrt((values ** 2).mean())
        law["wrong_turn_deg"] = rounded(min(180.0, math.sqrt(3) * rms(wrong[f"{finder}_orientation_bias_deg"])))
        law["wrong_range"] = rounded(min(3.0, rms(np.log(np.maximum(1 + wrong[f"{finder}_stereo_bias"], 0.05)))))
    return law


def deviation(law, name, rows):
    """By the law, in radians or shares."""
    group = law[name]
    least = group["least"] if name == "range" else math.radians(group["least_deg"])
    return np.hypot(least, group["pixels"] * steps(rows, name))


def bias_of(law, name):
    """By the law, in radians or shares."""
    if name == "range":
        return law["range_bias"]
    return math.radians(law["heading_bias_deg"]) if name == "heading" else 0.0


def ratios(rows, finder, law, name):
    """Squared errors of right rows in units of the law's variance: 1 on average where it is right."""
    right, errors = right_of(rows, finder, name)
    return ((errors - bias_of(law, name)) / deviation(law, name, right)) ** 2


def share(rows, finder, law, what, of):
    """'count / of [95 % interval], share by the law'."""
    n, k = rows[of].sum(), rows[f"{finder}_{what}"].sum()
    if n == 0:
        return "0 / 0"
    by_law = (rows[of] * chance(law[what], rows)).sum() / n
    low, high = rates.wilson_interval(k, n)
    return f"{k:.0f} / {n:.0f} [{low:.3f}, {high:.3f}], {by_law:.3f}"


def table(rows, finder, law):
    """Rows beside the law, by distance, elevation of the sun and orientation."""
    rows = judged(rows, finder)

    def line(title, chosen):
        values = [ratios(chosen, finder, law, name) for name in ERRORS]
        return [title, share(chosen, finder, law, "found", "measurements"), share(chosen, finder, law, "wrong", f"{finder}_found"),
                *(f"{own.mean():.2f} ({len(own)})" if len(own) else "" for own in values)]
    lines = [line(f"{value:g} {unit}", chosen)
             for column, unit in (("distance_m", "m"), ("sun_elevation_deg", "deg of sun"), ("orientation_deg", "deg of theta"))
             for value, chosen in rows.groupby(column)]
    return study.table(["views", "found [95 %], law", "wrong of these [95 %], law", "e^2 / sd^2 of heading", "of range",
                        "of bearing"], [*lines, line("all", rows)], "---")


def fragment(law):
    """What a scenario needs."""
    return {"sensors": {"aids": {"lander_fix": {"law": "cylinder", "cylinder": law}}}}


def merge(into, new):
    """Sets what `new` has, group by group."""
    for key, value in new.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            merge(into[key], value)
        else:
            into[key] = value


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, trials=10000, out="lander_fix")
    study.add_page(parser)
    parser.add_argument("--finder", choices=("published", "robust"), default="published")
    parser.add_argument("--confirm", type=int, default=2, help="seed on which the fit is checked (2)")
    parser.add_argument("--scenario", type=Path, help="scenario file whose law is set")
    args = parser.parse_args()

    def measured(seed):
        args.seed = seed
        run = study.run_scenario(args, SCENARIO, args.out / f"views_seed_{seed}", [ORIENTATIONS] + args.set)
        return run.trials[run.trials.outcome == "measured"]

    rows = measured(args.seed)
    law = fit(rows, args.finder)
    print(json.dumps(fragment(law), indent=2))
    print(f"\nThe rows of the fit:\n\n{table(rows, args.finder, law)}")
    checked = table(measured(args.confirm), args.finder, law)
    print(f"\nSeed {args.confirm}, not fitted:\n\n{checked}")
    if args.scenario:
        scenario = json.loads(args.scenario.read_text(encoding="utf-8"))
        merge(scenario, fragment(law))
        args.scenario.write_text(json.dumps(scenario, indent=2) + "\n", encoding="utf-8")
    if args.markdown:
        study.write_table([args.markdown], f"lander-fix-{args.finder}", checked)


if __name__ == "__main__":
    main()
