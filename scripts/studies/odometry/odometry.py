#!/usr/bin/env python3
"""How far wrong visual odometry is after 100 m of rendered Mars, and how often a step has no motion.

For each case it renders sequences of stereo pairs along an oracle's route around the rocks (`rockyard render
--pairs --route`), one terrain, texture and noise a trial, has `rockyard vo` find the path and hold it against the
truth, keeps one line a sequence, and deletes the images. What is there already is not done again. Where a step has
no motion, wheels that lose a tenth of every step and true attitudes fill the gap, which are also what the search
expects (wheels.txt). Writes one line a sequence into odometry_sequences.csv, from which the table of cases is made.

    sequences   median end error in % of the way with its 95 % interval by order statistics (the median of
                sequences is taken), and the share of steps without a motion, by case
    standing    1,000 pairs from one place: errors in units of their covariance, against one keyframe, and of
                pairs of pairs that share nothing

    scripts/studies/odometry/odometry.py [--cases NAME,...] [--out FOLDER] [--markdown PAGE]

The cases were named before the first run: main ones have 20 sequences of 100 m, those of one factor 10 of 20 m. Only
the width of VL-2's arena was set later, as the first way led out of the first one, and the fine cases were added, the
same sequences seen by another odometer.
"""

import json
import math
import shutil
import sys
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/visual_odometry"
SEED = 20261126
SLIP = 0.1
MAIN = {"sequences": 20, "way_m": 100.0}
FACTOR = {"sequences": 10, "way_m": 20.0}
NOMINAL, VL2 = 0.00415, 0.013
# Ways among the rocks of VL-2 lead up to 20 m aside; larger fields have more rocks than a layout may.
WIDE = ("terrain.arena.width_m=40",)


@dataclass(frozen=True)
class Case:
    """Sequences under the same conditions."""
    camera: str
    k_per_m2: float = NOMINAL
    step_m: float = 0.75
    sun_deg: float = 60.0
    graininess: float = 0.5
    sequences: int = 20
    way_m: float = 100.0
    more: tuple = field(default=())  # further settings of the scenario
    odometer: tuple = field(default=())  # parameters of the odometer

    def settings(self):
        return [f"terrain.rocks.k_per_m2={self.k_per_m2}", f"course.goal_x_m={self.way_m:g}",
                f"sensors.sun.elevation_deg={self.sun_deg:g}",
                f"sensors.look.soil_graininess={self.graininess:g}", *self.more]


# Corners of weaker texture too, small windows, and more of them left out: chosen on four sequences of another seed (77).
FINE = ("placement.window_px=9", "placement.max_residual_ratio=1.5", "placement.min_kept=20",
        "detector.max_features=200", "detector.suppression_px=2")

# In the order in which they are run.
CASES = {
    "navcam": Case("navcam", **MAIN),
    "navcam, half the baseline": Case("navcam", more=("sensors.stereo.baseline_m=0.1",), **MAIN),
    "navcam, steps of 0.25 m": Case("navcam", step_m=0.25, **FACTOR),
    "navcam, steps of 1.5 m": Case("navcam", step_m=1.5, **FACTOR),
    "navcam, sun at 15 deg": Case("navcam", sun_deg=15.0, **FACTOR),
    "navcam, drift": Case("navcam", graininess=0.0, **FACTOR),
    "navcam, gravel": Case("navcam", graininess=1.0, **FACTOR),
    "hazcam, steps of 0.25 m": Case("hazcam", step_m=0.25, **FACTOR),
    "hazcam, steps of 0.75 m": Case("hazcam", **FACTOR),
    "navcam, VL-2": Case("navcam", k_per_m2=VL2, more=WIDE, **MAIN),
    "hazcam": Case("hazcam", step_m=0.25, **MAIN),
    "hazcam, VL-2": Case("hazcam", k_per_m2=VL2, step_m=0.25, more=WIDE, **MAIN),
    "navcam, VL-2, fine": Case("navcam", k_per_m2=VL2, more=WIDE, odometer=FINE, **MAIN),
    "hazcam, VL-2, fine": Case("hazcam", k_per_m2=VL2, step_m=0.25, more=WIDE, odometer=FINE, **MAIN),
}
# A way around rocks is longer than the line, and turns take pairs.
SPARE = 3.0
STANDING_PAIRS = 1000
# What `rockyard render` says of rocks that leave no way, or none within the arena; the next trial takes the place of
# such a one.
NO_ROUTE = ("there is no way to the goal", "outside of the arena")

COLUMNS = ("case", "trial", "pairs", "steps", "gaps", "distance_m", "end_error_m", "end_percent",
           "absolute_rigid_m", "step_rms_m", "step_rms_deg", "normalized_mean", "above_95", "reasons", "program")


def render(args, case, trial, folder):
    """True where the trial has a route."""
    try:
        study.run([args.rockyard, "render", SCENARIOS / f"traverse_{case.camera}.json", "--out", folder, "--seed", SEED,
                   "--trial", trial, "--pairs", round(SPARE * case.way_m / case.step_m) + 20, "--step-m", case.step_m,
                   "--route", "--slip", SLIP, *study.settings(case.settings())])
    except SystemExit as failed:
        if not any(reason in str(failed) for reason in NO_ROUTE):
            raise
        return False
    return True


def odometry(args, sequence, folder, *options):
    command = [args.rockyard, "vo", sequence, "--cameras", sequence / "cameras.json", "--truth",
               sequence / "poses.txt", "--predict", sequence / "wheels.txt", "--out", folder, "--json", *options]
    return json.loads(study.run(command))


