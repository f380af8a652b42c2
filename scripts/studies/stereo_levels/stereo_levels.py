#!/usr/bin/env python3
"""Drives of GESTALT by rendered images against drives by the error model, pair by pair on the same rocks.

    levels   declared and true success of each level, and the differences to drives by images
    course   what a drive looks like: way, time, moves, turns, clearance, looks

Trials of the same number meet the same rocks, the same soil under the wheels and the same noise of gyro
and encoders; what differs is what the cameras see. Differences have 95 % intervals of pairs, one by one and
not adjusted for their number. Runs that are there already are resumed; a trial by images takes some ten
CPU-seconds. --markdown writes the tables between <!-- begin NAME --> and <!-- end NAME --> of a page.

    scripts/studies/stereo_levels/stereo_levels.py [--trials 100] [--seed 1] [--tables levels,course] [--markdown PAGE]
"""

import json
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/gestalt"
FITTED = study.ROOT / "scenarios/sensors/fitted_stereo_middle_noon.json"
CELLS = {"nominal terrain, 7.6 m": "abundance", "narrow course, 5 m": "narrow_course"}
IMAGES = "images"
FIDELITY = "sensors.stereo.fidelity"

# Column, what it is called, digits.
COURSE = (("true_distance_m", "way (m)", 2), ("sim_time_s", "time (s)", 0), ("moves", "moves", 1),
          ("turns_in_place", "turns in place", 2), ("rear_image_sets", "looks behind", 2),
          ("scrapes", "scrapes", 2), ("safeguard_stops", "stops by safeguards", 2))


def settings_of(group, path):
    """PATH=VALUE of every value of a JSON object."""
    for name, value in group.items():
        place = f"{path}.{name}"
        if isinstance(value, dict):
            yield from settings_of(value, place)
        else:
            yield f"{place}={json.dumps(value)}"


def levels(fitted):
    """Settings of each level by its name, images first."""
    text = json.loads(fitted.read_text(encoding="utf-8"))
    return {IMAGES: [f"{FIDELITY}=image"],
            "error model, assumed": [f"{FIDELITY}=error_model"],
            "error model, fitted": [f"{FIDELITY}=error_model",
                                    *settings_of(text["sensors"]["stereo"], "sensors.stereo")],
            "ideal": [f"{FIDELITY}=ideal"]}


class Runs:
    """The runs of the study, each made once."""

    def __init__(self, args):
        self.args, self.programs, self.levels = args, set(), levels(args.fitted)
        asked = args.cells.split(",")
        self.cells = [name for name, scenario in CELLS.items() if scenario in asked]

    def folder(self, cell, level):
        name = "".join(c if c.isalnum() else "_" for c in level)
        return self.args.out / f"seed{self.args.seed}" / CELLS[cell] / name

    def run(self, cell, level):
        print(f"{cell}: {level}", file=sys.stderr, flush=True)
        summary = study.run_scenario(self.args, SCENARIOS / f"{CELLS[cell]}.json",
                                     self.folder(cell, level), self.levels[level] + self.args.set)
        self.programs.add(study.program(summary))
        return summary

    def differences(self, cell, level):
        """Success of the level less that of images, in points, and means by column."""
        return study.compare(self.args.rockyard, self.folder(cell, IMAGES), self.folder(cell, level))


def rate(summary, kind):
    success = summary[f"{kind}_success"]
    return study.with_interval((success["rate"], *success["ci95"]), 1, 100.0)


def levels_table(runs):
    rows = []
    for cell in runs.cells:
        for level in runs.levels:
            summary = runs.run(cell, level)
            row = [cell, level, rate(summary, "declared"), rate(summary, "true")]
            if level == IMAGES:
                rows.append([*row, "", "", ""])
                continue
            success, _ = runs.differences(cell, level)
            rows.append([*row, study.with_interval(success["declared"][:3], 1),
                         study.with_interval(success["true"][:3], 1), f"{success['true'][3]:.2g}"])
    return study.table(["terrain", "level", "declared (%)", "true (%)",
                        "declared, less images (points)", "true, less images (points)", "p"], rows)


def course_table(runs):
    rows = []
    for cell in runs.cells:
        for level in runs.levels:
            runs.run(cell, level)
            columns = study.trial_columns(runs.folder(cell, level))
            rows.append([cell, level] + [study.with_interval(study.mean_interval(columns[name]), digits)
                                         for name, _, digits in COURSE])
    return study.table(["terrain", "level"] + [title for _, title, _ in COURSE], rows)


TABLES = {"levels": levels_table, "course": course_table}


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, trials=100, out="stereo_levels")
    parser.add_argument("--cells", default=",".join(CELLS.values()), help="which, joined by commas")
    parser.add_argument("--fitted", type=study.Path, default=FITTED,
                        help="scenario fragment with the fitted error model")
    study.print_tables(study.parse_with_tables(parser, TABLES), TABLES, Runs)
    return 0


if __name__ == "__main__":
    sys.exit(main())
