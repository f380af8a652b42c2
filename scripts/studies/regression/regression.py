#!/usr/bin/env python3
"""What the regression check finds, and how often it cries wolf.

Two parts. The project's own campaign (scenarios/sweeps/regression.json) with deliberate changes and
without, with the baseline's seeds and with others, held against a baseline. And 2000 campaigns
resampled from pools of 20,000 trials of each of its cells (tests/report/regression_study.cc): false
alarms of unchanged builds, and how often a success rate that fell by 0.10 is found. Writes
regression.csv, regression_power.csv and regression.md. Pools and runs that are there are used again.

    scripts/studies/regression/regression.py --rockyard BUILD/bin/rockyard \\
        --study BUILD/tests/report/regression_study --markdown results/studies/regression.md
"""

import argparse
import json
import shutil
import sys
from itertools import product
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import ROOT, run  # noqa: E402

SWEEP = ROOT / "scenarios/sweeps/regression.json"
BASELINE = ROOT / "results/baselines/regression.json"
# Settings of the Pathfinder scenarios, changed; the GESTALT cell gets the same values.
CHANGES = {
    # A standard deviation times 3 is a variance times 9.
    "gyro noise x 3": ["sensors.gyro.heading_variance_deg2_per_m=6.3"],
    # 0.9951, which takes the known error away, times 1.05.
    "encoder scale + 5 %": ["perception.dead_reckoning.distance_scale=1.0449"],
    "stripe points missed 5 %": ["sensors.light_stripe.missed_probability=0.05"],
    "wheel friction - 20 %": ["rover.contact.wheel_rock_friction=0.64"],
    "hazard threshold 5 to 6 cm": ["perception.hazard.neighbour_threshold_m=0.06"],
    "rocks kept off the mirror lines": ["terrain.rocks.mirror_line=keep_off"],
}
CODES = (0, 1, 4)  # no change, changed, inconclusive
FIRST_OTHER_SEED = 101
POOL_SEED = 424242
POOL_TRIALS = 20000
HEAD = ("study", "seed", "exit_code", "records_changed", "primary_changed", "secondary_changed",
        "primary_inconclusive", "furthest")


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    parser.add_argument("--study", type=Path, default=ROOT / "build/release/tests/report/regression_study")
    parser.add_argument("--baseline", type=Path, default=BASELINE)
    parser.add_argument("--reruns", type=int, default=15, help="unchanged, with other seeds (15)")
    parser.add_argument("--repeats", type=int, default=2, help="of each change, other seeds (2)")
    parser.add_argument("--campaigns", type=int, default=2000, help="resampled (2000)")
    parser.add_argument("--pool", type=int, default=POOL_TRIALS, help="trials of a pool (20000)")
    parser.add_argument("--seed", type=int, default=1, help="of the resampling")
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs/regression_study")
    parser.add_argument("--markdown", type=Path, default=ROOT / "results/studies/regression.md")
    return parser.parse_args()


def furthest(metrics):
    changed = [row for row in metrics if row["verdict"] == "changed"]
    if not changed:
        return ""
    row = max(changed, key=lambda r: abs(r["difference"]) / r["margin"])
    return f"{row['cell'].removeprefix('cell=')}: {row['metric']} {row['difference']:+.3g} {row['unit']}"


def run_and_check(args, name, seed, settings):
    folder = args.out / "campaign"
    shutil.rmtree(folder, ignore_errors=True)
    run([args.rockyard, "sweep", SWEEP, "--out", folder, "--quiet", *study.settings(settings),
         *(["--seed", seed] if seed is not None else [])])
    check = study.called([args.rockyard, "check", folder, "--against", args.baseline, "--json",
                          "--allow-scenario-change"], codes=CODES)
    told = json.loads(check.stdout)

    def count(verdict, family):
        return sum(row["verdict"] == verdict and row["family"] == family for row in told["metrics"])

    pairs = sum(cell["records"]["pairs"] for cell in told["cells"])
    changed = sum(cell["records"]["changed"] for cell in told["cells"])
    return dict(zip(HEAD, (name, "baseline's" if seed is None else seed, check.returncode,
                           f"{changed} of {pairs}" if pairs else "-", count("changed", "primary"),
                           count("changed", "secondary"), count("inconclusive", "primary"),
                           furthest(told["metrics"]))))


def campaigns(args):
    seeds = [FIRST_OTHER_SEED + i for i in range(max(args.reruns, args.repeats))]
    cases = [("unchanged", None, [])]
    cases += [("unchanged", seed, []) for seed in seeds[:args.reruns]]
    for name, settings in CHANGES.items():
        cases += [(name, seed, settings) for seed in [None, *seeds[:args.repeats]]]
    rows = []
    for case in cases:
        rows.append(run_and_check(args, *case))
        study.write_csv(args.markdown.with_suffix(".csv"), rows)
    return rows


