#!/usr/bin/env python3
"""Times and errors of visual odometry beside Howard 2012: one hundred pairs of 512 x 384 pixels with 400 features, a
whole step, and poses by the number of features.

Runs both benchmarks some rounds; of each time the least counts, as others only lengthen it, and of the hundred pairs
that round whose median is least. Prints a table and writes what results/reference/howard2012_odometry.json has its
inputs from.

    scripts/odometry_speed_study.py [--rounds 5] [--json results/studies/odometry_speed.json] [--build build/test]
"""

import argparse
import json
import sys
from pathlib import Path

import study


def measured(program, pattern):
    """Benchmarks by name."""
    text = study.run([program, f"--benchmark_filter={pattern}", "--benchmark_format=json"])
    return {entry["name"]: entry for entry in json.loads(text)["benchmarks"]}


def hundred_pairs(rounds):
    """Milliseconds a pair of that round whose median of all is least."""
    best = min(rounds, key=lambda entry: entry["all_median_ms"])
    return {"pairs": 100, "features": best["features"], "matches": best["matches"],
            **{f"{part}_ms": best[f"{part}_median_ms"] for part in ("detect", "match", "all")},
            "instruction_set": best["label"]}


def by_features(rounds):
    """A line a number of features: least CPU time of a step's 12 known motions, a motion."""
    lines = []
    for name in rounds[0]:
        entries = [entry[name] for entry in rounds]
        first = entries[0]
        lines.append({"features": first["features"], "found": first["found"], "mm": first["mm"], "deg": first["deg"],
                      "ms": min(entry["cpu_time"] for entry in entries) / 12})
    return lines


def table(document):
    lines = [[f"{entry['features']:.0f}", f"{entry['mm']:.3f}", f"{entry['deg']:.4f}", f"{entry['ms']:.1f}"]
             for entry in document["by_features"]]
    return study.table(["features", "rms error, mm", "deg", "ms"], lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--build", type=Path, default=study.ROOT / "build/test")
    args = parser.parse_args()
    programs = args.build / "tests/vision"
    pairs, steps, features = [], [], []
    for _ in range(args.rounds):
        pairs.append(measured(programs / "odometry_benchmark", "^HundredPairs")["HundredPairs"])
        steps.append(measured(programs / "odometer_benchmark", "^Step/1$")["Step/1"])
        features.append(measured(programs / "odometer_benchmark", "^Features"))
    document = {"rounds": args.rounds, "hundred_pairs": hundred_pairs(pairs),
                "step_ms": min(entry["cpu_time"] for entry in steps), "by_features": by_features(features)}
    if args.json:
        args.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(document["hundred_pairs"]), f"\na step: {document['step_ms']:.2f} ms\n")
    print(table(document))
    return 0


if __name__ == "__main__":
    sys.exit(main())
