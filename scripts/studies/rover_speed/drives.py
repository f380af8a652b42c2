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
from dataclasses import replace
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402
from rover_speed import model  # noqa: E402
from rover_speed.rover_speed import WISH_M, WISH_S, WISH_SHARE  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/rover_speed.json"
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


def summary(trials):
    """Of the drives that arrive as they believe: speed made good, and parts of a metre of the course."""
    arrived = trials[trials.outcome.isin(study.ARRIVED)]
    found = {"trials": len(trials), "arrived": len(arrived)}
    speeds = model.M_PER_H * COURSE_M / arrived.sim_time_s
    found |= {name: rates.quantile(speeds, share) for name, share in (("m_per_h", 0.5), ("low", 0.05), ("high", 0.95))}
    way_m = sum(arrived.true_distance_m) or math.nan
    found["detour"] = way_m / (COURSE_M * len(arrived)) if len(arrived) else math.nan
    found |= {name: sum(amount) / way_m for name, amount in (
        ("wheels_s_m", arrived.move_time_s), ("rest_s_m", arrived.sim_time_s - arrived.move_time_s),
        ("looks_m", arrived.image_sets), ("poses_m", arrived.visual_steps), ("turns_m", arrived.point_turns))}
    errors = arrived.position_error_m / arrived.true_distance_m
    return found | {"error_share": rates.quantile(errors, 0.5), "error_share_95": rates.quantile(errors, 0.95)}


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


OF_A_DRIVE = {"drive": "{drive}", "computer": lambda line: computer_of(line["computer"]).name, "rocks, k": "{k_per_m2:g}"}


def drives_parts(lines):
    return study.listed([line for line in lines if line["arrived"] and line["computer"] in SHOWN], OF_A_DRIVE | {
        "way over course": "{detour:.2f}", "wheels, s/m": "{wheels_s_m:.1f}", "at rest, s/m": "{rest_s_m:.1f}",
        "looks a metre": "{looks_m:.2f}", "poses a metre": "{poses_m:.2f}", "turns in place a metre": "{turns_m:.2f}",
        "closed form over simulated speed": lambda line: f"{line['closed_m_per_h'] / line['m_per_h']:.2f}"})


def drives_wish(lines):
    """Legs of the course, strung together to a day; wheels as much faster as the rover is too slow."""
    return study.listed([line for line in lines if line["computer"] in WISHED and line["arrived"]], OF_A_DRIVE | {
        "legs that arrive, %": lambda line: f"{100 * line['arrived'] / line['trials']:.0f}",
        "in three hours, m": lambda line: f"{DAY_H * line['m_per_h']:.0f}",
        "wheels for 675 m, cm/s": lambda line: f"{100 * ROVER_M_S * WISH_M / (DAY_H * line['m_per_h']):.1f}",
        "error over way, %: median (95 %)":
            lambda line: f"{100 * line['error_share']:.2g} ({100 * line['error_share_95']:.2g})",
        "3 %?": lambda line: "yes" if line["error_share_95"] <= WISH_SHARE else "no"})


def draw(path, lines):
    """m/h by abundance of the drives with vision, a diagram for each computer."""
    def points(profile, drive):
        own = [line for line in lines if (line["computer"], line["drive"]) == (profile, drive)]
        return [(0.0, *[own[0]["closed_m_per_h"]] * 3),
                *sorted((line["k_per_m2"], line["m_per_h"], line["low"], line["high"]) for line in own)]
    study.write_svg(path, [(f"{computer_of(profile).name}: m/h", [
        (drive, points(profile, drive)) for drive in DRIVES if drive != "stops by wheels"])
        for profile in dict.fromkeys(line["computer"] for line in lines)], "k, rocks (0: closed form)")


TABLES = {"drives_speed": drives_speed, "drives_parts": drives_parts, "drives_wish": drives_wish}


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "rover_speed")
    args = parser.parse_args()
    cells, _ = study.counted_sweep(args, SWEEP, ("drive", "computer", "k_per_m2"))
    lines = list(lines_of(cells, model.read_times(study.ROOT / "results/studies/compute_times.csv")))
    study.write_csv(args.out / "rover_speed_drives.csv", lines)
    draw(args.out / "rover_speed_drives.svg", lines)
    study.show(args, {name: make(lines) for name, make in TABLES.items()})


if __name__ == "__main__":
    main()
