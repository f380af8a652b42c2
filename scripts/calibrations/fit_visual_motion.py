#!/usr/bin/env python3
"""Fits the error model of visual odometry to motions that were measured in rendered images, and confirms it.

scenarios/visual_odometry/steps_hazcam.json is run from images: single motions of a grid of ways and turns, from
random places. Of each coordinate the mean squared error of a cell's motions gives
  still, per_m, per_turn   variance = still^2 + (per_m way)^2 + (per_turn turn)^2, the most likely of normal errors
and the motions that were not found give
  intercept, per_m, per_turn of failure, the most likely logistic law, with a normal prior of deviation 10 on each.
They are written as scenarios/sensors/fitted_visual_hazcam.json. Then images and error model run on another seed
(--confirm) at the same places, and a table says where they differ. Runs that are there already are resumed; after
a change of the code delete them.

    scripts/calibrations/fit_visual_motion.py [--trials 240] [--seed 1] [--confirm 2] [--markdown results/visual_odometry.md]
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

SCENARIO = study.ROOT / "scenarios/visual_odometry/steps_hazcam.json"
FRAGMENT = study.ROOT / "scenarios/sensors/fitted_visual_hazcam.json"
STEPS = ["visual_motion.steps_per_run=2"]
# Groups of the error model: coordinates of the records, their unit, and its factor to that of the model.
GROUPS = {
    "along": (("along",), "m", 1.0),
    "across": (("across",), "m", 1.0),
    "up": (("up",), "m", 1.0),
    "tilt": (("roll", "pitch"), "deg", math.pi / 180),
    "heading": (("heading",), "deg", math.pi / 180),
}
PRIOR_DEVIATION = 10.0


def cells(rows):
    """Sums of the runs of each cell, by (way in m, turn in rad)."""
    sums = defaultdict(lambda: defaultdict(float))
    for row in rows:
        key = (float(row["step_m"]), math.radians(float(row["turn_deg"])))
        for column, value in row.items():
            if column in ("trial", "outcome", "cause", "detail", "cell", "step_m", "turn_deg"):
                continue
            if value not in ("", "nan"):
                sums[key][column] += float(value)
    return dict(sums)


def fit_variance(points):
    """points: (way, turn, number, mean squared error). Returns still, per_m, per_rad.

    Minimizes sum n (log v + s / v) over v = x0 + x1 way^2 + x2 turn^2, x >= 0, by multiplicative steps that
    never increase it (majorization; Fevotte and Idier 2011).
    """
    parts = [(1.0, way * way, turn * turn) for way, turn, _, _ in points]
    mean = sum(n * s for _, _, n, s in points) / sum(n for _, _, n, _ in points)
    x = [mean, mean, mean]
    for _ in range(20000):
        v = [max(sum(a * b for a, b in zip(x, f)), 1e-30) for f in parts]
        for k in range(3):
            up = sum(n * s * f[k] / (vi * vi) for (_, _, n, s), f, vi in zip(points, parts, v))
            down = sum(n * f[k] / vi for (_, _, n, _), f, vi in zip(points, parts, v))
            if down > 0:
                x[k] *= math.sqrt(up / down)
    return [math.sqrt(value) for value in x]


def solve(matrix, side):
    """Gauss elimination with pivots; 3 x 3."""
    n = len(side)
    rows = [list(row) + [value] for row, value in zip(matrix, side)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def fit_failures(points):
    """points: (way, turn, number, failures). Returns intercept, per_m, per_rad, by Newton's method."""
    beta = [-3.0, 0.0, 0.0]
    for _ in range(100):
        gradient = [-b / PRIOR_DEVIATION**2 for b in beta]
        hessian = [[(1.0 / PRIOR_DEVIATION**2 if i == j else 0.0) for j in range(3)] for i in range(3)]
        for way, turn, n, failed in points:
            f = (1.0, way, turn)
            p = 1.0 / (1.0 + math.exp(-sum(b * a for b, a in zip(beta, f))))
            for i in range(3):
                gradient[i] += (failed - n * p) * f[i]
                for j in range(3):
                    hessian[i][j] += n * p * (1.0 - p) * f[i] * f[j]
        step = solve(hessian, gradient)
        size = max(abs(s) for s in step)
        beta = [b + s * min(1.0, 2.0 / max(size, 1e-30)) for b, s in zip(beta, step)]
        if size < 1e-10:
            break
    return beta


