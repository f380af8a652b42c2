#!/usr/bin/env python3
"""What stereo cameras measure by distance, texture, sun and baseline, beside r^2 dd / (f B).

Runs scenarios/stereo_sensing/ and prints a table each: density of matches, errors of disparity and of range,
the range error that the law r^2 dd / (f B) predicts from the errors of disparity in the same cell, and what
GESTALT makes of single looks. Runs that are there already are resumed; after a change of the code delete
them. --markdown writes the tables between <!-- begin stereo_NAME --> and <!-- end stereo_NAME --> of a page.

    scripts/studies/stereo/stereo.py [--share 1] [--seed 1] [--tables range,rocks,texture,sun,baseline] [--markdown PAGE]
"""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from calibrations.fit_stereo_errors import HEIGHTS, cells_by, percent  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/stereo_sensing"
# Name of the table: factor, its heading, how its values are written.
FACTORS = {
    "range": (None, None, None),
    "rocks": (None, None, None),
    "texture": ("soil_graininess", "texture, drift 0 to gravel 1", "{:g}"),
    "sun": ("sun_elevation_deg", "sun, degrees", "{:g}"),
    "baseline": ("baseline_m", "baseline, cm", "{:.0f}"),
}
SCALES = {"baseline_m": 100.0}


def run(args, name):
    """Runs a table's scenario, or takes the run that is there."""
    path = SCENARIOS / f"{name}.json"
    args.trials = max(1, round(study.ry.Scenario(path)["trials"] * args.share))
    return study.run_scenario(args, path, args.out / f"{name}-{args.seed}-{args.trials}", args.set)


def error_row(cell):
    """Density, errors, and what the laws predict of them."""
    noise_px = cell.rms("error_px", "good")
    error_m = cell.rms("range_error_m", "good")
    ray_m = noise_px * cell.rms("range_step_m", "good")
    axis_m = noise_px * cell.rms("axis_step_m", "good")
    return [percent(cell, "matched", "pixels"), percent(cell, "wrong", "matched"), f"{noise_px:.3f}",
            f"{cell.mean('bias_px', 'good'):+.3f}", f"{100 * cell.mean('range_m', 'good'):.0f}",
            f"{100 * error_m:.2f}", f"{100 * axis_m:.2f}", f"{100 * ray_m:.2f}",
            f"{error_m / ray_m:.2f}" if ray_m else "-"]


ERRORS = ["matched, %", "off by 1 px or more, %", "rms error, px", "mean error, px", "mean range, cm",
          "rms error of range, cm", "r^2 dd / (f B), cm", "r Z dd / (f B), cm", "measured / the latter"]


def table_of(name, rows):
    """The table of a scenario: a row for each value of its factor and each bin of distances."""
    factor, heading, style = FACTORS[name]
    keys = ([factor] if factor else []) + ["nearest_m", "farthest_m"]
    header = ([heading] if factor else []) + ["distance, m", *ERRORS]
    lines = []
    for values, cell in cells_by(rows, *keys).items():
        first = [style.format(SCALES.get(factor, 1.0) * values[0])] if factor else []
        lines.append([*first, f"{values[-2]:g} to {values[-1]:g}", *error_row(cell)])
    return study.table(header, lines)


def rocks_of(rows):
    """What GESTALT makes of looks, by distance."""
    header = ["distance, m", *(f"rocks of {'≥ ' if h == '20' else ''}{int(h) / 50:.1f} m" for h in HEIGHTS),
              "clear cells known, %", "hazards imagined, %", "hazard cells found, %"]
    lines = []
    for (near, far), cell in cells_by(rows, "nearest_m", "farthest_m").items():
        finds = [f"{cell[f'found_{h}']:.0f} of {cell[f'rocks_{h}']:.0f} ({cell[f'perfect_{h}']:.0f})"
                 for h in HEIGHTS]
        lines.append([f"{near:g} to {far:g}", *finds, percent(cell, "clear_known", "clear_cells"),
                      percent(cell, "imagined", "clear_known"),
                      percent(cell, "hazard_found", "hazard_cells")])
    return study.table(header, lines)


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, None, "stereo")
    parser.add_argument("--share", type=float, default=1.0, help="of the scenarios' runs (1)")
    args = study.parse_with_tables(parser, FACTORS)
    runs = []
    for name in args.tables.split(","):
        runs.append(run(args, name))
        rows = study.counted(runs[-1])
        note = f"{rows.looks.sum():.0f} looks, seed {args.seed}; {study.held(args)}{study.made_by(runs)}."
        study.show(args, {f"stereo_{name}": f"{rocks_of(rows) if name == 'rocks' else table_of(name, rows)}\n\n{note}"})


if __name__ == "__main__":
    main()