def row_of(case_name, trial, found):
    errors = found["errors"]
    normalized = errors["normalized"] or {"mean": math.nan}
    reasons = " ".join(f"{name}:{count}" for name, count in found["reasons"].items() if count)
    return dict(zip(COLUMNS, (
        case_name, trial, found["pairs"], found["pairs"] - 1, found["gaps"], errors["distance_m"], errors["end_m"],
        errors["end_percent"], errors["absolute_rigid_m"]["rms"], errors["relative_m"]["rms"],
        errors["relative_deg"]["rms"], normalized["mean"], errors["normalized_above_95"], reasons,
        found["program"])))


def run_sequence(args, case_name, trial):
    case = CASES[case_name]
    sequence = args.out / "sequence"
    shutil.rmtree(sequence, ignore_errors=True)
    if not render(args, case, trial, sequence):
        return None
    options = (part for parameter in case.odometer for part in ("--param", parameter))
    found = odometry(args, sequence, args.out / "path", *options)
    shutil.rmtree(sequence)
    return row_of(case_name, trial, found)


def read_rows(path):
    return study.read_csv(path) if path.exists() else []


def run_case(args, name, table):
    """Adds the sequences that the table lacks."""
    trials = [int(row["trial"]) for row in read_rows(table) if row["case"] == name]
    trial = max(trials, default=-1) + 1
    while len(trials) < CASES[name].sequences:
        row = run_sequence(args, name, trial)
        if row:
            study.write_csv(table, [*read_rows(table), row])
            trials.append(trial)
        trial += 1


def summary(rows, name):
    """One line of the table of cases."""
    mine = [row for row in rows if row["case"] == name]
    if not mine:
        return None
    ends = [float(row["end_percent"]) for row in mine]
    interval = rates.median_interval(ends)
    gaps, steps = ([int(row[name]) for row in mine] for name in ("gaps", "steps"))
    share, low, high = (100 * value for value in rates.share(gaps, steps))
    return [name, f"{len(mine)} of {CASES[name].sequences}", f"{CASES[name].way_m:g}",
            f"{median([float(row['distance_m']) for row in mine]):.1f}", f"{median(ends):.2f}",
            "-" if math.isnan(interval[0]) else f"{interval[0]:.2f} to {interval[1]:.2f}", f"{max(ends):.2f}",
            f"{sum(gaps)} of {sum(steps)}", f"{share:.1f} ({low:.1f} to {high:.1f})",
            f"{median([float(row['normalized_mean']) for row in mine]):.1f}"]


HEADER = ["case", "sequences", "to the goal, m", "way, m (median)", "end error, % of the way (median)", "95 %", "largest",
          "steps without a motion", "%", "squared error over covariance (6 if right)"]


def standing(args):
    """Errors of a camera that does not move: against one keyframe, and of disjoint pairs of pairs."""
    folder = args.out / "standing.json"
    if folder.exists():
        return json.loads(folder.read_text(encoding="utf-8"))
    sequence = args.out / "sequence"
    shutil.rmtree(sequence, ignore_errors=True)
    study.run([args.rockyard, "render", SCENARIOS / "traverse_navcam.json", "--out", sequence, "--seed", SEED,
               "--pairs", args.standing, "--step-m", 0])
    kept = odometry(args, sequence, args.out / "path")
    drifts_m = [float([*row.values()][-1]) for row in study.read_csv(args.out / "path/errors.csv")]
    renewed = odometry(args, sequence, args.out / "path", "--param", "keyframe.max_way_m=0")
    end_renewed_m = renewed["errors"]["end_m"]
    shutil.rmtree(sequence)
    found = {"pairs": kept["pairs"], "gaps": kept["gaps"], "keyframe_normalized": kept["errors"]["normalized"]["mean"],
             "keyframe_above_95": kept["errors"]["normalized_above_95"], "keyframe_first_hundred_m": max(drifts_m[:100]),
             "keyframe_largest_m": max(drifts_m), "keyframe_end_m": drifts_m[-1],
             "frame_to_frame_normalized": renewed["errors"]["normalized"]["mean"],
             "frame_to_frame_above_95": renewed["errors"]["normalized_above_95"], "frame_to_frame_end_m": end_renewed_m,
             "program": kept["program"]}
    folder.write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    return found


def standing_table(found):
    header = ["", "squared error over covariance (6 if right)", "above the 95 % point, %", "at the end, mm"]
    return study.table(header, [
        ["against the first pair", f"{found['keyframe_normalized']:.2f}", f"{100 * found['keyframe_above_95']:.1f}",
         f"{1e3 * found['keyframe_end_m']:.3f}"],
        ["each pair against the one before", f"{found['frame_to_frame_normalized']:.2f}",
         f"{100 * found['frame_to_frame_above_95']:.1f}", f"{1e3 * found['frame_to_frame_end_m']:.3f}"]])


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--cases", default=",".join(name.replace(",", ";") for name in CASES),
                        help="names of cases, with ; for their commas, parted by commas; empty: none")
    parser.add_argument("--standing", type=int, default=STANDING_PAIRS, help="pairs of the standing camera; 0: none")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/runs/odometry")
    study.add_program(parser)
    study.add_page(parser)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    table = args.out / "odometry_sequences.csv"
    for name in (part.replace(";", ",") for part in args.cases.split(",") if part):
        run_case(args, name, table)
    rows = read_rows(table)
    lines = [line for line in (summary(rows, name) for name in CASES) if line]
    tables = {"odometry_cases": study.table(HEADER, lines)}
    if args.standing:
        tables["odometry_standing"] = standing_table(standing(args))
    study.show(args, tables)


if __name__ == "__main__":
    main()