def fit(sums):
    """The group error_model of a scenario."""
    model = {}
    failures = [(way, turn, cell["steps"], cell["steps"] - cell["found"])
                for (way, turn), cell in sums.items()]
    model["failure"] = dict(zip(("intercept", "per_m", "per_turn"),
                                (rounded(v) for v in fit_failures(failures))))
    for group, (coordinates, unit, factor) in GROUPS.items():
        points = []
        for (way, turn), cell in sums.items():
            if cell["found"] > 0:
                squares = sum(cell[f"{c}_error_{unit}"] for c in coordinates) / len(coordinates)
                points.append((way, turn, cell["found"], factor**2 * squares / cell["found"]))
        still, per_m, per_turn = fit_variance(points)
        if unit == "m":
            values = {"still_m": still, "per_m": per_m, "per_turn_m": per_turn}
        else:
            values = {"still_deg": math.degrees(still), "metre_deg": math.degrees(per_m), "per_turn": per_turn}
        model[group] = {name: rounded(value) for name, value in values.items()}
    return model


def rounded(value):
    """To three significant digits, 0 where it is nothing."""
    return 0.0 if abs(value) < 1e-9 else float(f"{value:.3g}")


def table(images, model):
    """Images beside the error model, cell by cell: rates found and root mean square errors."""
    lines = ["| way, m | turn, deg | found: images, model | way's error, mm: images, model | "
             "heading's, deg: images, model | NEES: images, model |", "|---|---|---|---|---|---|"]
    for key in sorted(images):
        a, b = images[key], model[key]

        def rms(cell, names):
            return math.sqrt(sum(cell[n] for n in names) / max(cell["found"], 1))

        places = ("along_error_m", "across_error_m", "up_error_m")
        lines.append(
            f"| {key[0]:g} | {math.degrees(key[1]):.0f} | {a['found']:.0f} / {a['steps']:.0f}, "
            f"{b['found']:.0f} / {b['steps']:.0f} | {1000 * rms(a, places):.2f}, {1000 * rms(b, places):.2f} | "
            f"{rms(a, ['heading_error_deg']):.3f}, {rms(b, ['heading_error_deg']):.3f} | "
            f"{a['nees'] / max(a['found'], 1):.1f}, {b['nees'] / max(b['found'], 1):.1f} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    study.add_run_arguments(parser, trials=240, out="visual_motion")
    parser.add_argument("--confirm", type=int, default=2, help="seed on which the fit is confirmed (2)")
    parser.add_argument("--markdown", type=Path, help="file whose table `visual-motion` is replaced")
    args = parser.parse_args()

    def measured(name, seed, settings):
        args.seed = seed
        folder = args.out / f"{name}_seed_{seed}"
        study.run_scenario(args, SCENARIO, folder, STEPS + args.set + settings)
        with open(folder / "trials.csv", encoding="utf-8") as file:
            return cells(csv.DictReader(file))

    sums = measured("images", args.seed, [])
    model = fit(sums)
    steps, found = (sum(cell[name] for cell in sums.values()) for name in ("steps", "found"))
    fragment = {
        "description": f"Errors and failures of visual odometry as measured in {steps:.0f} rendered motions of 0 to 1 m "
                       "and 0 to 18 deg by cameras like hazard cameras (scenarios/visual_odometry/steps_hazcam.json, "
                       f"seed {args.seed}), of which {found:.0f} were found. By scripts/calibrations/fit_visual_motion.py; texture "
                       "and light are assumptions.",
        "sensors": {"visual_odometry": {"error_model": model}},
    }
    FRAGMENT.write_text(json.dumps(fragment, indent=2) + "\n", encoding="utf-8")
    print(f"wrote {FRAGMENT.relative_to(study.ROOT)}")
    settings = ["sensors.visual_odometry.fidelity=error_model"]
    settings += [f"sensors.visual_odometry.error_model.{group}.{name}={value}"
                 for group, values in model.items() for name, value in values.items()]
    text = table(measured("images", args.confirm, []), measured("model", args.confirm, settings))
    print(text)
    if args.markdown:
        study.write_table([args.markdown], "visual-motion", text)


if __name__ == "__main__":
    main()
