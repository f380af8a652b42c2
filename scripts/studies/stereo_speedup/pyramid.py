#!/usr/bin/env python3
"""What a level of the image pyramid saves and costs (Goldberg 2002 section 2): eight times the time, twice
the error of a range?

Renders pairs of a scenario's terrain with exact disparities, matches each at levels 0 to 3 with the range of
disparities halved from level to level, and compares ranges with the truth, in bands of range. Wrong matches
(more than a pixel of the level off) are counted apart, as they have no error of resolution. Times are of the
benchmark, which matches a synthetic pair of the same size.

Prints two tables; --csv also writes the first one for programs.

    scripts/studies/stereo_speedup/pyramid.py [--pairs 6] [--scenario FILE] [--csv FILE]
        [--rockyard PROGRAM] [--render-pair PROGRAM] [--benchmark PROGRAM | --times FILE]
"""

import argparse
import array
import csv
import json
import math
import sys
import tempfile
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

LEVELS = (0, 1, 2, 3)
COLUMNS = 512
DISPARITIES = 96  # at level 0: ground from 1.3 m on
VIEW_DEG = 45.0
BASELINE_M = 0.2
FOCAL_PX = COLUMNS / 2 / math.tan(math.radians(VIEW_DEG / 2))
BANDS_M = ((1.5, 2.0), (2.0, 3.0), (3.0, 4.5))
BUILD = study.ROOT / "build/test"


def read_pfm(path):
    """(width, height, values row by row from above) of a grey PFM file."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"Pf":
            sys.exit(f"{path} is no grey PFM file")
        width, height = map(int, file.readline().split())
        scale = float(file.readline())
        values = array.array("f")
        values.frombytes(file.read(4 * width * height))
    if (scale < 0) != (sys.byteorder == "little"):
        values.byteswap()
    rows = [values[row * width:(row + 1) * width] for row in range(height)]
    return width, height, [value for row in reversed(rows) for value in row]


def truth_at(level, width, height, truth):
    """Disparities at a level, px of it; NaN where the square shows more than one surface."""
    side = 1 << level
    reduced = []
    for y in range(height >> level):
        for x in range(width >> level):
            square = [truth[(y * side + k) * width + x * side + i]
                      for k in range(side) for i in range(side)]
            mean = sum(square) / len(square)
            flat = math.isfinite(mean) and max(square) - min(square) < side
            reduced.append(mean / side if flat else math.nan)
    return reduced


def range_m(disparity_px, level):
    return FOCAL_PX / (1 << level) * BASELINE_M / disparity_px


class Tally:
    """Of one level and band: pixels seen, matched, wrong, and squared errors of the rest."""

    def __init__(self):
        self.known = self.matched = self.wrong = 0
        self.range_squares = self.disparity_squares = 0.0

    def add(self, level, found, true):
        self.known += 1
        if not math.isfinite(found) or found <= 0:
            return
        self.matched += 1
        if abs(found - true) > 1:
            self.wrong += 1
            return
        self.disparity_squares += (found - true) ** 2
        self.range_squares += (range_m(found, level) - range_m(true, level)) ** 2

    def row(self, level, band):
        right = max(self.matched - self.wrong, 1)
        return {"level": level, "near_m": band[0], "far_m": band[1], "pixels": self.known,
                "matched": self.matched / max(self.known, 1), "wrong": self.wrong / max(self.matched, 1),
                "disparity_rms_px": math.sqrt(self.disparity_squares / right),
                "range_rms_mm": 1000 * math.sqrt(self.range_squares / right)}


def measure(args):
    """Rows by level and band, over all pairs."""
    tallies = {(level, band): Tally() for level in LEVELS for band in BANDS_M}
    with tempfile.TemporaryDirectory() as folder:
        for pair in range(args.pairs):
            stem = Path(folder) / f"pair{pair}"
            study.run([args.render_pair, args.scenario, stem, f"columns={COLUMNS}", f"trial={pair}",
                       f"view_deg={VIEW_DEG}", f"baseline_m={BASELINE_M}"])
            width, height, truth = read_pfm(f"{stem}_disparity.pfm")
            for level in LEVELS:
                out = Path(f"{stem}_{level}")
                study.run([args.rockyard, "stereo", f"{stem}_left.png", f"{stem}_right.png", "--out", out,
                           "--param", f"pyramid_level={level}", "--param", "correlator.min_disparity_px=0",
                           "--param", f"correlator.disparities={DISPARITIES >> level}",
                           "--param", f"filters.blob_min_px={max(100 >> 2 * level, 1)}"])
                found = read_pfm(out / "disparity.pfm")[2]
                for measured, true in zip(found, truth_at(level, width, height, truth)):
                    if not math.isfinite(true) or true <= 0:
                        continue
                    for band in BANDS_M:
                        if band[0] <= range_m(true, level) < band[1]:
                            tallies[level, band].add(level, measured, true)
    return [tallies[level, band].row(level, band) for band in BANDS_M for level in LEVELS]


def match_times(sides, name):
    """Time of a level without its reduction, by the benchmark's side of that name; s."""
    side = next(side for side in sides if side["name"] == name)
    return (1 - side["share"]["reduce"]) / side["pairs_per_s"]


def print_errors(rows):
    print("| range | level | matched | wrong (%) | rms of disparity (px of the level) | rms of range (mm) "
          "| over the level before |\n| --- | --- | --- | --- | --- | --- | --- |")
    before = None
    for row in rows:
        ratio = "" if row["level"] == 0 else f"{row['range_rms_mm'] / before:.2f}"
        before = row["range_rms_mm"]
        print(f"| {row['near_m']} .. {row['far_m']} m | {row['level']} | {row['matched']:.2f} "
              f"| {100 * row['wrong']:.2f} | {row['disparity_rms_px']:.3f} | {row['range_rms_mm']:.1f} "
              f"| {ratio} |")


def print_times(measured):
    cases = {case["name"]: case["sides"] for case in measured["cases"]}
    names = [side["name"] for side in cases["level_0"]]
    print("| time of a level over that of the next | "
          + " | ".join(name.replace("AVX3", "AVX-512") for name in names) + " |")
    print("| --- |" + " --- |" * len(names))
    for level in LEVELS[1:]:
        ratios = [match_times(cases[f"level_{level - 1}"], name) / match_times(cases[f"level_{level}"], name)
                  for name in names]
        print(f"| {level - 1} over {level} | " + " | ".join(f"{ratio:.1f}" for ratio in ratios) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--pairs", type=int, default=6, help="pairs to render (6)")
    parser.add_argument("--scenario", type=Path, default=study.ROOT / "scenarios/pathfinder/nominal.json")
    parser.add_argument("--csv", type=Path)
    parser.add_argument("--rockyard", type=Path, default=BUILD / "bin/rockyard")
    parser.add_argument("--render-pair", type=Path, default=BUILD / "tests/rendering/render_pair")
    parser.add_argument("--benchmark", type=Path, default=BUILD / "tests/vision/stereo_speedup_benchmark")
    parser.add_argument("--times", type=Path, help="what the benchmark printed before")
    args = parser.parse_args()
    rows = measure(args)
    print_errors(rows)
    if args.csv:
        with open(args.csv, "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows({key: f"{value:.6g}" if isinstance(value, float) else value
                              for key, value in row.items()} for row in rows)
    text = args.times.read_text(encoding="utf-8") if args.times else study.run([args.benchmark])
    print()
    print_times(json.loads(text))
    return 0


if __name__ == "__main__":
    sys.exit(main())
