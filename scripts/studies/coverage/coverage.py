#!/usr/bin/env python3
"""How often the intervals that are printed hold what they are about, on the project's own trials.

Runs three pools of trials, quasi-static, with the same seed: the nominal scenario, whose columns are skewed;
the same with a quarter of its rocks, where scrapes and failures are rare and skewness is extreme; and the
Viking Lander 2 scenario, which was in no choice of a constant. Each pool is taken for the whole law; tests/statistics/coverage_study.cc draws samples from it, makes every
interval of each, and counts. The page says what falls short; no number in it is typed in.

    cmake --build BUILD --target coverage_study
    scripts/studies/coverage/coverage.py --rockyard BUILD/bin/rockyard --program BUILD/tests/statistics/coverage_study
"""

import argparse
import csv
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import ROOT, run_scenario  # noqa: E402

SCENARIO = ROOT / "scenarios/pathfinder/nominal.json"
HELD_OUT = ROOT / "scenarios/pathfinder/vl2.json"
FIDELITY = "rover.fidelity=quasi_static"
SPARSE = "terrain.rocks.k_per_m2=0.001"
SIZES = (40, 100, 300)
COVERED = 0.93  # at least
WIDEST = 1.5  # times the width of the exact or the oracle's interval, at most
RARELY = 0.05  # intervals printed in fewer samples are chosen by what they say

ABOUT = """How often the 95 % intervals that `rockyard` prints hold what they are about. Made by
`scripts/studies/coverage/coverage.py`, which states no number of its own: pools of trials (`nominal`: {nominal} of
`scenarios/pathfinder/nominal.json`; `sparse`: {sparse} of the same with `{setting}`;
`held out`: {held_out} of `scenarios/pathfinder/vl2.json`; quasi-static, seed 1) are taken for the whole law, and samples are drawn from them with replacement, {samples} for every line of
`coverage.csv`. `between` compares trials of the first two. On these the constants of `statistics/sample_statistics.cc` and the fewest
trials of each metric were chosen; the third was run afterwards.

- *coverage*: share of the printed intervals that hold the pool's value, with Wilson's interval of that share.
- *below*, *above*: share of those that lie below it, and above it.
- *width*: mean width over that of the exact interval (rates: Clopper and Pearson's ends), or over the
  distance between the 2.5 and 97.5 % quantiles of the estimate itself (means, medians): the oracle's.
- *printed*: share of samples in which there is an interval. Where most values are the same (rare events),
  a mean has one only if 10 or more differ, and for each metric only from a number of trials on
  (`statistics/metric_table.cc`).

Asked for: coverage of at least {covered:.0%} and width of at most {widest} at {sizes} trials, where an
interval is printed in at least {rarely:.0%} of the samples. Lines of 30 trials show how low it could go.
"""


def number(row, key):
    try:
        return float(row[key])
    except ValueError:
        return float("nan")


def before(row):
    return "(before)" in row["kind"]


def claimed(row):
    return not before(row) and "no coverage claimed" not in row["kind"]


def judged(row):
    return claimed(row) and int(row["n"]) in SIZES and number(row, "printed") >= RARELY


def falls_short(row):
    return number(row, "coverage") < COVERED or WIDEST < number(row, "width") < float("inf")


def percent(value):
    return "-" if value != value else f"{100.0 * value:.1f}"


def width_of(row):
    width = number(row, "width")
    return f"{width:.2f}" if 0.0 < width < float("inf") else "-"


def table(rows):
    share = lambda name: lambda row: percent(number(row, name))
    return study.listed(rows, {
        "pool": "{pool}", "interval": "{kind}", "of": "`{of}`", "n": "{n}", "printed %": share("printed"),
        "coverage %": lambda row: f"{share('coverage')(row)} ({share('coverage_low')(row)} .. {share('coverage_high')(row)})",
        "below %": share("missed_below"), "above %": share("missed_above"), "width": width_of}, "---")


def of_each(rows, *key):
    """Rows by their values of the key, sorted."""
    found = {}
    for row in rows:
        found.setdefault(tuple(int(row[name]) if name == "n" else row[name] for name in key), []).append(row)
    return dict(sorted(found.items()))


def worst_of(rows):
    """Of each kind and size the line with the least coverage."""
    return [min(own, key=lambda row: number(row, "coverage")) for own in of_each(rows, "kind", "n").values()]


