#!/usr/bin/env python3
"""Whether two ways to compute the same trials are equivalent, by margins that were set beforehand.

    step      multibody in 480 Hz steps against its 60 Hz steps
    fidelity  quasi-static against multibody

The same trials (same seed, same index) are driven both ways. Differences are second less first, with
intervals of 90 %: two one-sided tests at 5 % (Schuirmann 1987). Rates: Tango's score interval of pairs
(1998; asymptotic, so a few dozen pairs prove nothing); means: Student's of the paired differences;
their ratio: Student's of the residuals (linearized). The verdict is "equivalent" where the interval lies
between the margins, "different" where all of it lies beyond one, and "cannot tell" where it holds one:
more pairs are needed. "-": reported, no margin.

Pairs are shared out among as many seeds, one after the other from --seed, and pooled; the column `by seed`
has the difference of each.

A finished run in its folder is taken as it is, an interrupted one goes on, one of other settings is
refused. --markdown writes the tables between <!-- begin STUDY --> and <!-- end STUDY --> of a page.

Exit code: 0 all that has a margin is equivalent, 1 something is not, or cannot be told.

    scripts/studies/equivalence/equivalence.py [--studies step] [--trials 100] [--csv FILE] [--markdown PAGE]
"""

import argparse
import sys
from pathlib import Path

import pandas as pd

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

CONFIDENCE = 0.90
PATHFINDER = study.ROOT / "scenarios/pathfinder"
QUASI_STATIC = ["rover.fidelity=quasi_static"]
# Name and settings of the first and of the second way.
SIDES = {"step": (("60", []), ("480", ["rover.physics.step_s=0.0020833333333333333"])),
         "fidelity": (("multibody", []), ("quasi_static", QUASI_STATIC))}
# Cells by name: scenario, pairs, settings.
CELLS = {
    "step": {"nominal": ("nominal", 1000, []), "vl2": ("vl2", 2400, [])},
    "fidelity": {"nominal": ("nominal", 3000, []),
                 "obstacles_0.85": ("obstacles_0.85", 3000, []),
                 "k_0.006": ("nominal", 3000, ["terrain.rocks.k_per_m2=0.006"]),
                 "k_0.0085": ("nominal", 3000, ["terrain.rocks.k_per_m2=0.0085"]),
                 "vl2": ("vl2", 3000, []),
                 # Pointed rocks stand on level ground.
                 "slope_10": ("nominal", 3000, ["terrain.ground.slope_deg=10",
                                                "terrain.rocks.pointedness=0"])}}
SEEDS = {"step": 1, "fidelity": 3}
RATES = {"declared success (%)": ("goal_reached", "false_goal"), "true success (%)": ("goal_reached",),
         "jams (%)": ("jammed", "high_centred")}
# Name: column, digits.
MEANS = {"true distance (m)": ("true_distance_m", 3),
         "distance error (%)": ("distance_error_percent", 2),
         "position error (m)": ("position_error_m", 3)}
RATIO = "true distance (% of the first)"
# Margins in the measure's unit, either way.
MARGINS = {("step", "nominal"): {"declared success (%)": 5.0, "true success (%)": 5.0},
           ("step", "vl2"): {RATIO: 5.0, "jams (%)": 4.0},
           **{("fidelity", cell): {"declared success (%)": 3.0, "true success (%)": 3.0} for cell in CELLS["fidelity"]}}


def verdict(values, margin):
    """Of (difference, low, high); `margin` is None or its size."""
    if margin is None:
        return "-"
    _, low, high = values
    if -margin < low and high < margin:
        return "equivalent"
    return "different" if low > margin or high < -margin else "cannot tell"


def rate_row(pairs, outcomes):
    """Rates of both and their difference with its interval, in per cent and points."""
    first, second = (pairs[f"outcome_{side}"].isin(outcomes) for side in (1, 2))
    n, lost, gained = len(pairs), int((first & ~second).sum()), int((second & ~first).sum())
    both = int((first & second).sum())
    low, high = rates.paired_difference(both, lost, gained, n - both - lost - gained, CONFIDENCE, "tango")
    return {"pairs": n, "first": 100.0 * first.sum() / n, "second": 100.0 * second.sum() / n,
            "difference": 100.0 * (gained - lost) / n, "low": 100.0 * low, "high": 100.0 * high,
            "only_first": lost, "only_second": gained}


def finite_pairs(pairs, column):
    return pairs[[f"{column}_1", f"{column}_2"]].dropna().to_numpy().T


def mean_row(pairs, column):
    first, second = finite_pairs(pairs, column)
    difference, low, high = rates.mean(second - first, CONFIDENCE, "student")
    return {"pairs": len(first), "first": first.mean(), "second": second.mean(), "difference": difference,
            "low": low, "high": high}


def ratio_row(pairs, column):
    """Of the means: first is 100 %, the difference what the second has more."""
    first, second = finite_pairs(pairs, column)
    ratio, low, high = (100.0 * value for value in rates.ratio_of_sums(second, first, CONFIDENCE, "student"))
    return {"pairs": len(first), "first": 100.0, "second": ratio, "difference": ratio - 100.0,
            "low": low - 100.0, "high": high - 100.0}


