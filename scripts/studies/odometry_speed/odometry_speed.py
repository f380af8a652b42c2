#!/usr/bin/env python3
"""Times and errors of visual odometry beside Howard 2012: one hundred pairs of 512 x 384 pixels with 400 features, a
whole step, and poses by the number of features.

Runs both benchmarks some rounds; of each time the least counts, as others only lengthen it, and of the hundred pairs
that round whose median is least. Prints a table; --json keeps what results/reference/howard2012_odometry.json has its
inputs from, and --reference writes them there. --from reads that file in place of running anything.

    scripts/studies/odometry_speed/odometry_speed.py [--rounds 5] [--json results/studies/odometry_speed.json]
        [--reference results/reference/howard2012_odometry.json] [--from FILE] [--build build/test]
"""

import json
import re
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402


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
        lines.append({"asked": int(name.split("/")[1]), "features": first["features"], "found": first["found"], "mm": first["mm"], "deg": first["deg"],
                      "ms": min(entry["cpu_time"] for entry in entries) / 12})
    return lines


def inputs(document):
    """The two numbers of each measured row of the reference, by its id."""
    pairs = document["hundred_pairs"]
    rows = {"time.front": (pairs["all_ms"], 1), "time.match": (pairs["match_ms"], 1),
            "time.match_share": (pairs["match_ms"], pairs["all_ms"]), "time.rate": (1000, document["step_ms"]),
            "vo.features": (pairs["features"], 1), "vo.region_features": (pairs["features"], 16)}
    lines = document["by_features"]
    for half, twice in zip(lines, lines[1:]):
        for row, name in (("quality.mm", "mm"), ("quality.deg", "deg"), ("cost.ms", "ms")):
            rows[f"{row}_{twice['asked']}"] = (twice[name], half[name])
    return rows


def with_inputs(text, document):
    """A reference, a row a line, with its inputs as they were measured, to four digits."""
    measured_inputs = inputs(document)

    def line_with(line):
        found = re.search(r'"id": "([^"]+)"', line)
        if not found or found[1] not in measured_inputs:
            return line
        numbers = ", ".join(f"{number:.4g}" for number in measured_inputs[found[1]])
        return re.sub(r'"inputs": \[[^]]*\]', f'"inputs": [{numbers}]', line)

    return "\n".join(line_with(line) for line in text.split("\n"))


def table(document):
    return study.listed(document["by_features"], {"features": "{features:.0f}", "rms error, mm": "{mm:.3f}",
                                                  "deg": "{deg:.4f}", "ms": "{ms:.1f}"})


def measure(args):
    programs = args.build / "tests/vision"
    pairs, steps, features = [], [], []
    for _ in range(args.rounds):
        pairs.append(measured(programs / "odometry_benchmark", "^HundredPairs")["HundredPairs"])
        steps.append(measured(programs / "odometer_benchmark", "^Step/predicted$")["Step/predicted"])
        features.append(measured(programs / "odometer_benchmark", "^Features"))
    return {"rounds": args.rounds, "hundred_pairs": hundred_pairs(pairs),
            "step_ms": min(entry["cpu_time"] for entry in steps), "by_features": by_features(features)}


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--json", type=Path)
    parser.add_argument("--build", type=Path, default=study.ROOT / "build/test")
    parser.add_argument("--reference", type=Path)
    parser.add_argument("--from", type=Path, dest="kept", metavar="FILE", help="what --json kept before")
    args = parser.parse_args()
    document = json.loads(args.kept.read_text(encoding="utf-8")) if args.kept else measure(args)
    if args.json:
        args.json.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    if args.reference:
        args.reference.write_text(with_inputs(args.reference.read_text(encoding="utf-8"), document), encoding="utf-8")
    print(json.dumps(document["hundred_pairs"]), f"\na step: {document['step_ms']:.2f} ms\n")
    print(table(document))


if __name__ == "__main__":
    main()
