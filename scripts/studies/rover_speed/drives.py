#!/usr/bin/env python3
"""Rovers' speeds among rocks beside their closed form (model.py), by computer, navigator and estimator.

Counts the sweep scenarios/sweeps/rover_speed.json, which it runs or goes on with:
  drives_speed   metres an hour made good by rock abundance, and the closed form
  drives_parts   what a metre takes: detours, rolling and steering, looks and poses, beside the closed form
  drives_wish    the Smart Lander's wish (Goldberg 2002 section 6): a day of three hours, and the position
Writes rover_speed_drives.csv and rover_speed_drives.svg.

    scripts/studies/rover_speed/drives.py [--sweep FOLDER] [--out FOLDER] [--markdown results/speed.md]
"""

import math
import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from rover_speed import model  # noqa: E402
from rover_speed.rover_speed import WISH_M, WISH_S, WISH_SHARE  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/rover_speed.json"
COLUMNS = ("sim_time_s", "true_distance_m", "move_time_s", "imaging_time_s", "compute_time_s", "move_overhead_time_s",
           "image_sets", "visual_steps", "point_turns", "position_error_m")
ARRIVED = ("goal_reached", "false_goal")  # as the rover believes
COURSE_M = 15.0 - 0.5                     # from the start to within the tolerance of the goal
# What the closed form takes of each drive: rover, navigator, estimator. A look each 35 cm and a pose each 75 cm, or
# motions of a metre (scenarios/continuous). On the move poses are computed beside looks, as on two processors, so that
# no plan waits for them.
STOPPING = replace(model.ATHENA.middle, step_m=0.35)
MOVING = replace(model.ATHENA.middle, step_m=1.0)
DRIVES = {"stops by wheels": (STOPPING, "stop", "wheels"), "stops by vision": (STOPPING, "stop", "vision"),
          "CSOD": (MOVING, "csod", "wheels"), "CSAD": (MOVING, "csad", "wheels")}
ROVER_M_S = STOPPING.speed_m_s
SHOWN = ("mer_rad6000", "athena_2012")         # of the parts
WISHED = ("athena_2012",)                      # which does not hold up the rover
DAY_H = WISH_S / model.M_PER_H
CAMERAS = {"mer_rad6000": model.SLOW_CAMERAS}  # all others: fast


def computer_of(profile):
    return next(computer for computer in model.COMPUTERS if computer.profile == profile)


def closed_form(rows, drive, profile):
    """m/h, on a course without rocks."""
    rover, navigator, estimator = DRIVES[drive]
    times = model.times_of(rows, computer_of(profile), CAMERAS.get(profile, model.FAST_CAMERAS))
    return model.M_PER_H * model.speed(rover, times, navigator, "stereo", estimator)


def read_cells(folder):
    """Trials by (drive, computer, rocks a square metre)."""
    cells = defaultdict(list)
    for levels, _, row in study.stored_trials(folder, COLUMNS):
        cells[levels["drive"], levels["computer"], float(levels["k_per_m2"])].append(row)
    return cells


def summary(rows):
    """Of the drives that arrive as they believe: speed made good, and parts of a metre of the course."""
    arrived = [row for row in rows if row["outcome"] in ARRIVED]
    found = {"trials": len(rows), "arrived": len(arrived)}
    speeds = [model.M_PER_H * COURSE_M / row["sim_time_s"] for row in arrived] or [math.nan]
    found |= {"m_per_h": study.quantile(speeds, 0.5), "low": study.quantile(speeds, 0.05), "high": study.quantile(speeds, 0.95)}
    way_m = sum(row["true_distance_m"] for row in arrived) or math.nan
    total = {name: sum(row[name] for row in arrived) for name in COLUMNS}
    found["detour"] = way_m / (COURSE_M * len(arrived)) if arrived else math.nan
    found["wheels_s_m"] = total["move_time_s"] / way_m
    at_rest_s = total["sim_time_s"] - total["move_time_s"]
    found["rest_s_m"] = at_rest_s / way_m
    found["looks_m"] = total["image_sets"] / way_m
    found["poses_m"] = total["visual_steps"] / way_m
    found["turns_m"] = total["point_turns"] / way_m
    shares = [row["position_error_m"] / row["true_distance_m"] for row in arrived] or [math.nan]
    found["error_share"], found["error_share_95"] = study.quantile(shares, 0.5), study.quantile(shares, 0.95)
    return found