def pools(args):
    """Baselines of one cell each, of many trials."""
    sweep = json.loads(SWEEP.read_text(encoding="utf-8"))
    settings = [f"{path}={value}" for path, value in sweep["set"].items()]
    paths = []
    for level in sweep["axes"][0]["levels"]:
        folder = args.out / f"pool_{level['name']}"
        paths.append(folder.with_suffix(".json"))
        if paths[-1].exists():
            continue
        pool = argparse.Namespace(rockyard=args.rockyard, trials=args.pool, seed=POOL_SEED)
        study.run_scenario(pool, SWEEP.parent / level["scenario"], folder, settings, existing=["--resume"])
        run([args.rockyard, "baseline", folder, "--reason", "a pool", "--out", paths[-1]])
    return paths


def resample(args):
    trials = json.loads(SWEEP.read_text(encoding="utf-8"))["trials"]
    path = args.markdown.with_name("regression_power.csv")
    if not path.exists():
        path.write_text(run([args.study, trials, args.campaigns, args.seed, *pools(args)]), encoding="utf-8")
    return study.read_csv(path)


def spread(values):
    low, high = min(values), max(values)
    return f"{low}" if low == high else f"{low} to {high}"


def campaign_table(rows):
    lines = []
    for name, same in product(dict.fromkeys(row["study"] for row in rows), (True, False)):
        some = [row for row in rows if row["study"] == name and (row["seed"] == "baseline's") == same]
        if some:
            lines.append([name, "the same" if same else "others", str(len(some)),
                          ", ".join(str(sum(row["exit_code"] == code for row in some)) for code in CODES),
                          some[0]["records_changed"], spread([row["primary_changed"] for row in some]),
                          spread([row["secondary_changed"] for row in some]), some[0]["furthest"]])
    return study.table(["build", "seeds", "runs", "exit codes 0, 1, 4", "records changed", "primary metrics changed",
                        "secondary", "moved furthest for its margin (first run)"], lines, "---") + "\n"


def percent(row, name):
    count, campaigns_ = int(row[name]), int(row["campaigns"])
    low, high = float(row[f"{name}_low"]), float(row[f"{name}_high"])
    return f"{100 * count / campaigns_:.1f} ({100 * low:.1f} .. {100 * high:.1f})"


def alarm_table(rows):
    return study.listed([row for row in rows if row["study"].startswith("unchanged")], {
        "unchanged builds": lambda row: row["study"].removeprefix("unchanged: "), "campaigns": "{campaigns}",
        "alarm, % (95 %)": lambda row: percent(row, "alarms"), "of the primary family": "{primary_alarms}",
        "of the secondary": "{secondary_alarms}", "exit code 4": "{inconclusive}"}, "---") + "\n"


def power_table(rows):
    return study.listed([row for row in rows if not row["study"].startswith("unchanged")], {
        "success 0.10 lower": "{cell}", "rate": "{metric}",
        "pairs that differ": lambda row: f"{float(row['discordance']):.1f}", "campaigns": "{campaigns}",
        "found, % (95 %)": lambda row: percent(row, "found")}, "---") + "\n"


def page(rows, power, trials, campaign_count):
    return f"""# The regression check on the project's own campaign

`scripts/studies/regression/regression.py` writes this page. The campaign is `scenarios/sweeps/regression.json`: 3 cells of
{trials} quasi-static trials. Primary metrics are declared and true success, distance, time and three errors of
each cell, all others are secondary; each check prints what each family has of the chance of a false alarm.

## Builds that were changed, and others

Exit codes: 0 no change, 1 changed, 4 inconclusive. Records are compared where seeds are the same.

{campaign_table(rows)}
How the changes are made stands in the script (`CHANGES`); where a cell has no such part, it is unchanged.

## False alarms

{campaign_count} campaigns, each with other trials for the baseline and for the run, drawn from pools of
{POOL_TRIALS} trials of each cell. "Other seeds" are compared as groups; "pairs at random" as pairs, as if the
seeds were the same and every record another one, which is what a rewritten sum makes of chaotic drives.

{alarm_table(power)}
## A success rate 0.10 lower, at the baseline's seeds

Of the same trials as many outcomes change for the worse, and a tenth of all trials fewer for the better, that
the share of pairs in the table differs. Rates so near 1 that no such change exists have no row.

{power_table(power)}"""


def main():
    args = parse_arguments()
    args.out.mkdir(parents=True, exist_ok=True)
    power = resample(args)
    rows = campaigns(args)
    trials = json.loads(SWEEP.read_text(encoding="utf-8"))["trials"]
    args.markdown.write_text(page(rows, power, trials, power[0]["campaigns"]), encoding="utf-8")


if __name__ == "__main__":
    main()
