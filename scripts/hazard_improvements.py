#!/usr/bin/env python3
"""Shows what better sensors do to hazard detection: the improvements of Matthies 1995, section 6.

Usage: scripts/hazard_improvements.py ROCKYARD OUT [--share S]

Runs scenarios/hazard_detection with each improvement (run folders below OUT; what is there goes on
where it stopped) and prints two tables in Markdown and the program that made them. S scales the
number of runs. Alarms are rates of a scan, not of an alarm.
  geometric  denser arrays: height at which half of the rocks are seen, false alarms
  image      beam fan, lasers at once, imager: rocks seen and false alarms from images
"""

import argparse
import json
import sys
from pathlib import Path

import study

SCENARIOS = study.ROOT / "scenarios/hazard_detection"
SENSOR = "sensors.light_stripe."
STRIPES_9 = [f"{SENSOR}stripe_subdivision=2", "navigation.pathfinder.left_stripes=[0,1,2,3]",
             "navigation.pathfinder.centre_stripes=[4]",
             "navigation.pathfinder.right_stripes=[5,6,7,8]"]
ROWS_7 = [f"{SENSOR}row_subdivision=2"]
REACH_2 = ["perception.hazard.neighbour_reach=2"]

GEOMETRIC = {
    "published, 4 x 5": [],
    "7 rows": ROWS_7,
    "9 stripes": STRIPES_9,
    "7 x 9": ROWS_7 + STRIPES_9,
    "7 x 9, neighbours two apart": ROWS_7 + STRIPES_9 + REACH_2,
}
ALL_LASERS = [f"{SENSOR}lasers_per_image=5"]
FAN_3 = [f"{SENSOR}laser.fan=three_scanlines"]
CMOS = [f"{SENSOR}imager.kind=cmos"]
# Overrides, and the electrical input of a laser as a share of the published one.
IMAGE = {
    "published": ([], 1.0),
    "all lasers at once": (ALL_LASERS, 1.0),
    "fan of 3 scanlines, 1/100 of the power": (FAN_3, 0.01),
    "fan of 3 scanlines, the same power": (FAN_3, 1.0),
    "CMOS imager": (CMOS, 1.0),
}
LASER_W = 0.66
# Where light is scarce: a quarter of the power, on Earth, the sun at 70 degrees.
FAINT_SHARE = 0.25
FAINT_SUN_DEG = 70


def run(options, name, scenario, overrides):
    """Runs a scenario with overrides, or goes on with its run; returns the summary."""
    folder = options.out / f"{scenario}-{name}".replace(" ", "_").replace(",", "").replace("/", "-")
    path = SCENARIOS / f"{scenario}.json"
    trials = json.loads(path.read_text(encoding="utf-8"))["trials"]
    options.trials = max(1, round(trials * options.share))
    summary = study.run_scenario(options, path, folder, overrides)
    options.programs.add(study.program(summary))
    return summary


def crossing(summary):
    """Height at which half of the rocks are believed, by straight lines between the cells."""
    curve = [(cell["height_m"], cell["detected_double"]["rate"]) for cell in summary["cells"]]
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if y0 < 0.5 <= y1:
            return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0)
    return float("nan")


def pooled(summary, rate):
    """A rate over all cells together, with the total of its base."""
    count = sum(cell[rate]["count"] for cell in summary["cells"])
    base = sum(cell[rate]["trials"] for cell in summary["cells"])
    return f"{count / base:.4f} of {base}"


def geometric(options):
    """Prints the table of denser arrays."""
    print("| array | half are seen at | of rocks of 7.5 cm | false alarms a scan, 1 wrong point in "
          "100 | believed alarms a scan |\n|---|---|---|---|---|")
    for name, overrides in GEOMETRIC.items():
        factor = run(options, name, "height_factor", overrides)
        alarms = run(options, name, "false_alarm",
                     overrides + ["hazard_detection.wrong_place_probabilities=[0.01]"])
        seen = [cell["detected_double"]["rate"] for cell in factor["cells"]
                if cell["height_m"] == 0.075]
        print(f"| {name} | {100 * crossing(factor):.2f} cm | {seen[0]:.3f} | "
              f"{pooled(alarms, 'alarm_single')} | {pooled(alarms, 'alarm_believed')} |")


def image(options):
    """Prints the table of better lights and imagers."""
    print("\n| sensor, from images | rocks seen by one scan | believed | false alarms a scan in faint "
          "light | believed alarms a scan |\n|---|---|---|---|---|")
    for name, (overrides, share) in IMAGE.items():
        power = [f"{SENSOR}laser.input_power_w={LASER_W * share:g}"]
        seen = run(options, name, "detection_image", overrides + power)
        faint = [f"hazard_detection.sun_elevations_deg=[{FAINT_SUN_DEG}]",
                 f"hazard_detection.laser_powers_w=[{LASER_W * share * FAINT_SHARE:g}]"]
        alarms = run(options, name, "false_alarm_image_earth", overrides + faint)
        print(f"| {name} | {pooled(seen, 'detected_single')} | {pooled(seen, 'detected_double')} | "
              f"{pooled(alarms, 'alarm_single')} | {pooled(alarms, 'alarm_believed')} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rockyard", help="the rockyard command")
    parser.add_argument("out", type=Path, help="folder for the runs")
    parser.add_argument("--share", type=float, default=1.0, help="of the scenarios' runs")
    parser.add_argument("--level", choices=["geometric", "image", "both"], default="both")
    parser.add_argument("--seed", type=int, default=1, help="seed of the runs")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    options.programs = set()
    if options.level != "image":
        geometric(options)
    if options.level != "geometric":
        image(options)
    print(f"\n{options.share:g} of the shipped runs, seed {options.seed}; made by rockyard "
          f"{', '.join(sorted(options.programs))}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
