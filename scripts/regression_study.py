#!/usr/bin/env python3
"""How well the regression check does on the project's own campaign.

Runs scenarios/sweeps/regression.json with other seeds (nothing changed: alarms are false) and with
deliberate changes (each must be caught), holds every run against a baseline, and writes one line
for each: exit code of the check, verdicts, and the metric that moved most for its margin.

    scripts/regression_study.py BUILD/bin/rockyard results/baselines/regression.json OUT.csv
"""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SWEEP = ROOT / "scenarios/sweeps/regression.json"

# Settings of the Pathfinder scenarios, changed; the GESTALT cell gets the same values.
CHANGES = {
    # A standard deviation times 3 is a variance times 9.
    "gyro noise x 3": ["sensors.gyro.heading_variance_deg2_per_m=6.3"],
    # 0.9201, which takes the known error away, times 1.05.
    "encoder scale + 5 %": ["perception.dead_reckoning.distance_scale=0.9661"],
    "stripe points missed 5 %": ["sensors.light_stripe.missed_probability=0.05"],
    "wheel friction - 20 %": ["rover.contact.wheel_rock_friction=0.64"],
}
FIRST_OTHER_SEED = 101


def run_and_check(program, baseline, folder, arguments):
    """Exit code of the check and its rows."""
    done = subprocess.run([program, "sweep", SWEEP, "--out", folder, "--quiet", "--force"] + arguments,
                          check=False, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{arguments}: {done.stderr}")
    table = folder / "check.csv"
    done = subprocess.run([program, "check", folder, "--against", baseline, "--csv", table,
                           "--allow-scenario-change"],
                          check=False, capture_output=True, text=True)
    if done.returncode not in (0, 1, 4):
        sys.exit(f"{arguments}: {done.stderr}")
    with open(table, encoding="utf-8", newline="") as file:
        return done.returncode, list(csv.DictReader(file))


def count(rows, verdict):
    return sum(row["verdict"] == verdict for row in rows)


def furthest(rows):
    changed = [row for row in rows if row["verdict"] == "changed"]
    if not changed:
        return ""
    row = max(changed, key=lambda r: abs(float(r["difference"])) / float(r["margin"]))
    return f"{row['cell']}: {row['metric']} {float(row['difference']):+.3g} {row['unit']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("baseline")
    parser.add_argument("out")
    parser.add_argument("--reruns", type=int, default=20, help="unchanged, with other seeds (20)")
    parser.add_argument("--repeats", type=int, default=10,
                        help="of each change, with other seeds: the share caught is its power (10)")
    arguments = parser.parse_args()

    studies = [("unchanged, same seed", [])]
    for name, settings in CHANGES.items():
        options = [part for setting in settings for part in ("--set", setting)]
        studies.append((f"{name}, same seed", options))
        studies += [(f"{name}, seed {FIRST_OTHER_SEED + i}",
                     options + ["--seed", str(FIRST_OTHER_SEED + i)])
                    for i in range(arguments.repeats)]
    studies += [(f"unchanged, seed {FIRST_OTHER_SEED + i}", ["--seed", str(FIRST_OTHER_SEED + i)])
                for i in range(arguments.reruns)]
    with tempfile.TemporaryDirectory() as scratch, open(arguments.out, "w", encoding="utf-8",
                                                        newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["study", "exit_code", "changed", "equivalent", "inconclusive", "furthest"])
        for name, options in studies:
            code, rows = run_and_check(arguments.program, arguments.baseline,
                                       pathlib.Path(scratch) / "run", options)
            writer.writerow([name, code, count(rows, "changed"), count(rows, "equivalent"),
                             count(rows, "inconclusive"), furthest(rows)])
            out.flush()


if __name__ == "__main__":
    main()
