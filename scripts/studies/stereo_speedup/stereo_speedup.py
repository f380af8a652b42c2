#!/usr/bin/env python3
"""What vectors save in the stages of stereo, beside Goldberg 2002 section 3, and how its time divides among
them, beside table 2.

Runs the benchmark, or reads what it printed before, and prints two tables of ratios; --json keeps what it
printed, from which results/reference/goldberg2002_stereo.json has its inputs.

    scripts/studies/stereo_speedup/stereo_speedup.py [--rounds 200] [--json FILE] [--benchmark PROGRAM | --times FILE]
"""

import argparse
import json
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

# Row, stages that belong to it, and what the paper prints: MMX over C on a Pentium III.
SPEEDUPS = (("Difference of Gaussian and Decimate", ("reduce", "filter"), "2"),
            ("of it, the difference of Gaussians", ("filter",), ""),
            ("Prepare Next Row", ("prepare_row",), "4.8"),
            ("Inner Loop", ("compare",), "1.5"),
            ("Compute Sub-Pixel", ("decide",), "0.77 (1.3 times slower)"),
            ("all, with optimizing compilers", ("all",), "2.5"))

# Row of table 2, stages, s as printed.
TABLE_2 = (("Pyramid level box filter", ("reduce",), 0.277),
           ("DoG and pyrlevel 0 downsample", ("filter",), 0.83),
           ("rectification", ("rectify",), 0.013),
           ("pre-processing", (), 0.013),
           ("correl, minim, subpix, lrlos", ("prepare_row", "compare", "decide"), 3.34),
           ("blob filtering", ("blob",), 0.161))


def total(parts, stages):
    return sum(parts[stage] for stage in stages)


def speedup(sides, scalar, vectors, stages):
    """Time of some stages by scalar code over that by vectors."""
    times = [total(sides[name]["share"], stages) / sides[name]["pairs_per_s"] for name in (scalar, vectors)]
    return times[0] / times[1]


def share(side, stages):
    """Of the time of all rows of table 2."""
    everything = [stage for _, others, _ in TABLE_2 for stage in others]
    return total(side["share"], stages) / total(side["share"], everything)


def sides_of(measured, case):
    """By name, as people call instruction sets."""
    return {side["name"].replace("AVX3", "AVX-512"): side for side in
            next(entry for entry in measured["cases"] if entry["name"] == case)["sides"]}


def print_speedups(sides):
    vectors = [name for name in sides if name not in ("unoptimized", "optimized")]
    print(study.table(["function", "paper", *(f"{name} over {scalar}" for scalar in ("optimized C++", "unoptimized")
                                              for name in vectors)], [
        [name, printed, *(f"{speedup(sides, scalar, vector, stages):.1f}"
                          for scalar in ("optimized", "unoptimized") for vector in vectors)]
        for name, stages, printed in SPEEDUPS]))
    rates = ", ".join(f"{name} {side['pairs_per_s']:.0f}" for name, side in sides.items())
    print(f"\nPairs a second (paper: just over 20): {rates}.\n")


def print_shares(sides):
    sum_s = sum(time_s for _, _, time_s in TABLE_2)
    print(study.table(["row of table 2", "paper", *sides], [
        [f"{name} (%)", f"{100 * time_s / sum_s:.1f}",
         *(f"{100 * share(side, stages):.1f}" if stages else "none" for side in sides.values())]
        for name, stages, time_s in TABLE_2]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=200, help="of which the shortest times count (200)")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--benchmark", type=Path,
                        default=study.ROOT / "build/test/tests/vision/stereo_speedup_benchmark")
    parser.add_argument("--times", type=Path, help="what the benchmark printed before")
    args = parser.parse_args()
    text = (args.times.read_text(encoding="utf-8") if args.times else study.run([args.benchmark, args.rounds]))
    if args.json:
        args.json.write_text(text, encoding="utf-8")
    measured = json.loads(text)
    print_speedups(sides_of(measured, "section_3"))
    print_shares(sides_of(measured, "table_2"))


if __name__ == "__main__":
    main()
