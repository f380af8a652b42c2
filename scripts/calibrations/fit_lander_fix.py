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

import argparse
import csv
import json
import math
import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from calibrations import fit_visual_motion  # noqa: E402

SCENARIO = study.ROOT / "scenarios/cylinder/views.json"
ORIENTATIONS = "cylinder_sighting.orientations_deg=" + json.dumps(list(range(-165, 180, 30)))
# Matthies 1995, app. A, and the parameters image_width_px and field_of_view_deg of the law.
IMAGE_WIDTH_PX = 512.0
TAN_HALF_VIEW = math.tan(math.radians(29.33) / 2)
RADIUS_M = 0.096
PIXEL_RAD = 2 * TAN_HALF_VIEW / IMAGE_WIDTH_PX
PRIOR_DEVIATION = 10.0
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


def features(row):
    """Of the logistic laws."""
    orientation = float(row["orientation_deg"])
    return (1.0, math.log(width_px(float(row["distance_m"])) / 20), 1.0 if -180 < orientation < -90 else 0.0,
            math.sin(2 * math.radians(orientation)),
            math.sin(math.radians(float(row["sun_elevation_deg"]))))


def steps(row):
    """What one pixel is worth, by error."""
    m = width_px(float(row["distance_m"]))
    delta = math.remainder(math.radians(float(row["orientation_deg"])), math.pi / 2)
    return {"heading": 2 / (m * math.cos(delta)), "range": 1 / m, "bearing": PIXEL_RAD}


def chance(law, f):
    """By the coefficients of a logistic law."""
    return 1 / (1 + math.exp(-sum(b * a for b, a in zip(law.values(), f))))


def fit_chance(points):
    """points: (features, number, happened). Coefficients by Newton's method."""
    sums = defaultdict(lambda: [0.0, 0.0])
    for f, n, happened in points:
        sums[f][0] += n
        sums[f][1] += happened
    beta = [0.0] * len(NAMES)
    for _ in range(200):
        gradient = [-b / PRIOR_DEVIATION**2 for b in beta]
        hessian = [[(1 / PRIOR_DEVIATION**2 if i == j else 0.0) for j in range(len(NAMES))] for i in range(len(NAMES))]
        for f, (n, happened) in sums.items():
            p = 1 / (1 + math.exp(-sum(b * a for b, a in zip(beta, f))))
            for i in range(len(NAMES)):
                gradient[i] += (happened - n * p) * f[i]
                for j in range(len(NAMES)):
                    hessian[i][j] += n * p * (1 - p) * f[i] * f[j]
        step = fit_visual_motion.solve(hessian, gradient)
        size = max(abs(s) for s in step)
        beta = [b + s * min(1.0, 2.0 / max(size, 1e-30)) for b, s in zip(beta, step)]
        if size < 1e-10:
            break
    return dict(zip(NAMES, (fit_visual_motion.rounded(b) for b in beta)))


def errors_of(rows, finder, name):
    """(step, error) of each right row, in radians or shares."""
    column, factor = ERRORS[name]
    column = f"{finder}_right_{column.format('bias')}"
    return [(steps(row)[name], factor * float(row[column])) for row in rows if float(row[f"{finder}_right"]) > 0]


def fit_bias(errors):
    """The mean where it is significant, else 0."""
    if len(errors) < 2:
        return 0.0
    mean = sum(e for _, e in errors) / len(errors)
    variance = sum((e - mean)**2 for _, e in errors) / (len(errors) - 1)
    significant = abs(mean) > BIAS_STANDARD_ERRORS * math.sqrt(variance / len(errors))
    return mean if significant else 0.0


def fit_deviation(errors, bias):
    """least and pixels. With one step alone all of it is pixels."""
    groups = defaultdict(lambda: [0, 0.0])
    for step, error in errors:
        groups[step][0] += 1
        groups[step][1] += (error - bias)**2
    if not groups:
        sys.exit("no right pose to fit a deviation to")
    if len(groups) == 1:
        (step, (n, squares)), = groups.items()
        return 0.0, math.sqrt(squares / n) / step
    least, pixels, _ = fit_visual_motion.fit_variance(
        [(step, 0.0, n, squares / n) for step, (n, squares) in groups.items()])
    return least, pixels


def is_beside(row, finder):
    """Whether a pose that is called right points beside the cylinder."""
    if float(row[f"{finder}_right"]) == 0:
        return False
    return abs(float(row[f"{finder}_right_bearing_bias_mrad"])) > 1e3 * RADIUS_M / float(row["distance_m"])


def judged(rows, finder):
    """The rows with those that point beside it among the wrong."""
    return [row | {f"{finder}_wrong": 1, f"{finder}_right": 0} if is_beside(row, finder) else row for row in rows]


def check_rows(rows, finder):
    """Ends with a message where the rows are not what the fit needs."""
    if not rows:
        sys.exit("no rows")
    for column in ("orientation_deg", f"{finder}_found"):
        if column not in rows[0]:
            sys.exit(f"the rows have no column {column}")
    if any(float(row["measurements"]) != 1 for row in rows):
        sys.exit("a row is to be one measurement of one view")


