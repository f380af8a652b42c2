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
import csv
import json
import math
import sys
import tempfile
from itertools import product
from pathlib import Path

import numpy as np

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


def truth_at(level, truth):
    """Disparities at a level, px of it; NaN where the square shows more than one surface."""
    side = 1 << level
    rows, columns = (length // side for length in truth.shape)
    squares = truth[:rows * side, :columns * side].reshape(rows, side, columns, side)
    flat = squares.max(axis=(1, 3)) - squares.min(axis=(1, 3)) < side
    return np.where(flat, squares.mean(axis=(1, 3)) / side, math.nan)


def range_m(disparity_px, level):
    return FOCAL_PX / (1 << level) * BASELINE_M / disparity_px


def row_of(level, band, found, true):
    """Of one level and band, by found and true disparities: pixels, shares matched and wrong, errors of the rest."""
    matched = np.isfinite(found) & (found > 0)
    right = matched & (abs(found - true) <= 1)
    rms = lambda errors: math.sqrt((errors ** 2).sum() / max(len(errors), 1))
    found, true, pixels, matches = found[right], true[right], len(true), matched.sum()
    return {"level": level, "near_m": band[0], "far_m": band[1], "pixels": pixels,
            "matched": matches / max(pixels, 1), "wrong": (matches - right.sum()) / max(matches, 1),
            "disparity_rms_px": rms(found - true),
            "range_rms_mm": 1000 * rms(range_m(found, level) - range_m(true, level))}


def measure(args):
    """Rows by level and band, over all pairs."""
    pixels = {level: [] for level in LEVELS}
    with tempfile.TemporaryDirectory() as folder:
        for pair, level in product(range(args.pairs), LEVELS):
            stem = Path(folder) / f"pair{pair}"
            if level == 0:
                study.run([args.render_pair, args.scenario, stem, f"columns={COLUMNS}", f"trial={pair}",
                           f"view_deg={VIEW_DEG}", f"baseline_m={BASELINE_M}"])
                truth = study.read_portable(f"{stem}_disparity.pfm")
            out = Path(f"{stem}_{level}")
            study.run([args.rockyard, "stereo", f"{stem}_left.png", f"{stem}_right.png", "--out", out,
                       "--param", f"pyramid_level={level}", "--param", "correlator.min_disparity_px=0",
                       "--param", f"correlator.disparities={DISPARITIES >> level}",
                       "--param", f"filters.blob_min_px={max(100 >> 2 * level, 1)}"])
            found, true = study.read_portable(out / "disparity.pfm"), truth_at(level, truth)
            pixels[level].append(np.array([found, true])[:, true > 0])
    rows = []
    for band, level in product(BANDS_M, LEVELS):
        found, true = np.concatenate(pixels[level], axis=1)
        within = (band[0] <= range_m(true, level)) & (range_m(true, level) < band[1])
        rows.append(row_of(level, band, found[within], true[within]))
    return rows


def match_times(sides, name):
    """Time of a level without its reduction, by the benchmark's side of that name; s."""
    side = next(side for side in sides if side["name"] == name)
    return (1 - side["share"]["reduce"]) / side["pairs_per_s"]


def print_errors(rows):
    def line(row, before):
        ratio = "" if row["level"] == 0 else f"{row['range_rms_mm'] / before['range_rms_mm']:.2f}"
        return [f"{row['near_m']} .. {row['far_m']} m", str(row["level"]), f"{row['matched']:.2f}", f"{100 * row['wrong']:.2f}",
                f"{row['disparity_rms_px']:.3f}", f"{row['range_rms_mm']:.1f}", ratio]
    print(study.table(["range", "level", "matched", "wrong (%)", "rms of disparity (px of the level)", "rms of range (mm)",
                       "over the level before"], map(line, rows, [None, *rows])))


def print_times(measured):
    cases = {case["name"]: case["sides"] for case in measured["cases"]}
    names = [side["name"] for side in cases["level_0"]]
    print(study.table(["time of a level over that of the next", *(name.replace("AVX3", "AVX-512") for name in names)], [
        [f"{level - 1} over {level}", *(
            f"{match_times(cases[f'level_{level - 1}'], name) / match_times(cases[f'level_{level}'], name):.1f}"
            for name in names)] for level in LEVELS[1:]]))


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


if __name__ == "__main__":
    main()
