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
from itertools import product
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

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

    def __iter__(self):
        """Cell, level and run."""
        for cell, level in product(self.cells, self.levels):
            print(f"{cell}: {level}", file=sys.stderr, flush=True)
            name = "".join(c if c.isalnum() else "_" for c in level)
            run = study.run_scenario(
                self.args, SCENARIOS / f"{CELLS[cell]}.json", self.args.out / f"seed{self.args.seed}" / CELLS[cell] / name,
                self.levels[level] + self.args.set)
            self.programs.add(study.program(run))
            yield cell, level, run


def levels_table(runs):
    rows = []
    for cell, level, run in runs:
        row = [cell, level, *(study.with_interval(rate, 1, 100.0) for rate in (run.declared_success, run.true_success))]
        if level == IMAGES:
            images = run
            rows.append([*row, "", "", ""])
            continue
        success, _ = study.compare(images, run)
        rows.append([*row, *(study.with_interval(success[kind][:3], 1) for kind in ("declared", "true")),
                     f"{success['true'][3]:.2g}"])
    return study.table(["terrain", "level", "declared (%)", "true (%)",
                        "declared, less images (points)", "true, less images (points)", "p"], rows)


def course_table(runs):
    return study.table(["terrain", "level"] + [title for _, title, _ in COURSE], [
        [cell, level, *(study.with_interval(rates.mean(run.counted[name], least=0.0), digits) for name, _, digits in COURSE)]
        for cell, level, run in runs])


TABLES = {"levels": levels_table, "course": course_table}


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, trials=100, out="stereo_levels")
    parser.add_argument("--cells", default=",".join(CELLS.values()), help="which, joined by commas")
    parser.add_argument("--fitted", type=Path, default=FITTED, help="scenario fragment with the fitted error model")
    study.print_tables(study.parse_with_tables(parser, TABLES), TABLES, Runs)


if __name__ == "__main__":
    main()
