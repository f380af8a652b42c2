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
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates, ry  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/visual_odometry.json"
KEY = ("terrain", "localization")
# Seconds of a step, and where the number is from (src/trial/README.md).
COMPUTERS = {"MER, RAD6000": 160.0, "MSL, RAD750": 160.0 * 22 / 400, "Virtex 5 and a Pentium-class computer": 0.1}
ACQUISITION_S = 8.974
BINS = 6


def error_quantiles(trials):
    """Median, 5 and 95 % of the position error."""
    return [rates.quantile(trials.position_error_m, share) for share in (0.5, 0.05, 0.95)]


def summary(trials):
    count, reached = len(trials), int(trials.outcome.eq("goal_reached").sum())
    steps = sum(trials.visual_steps)
    mean = lambda name: sum(trials[name]) / count
    low, high = rates.wilson_interval(reached, count)
    return {"trials": count, "success": reached / count, "success_low": low, "success_high": high,
            **dict(zip(("error_median_m", "error_05_m", "error_95_m"), error_quantiles(trials))), "steps": steps / count,
            "failed": sum(trials.visual_failures) / steps if steps else math.nan,
            "time_s": mean("sim_time_s"), "energy_wh": mean("energy_wh"), "way_m": mean("true_distance_m")}


def worth_table(rows):
    return study.table(["terrain, localization", "true success, %", "position error at the end, m: median (5 to 95 %)",
                  "steps of vision a drive", "without a motion, %"], [
        [f"{row['terrain']}, {row['localization']}",
         f"{100 * row['success']:.1f} ({100 * row['success_low']:.0f}..{100 * row['success_high']:.0f})",
         f"{row['error_median_m']:.2f} ({row['error_05_m']:.2f} to {row['error_95_m']:.2f})", f"{row['steps']:.1f}",
         "" if math.isnan(row["failed"]) else f"{100 * row['failed']:.2f}"] for row in rows], "---")


def computers_table(rows):
    def added(row, step_s):
        value_s = row["steps"] * step_s + (row["steps"] + 1) * ACQUISITION_S
        return f"{value_s:.0f} (+{100 * value_s / row['time_s']:.0f} %)"
    return study.table(["terrain", "a drive without vision's part, s", *(f"vision on {name}, s" for name in COMPUTERS)], [
        [row["terrain"], f"{row['time_s']:.0f}", *(added(row, step_s) for step_s in COMPUTERS.values())]
        for row in rows if row["localization"] == "vision"], "---")


def paired_table(cells, images):
    """Both fidelities on the same trials, by runs from images."""
    lines = []
    for key, folder in images.items():
        pairs = ry.Run(folder).trials.merge(cells[key], on="trial", suffixes=("", "_model"))
        seen, model = (pairs[f"outcome{side}"].eq("goal_reached") for side in ("", "_model"))
        failed = [100 * pairs[f"visual_failures{side}"].sum() / max(pairs[f"visual_steps{side}"].sum(), 1)
                  for side in ("", "_model")]
        errors = [rates.quantile(pairs[f"position_error_m{side}"], 0.5) for side in ("", "_model")]
        lines.append([", ".join(key), f"{len(pairs)}", f"{seen.sum()}, {model.sum()}",
                      f"{(seen & ~model).sum()}, {(model & ~seen).sum()}", f"{errors[0]:.3f}, {errors[1]:.3f}",
                      f"{failed[0]:.2f}, {failed[1]:.2f}"])
    return study.table(["terrain, localization", "trials", "true success: images, error model",
                  "only one arrived: images, model", "position error, m, median: images, model",
                  "steps without a motion, %: images, model"], lines, "---")


def curve(trials):
    """Position errors by the way driven, in bins of as many drives."""
    ordered = trials.sort_values("true_distance_m", kind="stable")
    parts = [ordered[i * len(ordered) // BINS:(i + 1) * len(ordered) // BINS] for i in range(BINS)]
    return [(rates.quantile(part.true_distance_m, 0.5), *error_quantiles(part)) for part in parts if len(part)]


def draw(path, cells):
    study.write_svg(path, [(f"{terrain}: position error, m", [
        (localization, curve(cells[terrain, localization])) for localization in dict.fromkeys(key[1] for key in cells)])
        for terrain in dict.fromkeys(key[0] for key in cells)], "way driven (m)")


def parse_images(text):
    """TERRAIN/LOCALIZATION=FOLDER, joined by commas."""
    parts = (part.partition("=") for part in (text or "").split(",") if part)
    return {tuple(key.split("/", 1)): folder for key, _, folder in parts}


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "visual_odometry")
    parser.add_argument("--images", metavar="TERRAIN/LOCALIZATION=FOLDER,...",
                        help="runs of the same trials from rendered images")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, KEY)
    rows = [dict(zip(KEY, key)) | summary(trials) for key, trials in cells.items()]
    study.write_csv(args.out / "visual_odometry.csv", rows)
    draw(args.out / "visual_odometry.svg", cells)
    images = parse_images(args.images)
    study.show(args, {"worth": worth_table(rows), "computers": computers_table(rows)}
               | ({"fidelities": paired_table(cells, images)} if images else {}), note)


if __name__ == "__main__":
    main()