def cell_rows(name, cell, sets):
    """One row a measure, from the trials of both ways, pair by pair; `sets` is by seed."""
    measures = [(measure, 1, rate_row, outcomes) for measure, outcomes in RATES.items()]
    measures += [(measure, digits, mean_row, column) for measure, (column, digits) in MEANS.items()]
    measures.append((RATIO, 1, ratio_row, "true_distance_m"))
    found = []
    for measure, digits, row_of, what in measures:
        values = row_of(pd.concat(sets), what)
        values["by_seed"] = " ".join(f"{row_of(pairs, what)['difference']:.{digits}f}" for pairs in sets)
        margin = MARGINS[name, cell].get(measure)
        interval = [values[key] for key in ("difference", "low", "high")]
        found.append({"study": name, "cell": cell, "measure": measure, "only_first": "",
                      "only_second": "", **values, "margin": "" if margin is None else margin,
                      "verdict": verdict(interval, margin), "digits": digits})
    return found


def paired(runs, trials):
    """The first trials by number that both runs have, columns ending in _1 and _2; no simulator faults."""
    first, second = (run.trials[run.trials.outcome != "simulator_fault"] for run in runs)
    both = first[first.index < trials].join(second, lsuffix="_1", rsuffix="_2", how="inner")
    return both if len(both) else sys.exit(f"{runs[0].folder}, {runs[1].folder}: no trial ended in both runs")


def measure(args, name):
    """Rows of a study, and the programs that made its runs."""
    rows, programs = [], set()
    seeds = SEEDS[name]
    for cell, (scenario, pairs, changes) in CELLS[name].items():
        trials, sets = max(1, min(args.trials, pairs) // seeds), []
        for seed in range(args.seed, args.seed + seeds):
            own, runs = argparse.Namespace(**vars(args) | {"trials": trials, "seed": seed}), []
            for side, settings in SIDES[name]:
                folder = args.out / name / (f"{cell}_{side}" if seeds == 1 else f"{cell}_{side}_{seed}")
                print(f"{name}/{cell}_{side}: {trials} trials ({folder})", file=sys.stderr, flush=True)
                runs.append(study.run_scenario(own, PATHFINDER / f"{scenario}.json", folder,
                                               [*args.set, *changes, *settings], existing=["--resume"]))
            programs |= {study.program(run) for run in runs}
            sets.append(paired(runs, trials))
            if len(sets[-1]) < trials:
                print(f"{name}/{cell}: {trials - len(sets[-1])} of {trials} pairs left out for simulator "
                      "faults", file=sys.stderr)
        rows += cell_rows(name, cell, sets)
    return rows, programs


def seeds_text(first, count):
    return f"Seed {first}" if count == 1 else f"Seeds {first} to {first + count - 1}"


def text_of(args, name, rows, programs):
    (first, _), (second, _) = SIDES[name]

    change = lambda row: study.with_interval([row[key] for key in ("difference", "low", "high")], row["digits"])
    made = " and ".join(sorted(programs)) + (": not one program" if len(programs) > 1 else "")
    return study.listed(rows, {
        "cell": "{cell}", "measure": "{measure}", "pairs": "{pairs}", first: "{first:.{digits}f}",
        second: "{second:.{digits}f}", "second less first (90 %)": change,
        **({"by seed": "{by_seed}"} if SEEDS[name] > 1 else {}),
        "margin": lambda row: f"{row['margin']:g}" if row["margin"] else "-", "verdict": "{verdict}"}) + (
            f"\n\n{seeds_text(args.seed, SEEDS[name])}; {study.held(args)}made by rockyard {made}.")


def write_rows(path, rows, studies):
    """Rows of other studies that the file has stay."""
    kept = []
    if path.is_file():
        kept = [row for row in study.read_csv(path) if row["study"] not in studies]
    rows = kept + [{key: value for key, value in row.items() if key != "digits"} for row in rows]
    study.write_csv(path, sorted(rows, key=lambda row: list(CELLS).index(row["study"])))


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--studies", nargs="+", choices=list(CELLS), default=list(CELLS))
    study.add_run_arguments(parser, trials=max(pairs for cells in CELLS.values() for _, pairs, _ in cells.values()),
                            out="equivalence")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write the rows to this file")
    study.add_page(parser)
    args = parser.parse_args()
    if args.trials < 2:
        parser.error("--trials must be 2 or more")
    return args


def main():
    args = parse_arguments()
    found = []
    for name in [name for name in CELLS if name in args.studies]:
        rows, programs = measure(args, name)
        rows = [{**row, "seed": args.seed, "program": " and ".join(sorted(programs))} for row in rows]
        found += rows
        study.show(args, {name: text_of(args, name, rows, programs)})
        if args.csv:
            write_rows(args.csv, rows, [name])
    return int(any(row["verdict"] in ("different", "cannot tell") for row in found))


if __name__ == "__main__":
    sys.exit(main())
