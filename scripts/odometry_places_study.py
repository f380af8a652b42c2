#!/usr/bin/env python3
"""Visual odometry with places from the right eye beside places from a disparity map, on the same rendered images.

Renders sequences of stereo pairs along an oracle's route (`rockyard render --pairs --route`), has `rockyard vo`
follow each with either source of places, nothing else changed, and deletes the images. Writes one line a sequence
and source into odometry_places.csv and draws the position error along the way, its median and its least and
largest over the sequences, as odometry_places.svg. The cases stood here before the first run. What is there
already is done again.

    scripts/odometry_places_study.py [--out results/studies] [--work FOLDER] [--rockyard PROGRAM]
"""

import argparse
import csv
import json
import shutil
import statistics
from dataclasses import dataclass
from pathlib import Path

import study

SCENARIOS = study.ROOT / "scenarios/visual_odometry"
SEED = 20261126
SLIP = 0.1
SOURCES = {"right_eye": "right eye", "disparity_map": "disparity map"}
BINS = 8


@dataclass(frozen=True)
class Case:
    scenario: str
    way_m: float
    step_m: float
    sequences: int = 6


CASES = {"navcam, 75 cm": Case("traverse_navcam", 20.0, 0.75),
         "hazcam, 25 cm": Case("traverse_hazcam", 10.0, 0.25)}


def render(args, case, trial, folder):
    study.run([args.rockyard, "render", SCENARIOS / f"{case.scenario}.json", "--out", folder, "--seed", SEED, "--trial",
               trial, "--pairs", round(3 * case.way_m / case.step_m), "--step-m", case.step_m, "--route", "--slip", SLIP,
               "--set", f"course.goal_x_m={case.way_m:g}"])


def follow(args, sequence, source):
    """What vo says, and (true way, position error) of every pair."""
    folder = args.work / "path"
    found = json.loads(study.run(
        [args.rockyard, "vo", sequence, "--cameras", sequence / "cameras.json", "--truth", sequence / "poses.txt",
         "--predict", sequence / "wheels.txt", "--out", folder, "--param", f"placement.source={source}", "--json"]))
    with open(folder / "errors.csv", encoding="utf-8", newline="") as file:
        return found, along(list(csv.DictReader(file)))


def along(rows):
    """(true way, position error) of the lines of errors.csv."""
    points, way, last = [], 0.0, None
    for row in rows:
        here = [float(row[f"true_{axis}_m"]) for axis in "xyz"]
        if last:
            way += sum((a - b) ** 2 for a, b in zip(here, last)) ** 0.5
        last = here
        points.append((way, float(row["error_m"])))
    return points


def row_of(case, trial, source, found):
    errors = found["errors"]
    normalized = errors["normalized"] or {"mean": float("nan")}
    return {"case": case, "trial": trial, "source": source, "pairs": found["pairs"], "gaps": found["gaps"],
            "distance_m": errors["distance_m"], "end_m": errors["end_m"], "end_percent": errors["end_percent"],
            "step_rms_mm": 1e3 * errors["relative_m"]["rms"], "step_rms_deg": errors["relative_deg"]["rms"],
            "normalized_mean": normalized["mean"], "above_95": errors["normalized_above_95"],
            "place_ms": found["times"]["place"]["median_ms"], "program": found["program"]}


def curve(sequences):
    """(way, median, least, largest error) over bins of the way; each sequence gives its mean in a bin."""
    longest = max(points[-1][0] for points in sequences)
    curves = []
    for i in range(BINS):
        low, high = i * longest / BINS, (i + 1) * longest / BINS
        means = []
        for points in sequences:
            inside = [error for way, error in points if low <= way < high or (i == BINS - 1 and way == high)]
            if inside:
                means.append(statistics.mean(inside))
        if means:
            curves.append((0.5 * (low + high), statistics.median(means), min(means), max(means)))
    return curves


HEADER = ["camera, step", "places from", "sequences", "steps without a motion", "error of a step, mm (median)",
          "deg (median)", "end error, % of the way: median (least, most)", "e' P^-1 e, mean (6 if right)",
          "time of places, ms (least)"]


def line_of(rows, case, source):
    mine = [row for row in rows if row["case"] == case and row["source"] == source]

    def median(name):
        return statistics.median(float(row[name]) for row in mine)

    ends = [float(row["end_percent"]) for row in mine]
    steps = sum(int(row["pairs"]) - 1 for row in mine)
    return [case, SOURCES[source], str(len(mine)), f"{sum(int(row['gaps']) for row in mine)} of {steps}",
            f"{median('step_rms_mm'):.2f}", f"{median('step_rms_deg'):.4f}",
            f"{statistics.median(ends):.2f} ({min(ends):.2f}, {max(ends):.2f})", f"{median('normalized_mean'):.1f}",
            f"{min(float(row['place_ms']) for row in mine):.1f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/studies")
    parser.add_argument("--work", type=Path, default=study.ROOT / "results/runs/odometry_places")
    parser.add_argument("--rockyard", type=Path, default=study.ROOT / "build/release/bin/rockyard")
    args = parser.parse_args()
    args.work.mkdir(parents=True, exist_ok=True)
    rows, panels = [], []
    for name, case in CASES.items():
        paths = {source: [] for source in SOURCES}
        for trial in range(case.sequences):
            sequence = args.work / "sequence"
            shutil.rmtree(sequence, ignore_errors=True)
            render(args, case, trial, sequence)
            for source in SOURCES:
                found, points = follow(args, sequence, source)
                rows.append(row_of(name, trial, source, found))
                paths[source].append(points)
        shutil.rmtree(args.work / "sequence")
        panels.append((f"{name}: error, m",
                       [(SOURCES[source], curve(sequences)) for source, sequences in paths.items()]))
    study.write_csv(args.out / "odometry_places.csv", rows)
    study.write_svg(args.out / "odometry_places.svg", panels, "way (m); bars: least to most of the sequences")
    print(study.table(HEADER, [line_of(rows, case, source) for case in CASES for source in SOURCES]))


if __name__ == "__main__":
    main()