def widest_of(rows):
    """Largest width of each kind and size, in one line a kind."""
    widest = {key: max(own, key=lambda row: number(row, "width"))
              for key, own in of_each([row for row in rows if width_of(row) != "-"], "kind", "n").items()}
    return study.table(["interval", *(f"n = {size}" for size in SIZES)], [
        [kind, *(width_of(widest[kind, size]) if (kind, size) in widest else "-" for size in SIZES)]
        for kind in dict.fromkeys(kind for kind, _ in widest)], "---")


def none_printed(rows):
    means = [row for row in rows if row["kind"] == "mean" and int(row["n"]) in SIZES and number(row, "printed") < RARELY]
    sizes = {}
    for row in means:
        sizes.setdefault((row["pool"], row["of"]), []).append(row["n"])
    return "\n".join(f"- {pool}: `{name}` at {', '.join(own)}" for (pool, name), own in sizes.items())


def page(rows, arguments):
    measured = [row for row in rows if judged(row)]
    short = [row for row in measured if falls_short(row)]
    control = [row for row in rows if before(row) and int(row["n"]) in SIZES]
    modes = [row for row in rows if "no coverage claimed" in row["kind"] and int(row["n"]) in SIZES]
    rare = [row for row in rows if claimed(row) and int(row["n"]) in SIZES and 0.0 < number(row, "printed") < RARELY]
    about = ABOUT.format(nominal=arguments.trials, sparse=arguments.sparse_trials,
                         held_out=arguments.held_out_trials, setting=SPARSE,
                         samples=arguments.samples, covered=COVERED, widest=WIDEST, rarely=RARELY,
                         sizes=", ".join(map(str, SIZES)))
    result = (f"{len(measured) - len(short)} of {len(measured)} lines keep to both. " +
              ("These do not:\n\n" + table(short) if short else "None falls short."))
    return f"""# Coverage of the printed intervals

{about}
## What falls short

{result}

## The worst of each kind

{table(worst_of(measured))}

Widest of each kind:

{widest_of(measured)}

## Where a mean has no interval

In so many trials, in more than {1 - RARELY:.0%} of the samples:

{none_printed(rows)}

Printed in fewer than {RARELY:.0%} of the samples, and so chosen by what they say:

{table(rare)}

## What was printed before

The worst of each kind: Student's interval of means, Welch's of their difference, Wilson's of rates however
rare, Agresti and Min's of paired differences of rates.

{table(worst_of(control))}

## Modes

The half-sample mode is shown with a range by subsampling, for which no coverage is claimed, and is judged
nowhere:

{table(worst_of(modes))}

## What is not here

Tables of minimum, 5 % quantile, median, 95 % quantile and maximum are printed without intervals. Intervals of
crossings, attributions, layouts, confidence sequences and predictions are measured by tests
([list](../../src/statistics/README.md#what-the-intervals-are-tested-against)); those for all cells at once are
Clopper and Pearson's at Bonferroni's level, which cannot fall short. A pool is a finite law: what
it has never seen in {arguments.trials} trials no line here shows. Trials that share layouts are not
independent, and their means are too sure.
"""


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser, threads=True)
    parser.add_argument("--program", type=Path, required=True, help="the built coverage_study")
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs/coverage", help="pools")
    parser.add_argument("--results", type=Path, default=ROOT / "results/studies")
    parser.add_argument("--trials", type=int, default=20000, help="of the nominal pool")
    parser.add_argument("--sparse-trials", type=int, default=5000)
    parser.add_argument("--held-out-trials", type=int, default=3000)
    parser.add_argument("--samples", type=int, default=4000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()

    nominal, sparse = arguments.out / "nominal", arguments.out / "sparse"
    run_scenario(arguments, SCENARIO, nominal, [FIDELITY])
    few = argparse.Namespace(**vars(arguments) | {"trials": arguments.sparse_trials})
    run_scenario(few, SCENARIO, sparse, [FIDELITY, SPARSE])
    held_out = arguments.out / "dense"
    few.trials = arguments.held_out_trials
    run_scenario(few, HELD_OUT, held_out, [FIDELITY])

    rows = []
    for name, pools in (("nominal", [nominal]), ("sparse", [sparse]), ("between", [nominal, sparse]),
                        ("held out", [held_out])):
        told = study.run([arguments.program, arguments.samples, *(pool / "trials.csv" for pool in pools)])
        rows += [{"pool": name, **row} for row in csv.DictReader(told.splitlines())]
    study.write_csv(arguments.results / "coverage.csv", rows)
    (arguments.results / "coverage.md").write_text(page(rows, arguments), encoding="utf-8")


if __name__ == "__main__":
    main()