def lines_of(cells, rows):
    for (drive, profile, k), trials in cells.items():
        yield ({"drive": drive, "computer": profile, "k_per_m2": k} |
               {name: round(value, 4) for name, value in summary(trials).items()} |
               {"closed_m_per_h": round(closed_form(rows, drive, profile), 3)})


def drives_speed(lines):
    abundances = sorted({line["k_per_m2"] for line in lines})
    cell = {(line["drive"], line["computer"], line["k_per_m2"]): line for line in lines}
    kinds = list(dict.fromkeys((line["drive"], line["computer"]) for line in lines))
    header = ["drive", "computer", "closed form", *(f"k = {k:g}" for k in abundances)]
    return study.table(header, [
        [drive, computer_of(profile).name, f"{cell[drive, profile, abundances[0]]['closed_m_per_h']:.3g}",
         *(shown(cell[drive, profile, k]) for k in abundances)] for drive, profile in kinds])


def shown(line):
    if line["arrived"] == 0:
        return f"- [0 of {line['trials']}]"
    return f"{line['m_per_h']:.3g} ({line['low']:.3g}..{line['high']:.3g}) [{line['arrived']} of {line['trials']}]"


def drives_parts(lines):
    header = ["drive", "computer", "rocks, k", "way over course", "wheels, s/m", "at rest, s/m", "looks a metre",
              "poses a metre", "turns in place a metre", "closed form over simulated speed"]
    return study.table(header, [
        [line["drive"], computer_of(line["computer"]).name, f"{line['k_per_m2']:g}", f"{line['detour']:.2f}",
         f"{line['wheels_s_m']:.1f}", f"{line['rest_s_m']:.1f}", f"{line['looks_m']:.2f}", f"{line['poses_m']:.2f}",
         f"{line['turns_m']:.2f}", f"{line['closed_m_per_h'] / line['m_per_h']:.2f}"]
        for line in lines if line["arrived"] and line["computer"] in SHOWN])


def drives_wish(lines):
    """Legs of the course, strung together to a day; wheels as much faster as the rover is too slow."""
    header = ["drive", "computer", "rocks, k", "legs that arrive, %", "in three hours, m", "wheels for 675 m, cm/s",
              "error over way, %: median (95 %)", "3 %?"]
    lines = [line for line in lines if line["computer"] in WISHED and line["arrived"]]
    return study.table(header, [
        [line["drive"], computer_of(line["computer"]).name, f"{line['k_per_m2']:g}",
         f"{100 * line['arrived'] / line['trials']:.0f}", f"{DAY_H * line['m_per_h']:.0f}",
         f"{100 * ROVER_M_S * WISH_M / (DAY_H * line['m_per_h']):.1f}",
         f"{100 * line['error_share']:.2g} ({100 * line['error_share_95']:.2g})",
         "yes" if line["error_share_95"] <= WISH_SHARE else "no"] for line in lines])


def draw(path, lines):
    """m/h by abundance of the drives with vision, a diagram for each computer."""
    panels = []
    for profile in dict.fromkeys(line["computer"] for line in lines):
        series = []
        for drive in [name for name in DRIVES if name != "stops by wheels"]:
            points = sorted((line["k_per_m2"], line["m_per_h"], line["low"], line["high"]) for line in lines
                            if line["computer"] == profile and line["drive"] == drive)
            closed = next(line["closed_m_per_h"] for line in lines
                          if line["computer"] == profile and line["drive"] == drive)
            series.append((drive, [(0.0, closed, closed, closed), *points]))
        panels.append((f"{computer_of(profile).name}: m/h", series))
    study.write_svg(path, panels, "k, rocks (0: closed form)")


TABLES = {"drives_speed": drives_speed, "drives_parts": drives_parts, "drives_wish": drives_wish}


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "rover_speed", "write the tables between the marks of this page")
    args = parser.parse_args()
    study.run_sweep(args, SWEEP)
    lines = list(lines_of(read_cells(args.sweep), model.read_times(study.ROOT / "results/studies/compute_times.csv")))
    study.write_csv(args.out / "rover_speed_drives.csv", lines)
    draw(args.out / "rover_speed_drives.svg", lines)
    for name, make in TABLES.items():
        text = make(lines)
        study.show(args, name, text)


if __name__ == "__main__":
    main()
