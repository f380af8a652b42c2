#!/usr/bin/env python3
"""The largest steps and rocks that Rocky 3.2 climbs, on hard ground and on the sand of the trials.

Runs tests/rover/steps_study.cc, which drives both fidelities against higher and higher obstacles:
  steps         full-width steps on hard ground and, law by law, on sand
  step_statics  the friction and the pull on the ground that steps take, by statics
  step_changes  on sand, with one or two things changed
  rocks         half balls in the tracks of the wheels of one side or of both

    cmake --build BUILD --target steps_study
    scripts/studies/steps/steps.py --program BUILD/tests/rover/steps_study [--markdown results/pathfinder.md]
"""

import csv
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

FIDELITIES = {"multibody": "multibody", "quasi_static": "quasi-static"}
LAWS = ("bekker", "intrusion")  # of the table of changes


def cm(row):
    return f"{100 * float(row['largest_m']):.3g}"


def grouped(rows, *keys):
    """Rows by some of their members, in the order in which these come."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return groups


def by_fidelity(rows):
    """Largest heights, with what stops the rover at the next one."""
    found = {row["fidelity"]: row for row in rows}
    return [f"{cm(found[name])} ({found[name]['stopped']})" for name in FIDELITIES]


def ground(key):
    return [key[0].replace("_", " "), key[1] or "-"]


def steps(printed):
    pulls = {(row["ground"], row["law"]): row for row in printed("pull")}
    return study.table(
        ["ground", "law", "pull of a wheel that spins, over its load", "under twice the load", *(f"{name}, cm" for name in FIDELITIES.values())],
        [[*ground(key), *(f"{float(pulls[key][part]):.2f}" for part in ("pull", "pull_of_twice")), *by_fidelity(rows)]
         for key, rows in grouped(printed("steps"), "ground", "law").items()])


def step_statics(printed):
    return study.listed(printed("statics"), {
        "edge, cm": lambda row: f"{100 * float(row['height_m']):.3g}",
        "friction of ground and step alike": lambda row: f"{float(row['friction']):.2f}",
        "pull over load, front wheels": lambda row: f"{float(row['front_pull']):.2f}",
        "pull over load, all wheels": lambda row: f"{float(row['pull']):.2f}"})


def step_changes(printed):
    return study.table(
        ["changed", *(f"{law}, {name}, cm" for law in LAWS for name in FIDELITIES.values())],
        [[change, *(cell for law in LAWS for cell in by_fidelity([row for row in rows if row["law"] == law]))]
         for (change,), rows in grouped(printed("changes"), "change").items()])


def rocks(printed):
    found = printed("rocks")
    kinds = list(dict.fromkeys(row["obstacle"] for row in found))
    return study.table(
        ["ground", "law", *(f"{kind}, {name}, cm" for kind in kinds for name in FIDELITIES.values())],
        [[*ground(key), *(cell for kind in kinds for cell in by_fidelity([row for row in rows if row["obstacle"] == kind]))]
         for key, rows in grouped(found, "ground", "law").items()])


TABLES = {f.__name__: f for f in (steps, step_statics, step_changes, rocks)}


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--program", type=Path, required=True, help="the built steps_study")
    args = study.parse_with_tables(parser, TABLES)

    def printed(part):
        return list(csv.DictReader(study.run([args.program, part]).splitlines()))

    study.show(args, {name: TABLES[name](printed) for name in args.tables.split(",")})


if __name__ == "__main__":
    main()