def fit(rows, finder):
    """The group `cylinder` of sensors.aids.lander_fix."""
    check_rows(rows, finder)
    rows = judged(rows, finder)
    rounded = fit_visual_motion.rounded

    def count(row, what):
        return float(row[f"{finder}_{what}"])

    law = {"found": fit_chance([(features(row), 1, count(row, "found")) for row in rows]),
           "wrong": fit_chance([(features(row), count(row, "found"), count(row, "wrong")) for row in rows])}
    for name in ERRORS:
        errors = errors_of(rows, finder, name)
        bias = 0.0 if name == "bearing" else fit_bias(errors)
        least, pixels = fit_deviation(errors, bias)
        if name == "range":
            law[name] = {"least": rounded(least), "pixels": rounded(pixels)}
            law["range_bias"] = rounded(bias)
        else:
            law[name] = {"least_deg": rounded(math.degrees(least)), "pixels": rounded(pixels)}
        if name == "heading":
            law["heading_bias_deg"] = rounded(math.degrees(bias))
    wrong = [row for row in rows if count(row, "wrong") > 0]
    if wrong:
        turn = math.sqrt(sum(float(row[f"{finder}_orientation_bias_deg"])**2 for row in wrong) / len(wrong))
        logs = [math.log(max(1 + float(row[f"{finder}_stereo_bias"]), 0.05)) for row in wrong]
        law["wrong_turn_deg"] = rounded(min(180.0, math.sqrt(3) * turn))
        law["wrong_range"] = rounded(min(3.0, math.sqrt(sum(x * x for x in logs) / len(logs))))
    return law


def deviation(law, name, row):
    """By the law, in radians or shares."""
    group = law[name]
    least = group["least"] if name == "range" else math.radians(group["least_deg"])
    return math.hypot(least, group["pixels"] * steps(row)[name])


def bias_of(law, name):
    """By the law, in radians or shares."""
    if name == "range":
        return law["range_bias"]
    return math.radians(law["heading_bias_deg"]) if name == "heading" else 0.0


def ratios(rows, finder, law, name):
    """Squared errors of right rows in units of the law's variance: 1 on average where it is right."""
    right = [row for row in rows if float(row[f"{finder}_right"]) > 0]
    return [((error - bias_of(law, name)) / deviation(law, name, row))**2
            for row, (_, error) in zip(right, errors_of(rows, finder, name))]


def share(rows, finder, law, what, of):
    """'count / of [95 % interval], share by the law'."""
    n = sum(float(row[of]) for row in rows)
    k = sum(float(row[f"{finder}_{what}"]) for row in rows)
    if n == 0:
        return "0 / 0"
    by_law = sum(float(row[of]) * chance(law[what], features(row)) for row in rows) / n
    low, high = study.wilson_interval(int(k), int(n))
    return f"{k:.0f} / {n:.0f} [{low:.3f}, {high:.3f}], {by_law:.3f}"


def table(rows, finder, law):
    """Rows beside the law, by distance, elevation of the sun and orientation."""
    rows = judged(rows, finder)
    lines = ["| views | found [95 %], law | wrong of these [95 %], law | e^2 / sd^2 of heading | of range | of bearing |",
             "|---|---|---|---|---|---|"]

    def add(title, chosen):
        cells = [share(chosen, finder, law, "found", "measurements"),
                 share(chosen, finder, law, "wrong", f"{finder}_found")]
        for name in ERRORS:
            values = ratios(chosen, finder, law, name)
            cells.append(f"{sum(values) / len(values):.2f} ({len(values)})" if values else "")
        lines.append(f"| {title} | " + " | ".join(cells) + " |")

    for column, unit in (("distance_m", "m"), ("sun_elevation_deg", "deg of sun"), ("orientation_deg", "deg of theta")):
        for value in sorted({float(row[column]) for row in rows}):
            add(f"{value:g} {unit}", [row for row in rows if float(row[column]) == value])
    add("all", rows)
    return "\n".join(lines)


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
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    study.add_run_arguments(parser, trials=10000, out="lander_fix")
    parser.add_argument("--finder", choices=("published", "robust"), default="published")
    parser.add_argument("--confirm", type=int, default=2, help="seed on which the fit is checked (2)")
    parser.add_argument("--scenario", type=Path, help="scenario file whose law is set")
    parser.add_argument("--markdown", type=Path, help="file whose table `lander-fix-FINDER` is replaced")
    args = parser.parse_args()

    def measured(seed):
        args.seed = seed
        folder = args.out / f"views_seed_{seed}"
        study.run_scenario(args, SCENARIO, folder, [ORIENTATIONS] + args.set)
        with open(folder / "trials.csv", encoding="utf-8") as file:
            return [row for row in csv.DictReader(file) if row["outcome"] == "measured"]

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
