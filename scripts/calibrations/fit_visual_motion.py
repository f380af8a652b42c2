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

import json
import math
import sys
from pathlib import Path

import numpy as np

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
    return {(way_m, math.radians(turn_deg)): runs.drop(columns="outcome").sum()
            for (way_m, turn_deg), runs in study.cells_of(rows, ("step_m", "turn_deg")).items()}


def fit_variance(points):
    """points: (way, turn, number, mean squared error). Returns still, per_m, per_rad.

    Minimizes sum n (log v + s / v) over v = x0 + x1 way^2 + x2 turn^2, x >= 0, by multiplicative steps that
    never increase it (majorization; Fevotte and Idier 2011).
    """
    way, turn, n, squares = np.array(points, float).T
    parts = np.array([np.ones(len(way)), way ** 2, turn ** 2])
    x = np.full(3, np.average(squares, weights=n))
    for _ in range(20000):
        v = np.maximum(x @ parts, 1e-30)
        up, down = parts @ (n * squares / v ** 2), parts @ (n / v)
        x *= np.sqrt(np.divide(up, down, out=np.ones(3), where=down > 0))
    return np.sqrt(x).tolist()


def fit_logistic(features, numbers, happened):
    """The coefficients of the most likely logistic law, by Newton's method; `features` has a row a point."""
    features, numbers, happened = (np.array(values, float) for values in (features, numbers, happened))
    beta, prior = np.zeros(features.shape[1]), PRIOR_DEVIATION ** -2
    for _ in range(200):
        p = 1.0 / (1.0 + np.exp(-features @ beta))
        gradient = features.T @ (happened - numbers * p) - prior * beta
        step = np.linalg.solve((features.T * (numbers * p * (1.0 - p))) @ features + prior * np.eye(len(beta)), gradient)
        size = max(abs(step))
        beta = beta + step * min(1.0, 2.0 / max(size, 1e-30))
        if size < 1e-10:
            break
    return beta.tolist()


def fit_failures(points):
    """points: (way, turn, number, failures). Returns intercept, per_m, per_rad."""
    return fit_logistic([(1.0, way, turn) for way, turn, *_ in points], *list(zip(*points))[2:])


def fit(sums):
    """The group error_model of a scenario."""
    model = {}
    failures = [(way, turn, cell["steps"], cell["steps"] - cell["found"]) for (way, turn), cell in sums.items()]
    model["failure"] = dict(zip(("intercept", "per_m", "per_turn"), (rounded(v) for v in fit_failures(failures))))
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
    places = ["along_error_m", "across_error_m", "up_error_m"]
    rms = lambda cell, names: math.sqrt(sum(cell[names]) / max(cell["found"], 1))

    def line(key):
        both = images[key], model[key]
        return [f"{key[0]:g}", f"{math.degrees(key[1]):.0f}", *(", ".join(text(cell) for cell in both) for text in (
            lambda cell: f"{cell['found']:.0f} / {cell['steps']:.0f}", lambda cell: f"{1000 * rms(cell, places):.2f}",
            lambda cell: f"{rms(cell, ['heading_error_deg']):.3f}", lambda cell: f"{cell['nees'] / max(cell['found'], 1):.1f}"))]
    return study.table(["way, m", "turn, deg", "found: images, model", "way's error, mm: images, model",
                        "heading's, deg: images, model", "NEES: images, model"], map(line, sorted(images)), "---")


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, trials=240, out="visual_motion")
    study.add_page(parser)
    parser.add_argument("--confirm", type=int, default=2, help="seed on which the fit is confirmed (2)")
    args = parser.parse_args()

    def measured(name, seed, settings):
        args.seed = seed
        return cells(study.counted(study.run_scenario(args, SCENARIO, args.out / f"{name}_seed_{seed}",
                                                      STEPS + args.set + settings)))

    sums = measured("images", seed := args.seed, [])
    model = fit(sums)
    steps, found = (sum(cell[name] for cell in sums.values()) for name in ("steps", "found"))
    fragment = {
        "description": f"Errors and failures of visual odometry as measured in {steps:.0f} rendered motions of 0 to 1 m "
                       "and 0 to 18 deg by cameras like hazard cameras (scenarios/visual_odometry/steps_hazcam.json, "
                       f"seed {seed}), of which {found:.0f} were found. By scripts/calibrations/fit_visual_motion.py; texture "
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
