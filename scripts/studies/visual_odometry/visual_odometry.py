#!/usr/bin/env python3
"""What visual odometry is worth: drives by wheels and gyro, by vision, and by both, on three terrains.

Counts the sweep scenarios/sweeps/visual_odometry.json, which it runs or goes on with:
  worth      true success, position error at the end (median, 5 to 95 %), steps and failures of vision
  computers  what vision adds to the time of a drive on each computer, in closed form: steps times the
             computer's time of a step, and pairs of images times their acquisition (clock.compute)
  visual_odometry.svg   position error by the way that was driven, median and 5 to 95 %
With --images FOLDER=NAME,... (runs from rendered images, on the sweep's seed) it also compares both fidelities in
paired trials. Writes visual_odometry.csv and the drawing.

    scripts/studies/visual_odometry/visual_odometry.py [--sweep FOLDER] [--out FOLDER] [--markdown results/visual_odometry.md]
"""

import math
import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/visual_odometry.json"
COLUMNS = ("position_error_m", "true_distance_m", "sim_time_s", "energy_wh", "visual_steps", "visual_failures",
           "heading_error_deg")
# Seconds of a step, and where the number is from (src/trial/README.md).
COMPUTERS = {"MER, RAD6000": 160.0, "MSL, RAD750": 160.0 * 22 / 400, "Virtex 5 and a Pentium-class computer": 0.1}
ACQUISITION_S = 8.974
BINS = 6


def read_cells(folder):
    """Trials by (terrain, localization): lists of rows in the order of trials."""
    cells = defaultdict(list)
    for levels, trial, row in study.stored_trials(folder, COLUMNS):
        cells[levels["terrain"], levels["localization"]].append(row | {"trial": trial})
    return cells


def summary(rows):
    reached = sum(row["outcome"] == "goal_reached" for row in rows)
    low, high = study.wilson_interval(reached, len(rows))
    errors = [row["position_error_m"] for row in rows]
    steps = sum(row["visual_steps"] for row in rows)
    return {"trials": len(rows), "success": reached / len(rows), "success_low": low, "success_high": high,
            "error_median_m": study.quantile(errors, 0.5), "error_05_m": study.quantile(errors, 0.05),
            "error_95_m": study.quantile(errors, 0.95), "steps": steps / len(rows),
            "failed": sum(row["visual_failures"] for row in rows) / steps if steps else math.nan,
            "time_s": sum(row["sim_time_s"] for row in rows) / len(rows),
            "energy_wh": sum(row["energy_wh"] for row in rows) / len(rows),
            "way_m": sum(row["true_distance_m"] for row in rows) / len(rows)}


def worth_table(rows):
    lines = ["| terrain, localization | true success, % | position error at the end, m: median (5 to 95 %) | "
             "steps of vision a drive | without a motion, % |", "|---|---|---|---|---|"]
    for row in rows:
        failed = "" if math.isnan(row["failed"]) else f"{100 * row['failed']:.2f}"
        lines.append(f"| {row['terrain']}, {row['localization']} | {100 * row['success']:.1f} "
                     f"({100 * row['success_low']:.0f}..{100 * row['success_high']:.0f}) | "
                     f"{row['error_median_m']:.2f} ({row['error_05_m']:.2f} to {row['error_95_m']:.2f}) | "
                     f"{row['steps']:.1f} | {failed} |")
    return "\n".join(lines)


def computers_table(rows):
    lines = ["| terrain | a drive without vision's part, s | " +
             " | ".join(f"vision on {name}, s" for name in COMPUTERS) + " |",
             "|---" * (2 + len(COMPUTERS)) + "|"]
    for row in rows:
        if row["localization"] != "vision":
            continue
        added = [row["steps"] * step_s + (row["steps"] + 1) * ACQUISITION_S for step_s in COMPUTERS.values()]
        lines.append(f"| {row['terrain']} | {row['time_s']:.0f} | " +
                     " | ".join(f"{value:.0f} (+{100 * value / row['time_s']:.0f} %)" for value in added) + " |")
    return "\n".join(lines)


def paired_table(cells, images):
    """Both fidelities on the same trials: rows of trials.csv of runs from images."""
    lines = ["| terrain, localization | trials | true success: images, error model | only one arrived: images, "
             "model | position error, m, median: images, model | steps without a motion, %: images, model |",
             "|---|---|---|---|---|---|"]
    for key, folder in images.items():
        seen = {int(row["trial"]): row for row in study.read_csv(Path(folder) / "trials.csv")}
        model = {row["trial"]: row for row in cells[key]}
        pairs = [(seen[i], model[i]) for i in sorted(seen) if i in model]
        both = [(a["outcome"] == "goal_reached", b["outcome"] == "goal_reached") for a, b in pairs]
        failed = [100 * sum(float(p[k]["visual_failures"]) for p in pairs) /
                  max(sum(float(p[k]["visual_steps"]) for p in pairs), 1) for k in (0, 1)]
        errors = [study.quantile([float(p[k]["position_error_m"]) for p in pairs], 0.5) for k in (0, 1)]
        lines.append(f"| {key[0]}, {key[1]} | {len(pairs)} | {sum(a for a, _ in both)}, {sum(b for _, b in both)} | "
                     f"{sum(a and not b for a, b in both)}, {sum(b and not a for a, b in both)} | "
                     f"{errors[0]:.3f}, {errors[1]:.3f} | {failed[0]:.2f}, {failed[1]:.2f} |")
    return "\n".join(lines)


def draw(path, cells):
    panels = []
    for terrain in dict.fromkeys(key[0] for key in cells):
        series = []
        for localization in dict.fromkeys(key[1] for key in cells):
            rows = sorted(cells[terrain, localization], key=lambda row: row["true_distance_m"])
            points = []
            for i in range(BINS):
                part = rows[i * len(rows) // BINS:(i + 1) * len(rows) // BINS]
                if part:
                    errors = [row["position_error_m"] for row in part]
                    way = study.quantile([row["true_distance_m"] for row in part], 0.5)
                    points.append((way, study.quantile(errors, 0.5), study.quantile(errors, 0.05), study.quantile(errors, 0.95)))
            series.append((localization, points))
        panels.append((f"{terrain}: position error, m", series))
    study.write_svg(path, panels, "way driven (m)")


def parse_images(text):
    """TERRAIN/LOCALIZATION=FOLDER, joined by commas."""
    images = {}
    for part in filter(None, (text or "").split(",")):
        key, _, folder = part.partition("=")
        terrain, _, localization = key.partition("/")
        images[terrain, localization] = folder
    return images


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "visual_odometry", "write the tables between the marks of this page")
    parser.add_argument("--images", metavar="TERRAIN/LOCALIZATION=FOLDER,...",
                        help="runs of the same trials from rendered images")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, read_cells)
    rows = [{"terrain": key[0], "localization": key[1]} | summary(trials) for key, trials in cells.items()]
    args.out.mkdir(parents=True, exist_ok=True)
    study.write_csv(args.out / "visual_odometry.csv", rows)
    draw(args.out / "visual_odometry.svg", cells)
    tables = {"worth": worth_table(rows), "computers": computers_table(rows)}
    images = parse_images(args.images)
    if images:
        tables["fidelities"] = paired_table(cells, images)
    for name, text in tables.items():
        study.show(args, name, text + note)


if __name__ == "__main__":
    main()
