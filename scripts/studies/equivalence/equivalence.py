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

A finished run in its folder is taken as it is, an interrupted one goes on, one of other settings is
refused. --markdown writes the tables between <!-- begin STUDY --> and <!-- end STUDY --> of a page.

Exit code: 0 all that has a margin is equivalent, 1 something is not, or cannot be told.

    scripts/studies/equivalence/equivalence.py [--studies step] [--trials 100] [--csv FILE] [--markdown PAGE]
"""

import json
import math
import re
import statistics
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

CONFIDENCE = 0.90
PATHFINDER = study.ROOT / "scenarios/pathfinder"
QUASI_STATIC = ["rover.fidelity=quasi_static"]
# Name and settings of the first and of the second way.
SIDES = {"step": (("60", []), ("480", ["rover.physics.step_s=0.0020833333333333333"])),
         "fidelity": (("multibody", []), ("quasi_static", QUASI_STATIC))}
# Cells by name: scenario, pairs, settings.
CELLS = {
    "step": {"nominal": ("nominal", 1000, []), "vl2": ("vl2", 2400, [])},
    "fidelity": {"nominal": ("nominal", 1000, []),
                 "obstacles_0.85": ("obstacles_0.85", 1000, []),
                 "k_0.006": ("nominal", 1000, ["terrain.rocks.k_per_m2=0.006"]),
                 "k_0.0085": ("nominal", 1000, ["terrain.rocks.k_per_m2=0.0085"]),
                 # Pointed rocks stand on level ground.
                 "slope_10": ("nominal", 1000, ["terrain.ground.slope_deg=10",
                                                "terrain.rocks.pointedness=0"])}}
# Folders that hold one and the same run.
SAME_RUN = [("step/nominal_60", "fidelity/nominal_multibody")]

RATES = {"declared success (%)": ("goal_reached", "false_goal"), "true success (%)": ("goal_reached",),
         "jams (%)": ("jammed", "high_centred")}
# Name: column, digits.
MEANS = {"true distance (m)": ("true_distance_m", 3),
         "distance error (%)": ("distance_error_percent", 2),
         "position error (m)": ("position_error_m", 3)}
RATIO = "true distance (% of the first)"
SUCCESS = {"declared success (%)": 5.0, "true success (%)": 5.0}
# Margins in the measure's unit, either way.
MARGINS = {("step", "nominal"): SUCCESS,
           ("step", "vl2"): {RATIO: 5.0, "jams (%)": 4.0},
           **{("fidelity", cell): SUCCESS for cell in CELLS["fidelity"]}}


def tango_score(only_first, only_second, pairs, delta):
    """Tango 1998, equations 5 and 6: z of a difference of rates `delta`, second less first."""
    up, down, n = only_second, only_first, pairs
    b = -up - down + (2.0 * n - up + down) * delta
    c = -down * delta * (1.0 - delta)
    likeliest_down = (math.sqrt(max(0.0, b * b - 8.0 * n * c)) - b) / (4.0 * n)
    variance = n * (2.0 * likeliest_down + delta * (1.0 - delta))
    distance = up - down - n * delta
    if variance > 0.0:
        return distance / math.sqrt(variance)
    return math.copysign(math.inf, distance) if distance else 0.0


def tango_interval(only_first, only_second, pairs, confidence=CONFIDENCE):
    """The differences of rates, second less first, that the score does not reject."""
    if pairs == 0:
        return -1.0, 1.0
    z = statistics.NormalDist().inv_cdf(0.5 + 0.5 * confidence)

    def end(target):
        # The score falls as the difference grows.
        low, high = -1.0, 1.0
        for _ in range(100):
            middle = 0.5 * (low + high)
            above = tango_score(only_first, only_second, pairs, middle) > target
            low, high = (middle, high) if above else (low, middle)
        return 0.5 * (low + high)
    return end(z), end(-z)


def student_quantile(probability, freedom):
    """Of Student's distribution; probability of one half or more."""
    low, high = 0.0, 1.0e9
    for _ in range(200):
        t = 0.5 * (low + high)
        below = 1.0 - 0.5 * study.beta_cdf(0.5 * freedom, 0.5, freedom / (freedom + t * t))
        low, high = (t, high) if below < probability else (low, t)
    return 0.5 * (low + high)


def half_width(values, confidence=CONFIDENCE):
    """Of Student's interval of their mean."""
    if len(values) < 2:
        return math.nan
    return (student_quantile(0.5 + 0.5 * confidence, len(values) - 1.0) *
            statistics.stdev(values) / math.sqrt(len(values)))


def verdict(values, margin):
    """Of (difference, low, high); `margin` is None or its size."""
    if margin is None:
        return "-"
    _, low, high = values
    if -margin < low and high < margin:
        return "equivalent"
    return "different" if low > margin or high < -margin else "cannot tell"


def rate_row(first, second, outcomes):
    """Rates of both and their difference with its interval, in per cent and points."""
    ended = [(a["outcome"] in outcomes, b["outcome"] in outcomes) for a, b in zip(first, second)]
    n, lost, gained = len(ended), ended.count((True, False)), ended.count((False, True))
    rate = lambda side: 100.0 * sum(pair[side] for pair in ended) / n
    low, high = tango_interval(lost, gained, n)
    return {"pairs": n, "first": rate(0), "second": rate(1), "difference": 100.0 * (gained - lost) / n,
            "low": 100.0 * low, "high": 100.0 * high, "only_first": lost, "only_second": gained}


def finite_pairs(first, second, column):
    found = [(a[column], b[column]) for a, b in zip(first, second)]
    return [pair for pair in found if all(math.isfinite(value) for value in pair)]


def mean_row(first, second, column):
    found = finite_pairs(first, second, column)
    differences = [b - a for a, b in found]
    middle, half = statistics.fmean(differences), half_width(differences)
    return {"pairs": len(found), "first": statistics.fmean(a for a, _ in found),
            "second": statistics.fmean(b for _, b in found), "difference": middle,
            "low": middle - half, "high": middle + half}


def ratio_row(first, second, column):
    """Of the means: first is 100 %, the difference what the second has more."""
    found = finite_pairs(first, second, column)
    base = statistics.fmean(a for a, _ in found)
    ratio = statistics.fmean(b for _, b in found) / base
    half = 100.0 * half_width([b - ratio * a for a, b in found]) / base
    more = 100.0 * (ratio - 1.0)
    return {"pairs": len(found), "first": 100.0, "second": 100.0 * ratio, "difference": more,
            "low": more - half, "high": more + half}


def cell_rows(name, cell, first, second):
    """One row a measure, from the trials of both ways, pair by pair."""
    rows = [(measure, 1, rate_row(first, second, outcomes)) for measure, outcomes in RATES.items()]
    rows += [(measure, digits, mean_row(first, second, column))
             for measure, (column, digits) in MEANS.items()]
    rows.append((RATIO, 1, ratio_row(first, second, "true_distance_m")))
    found = []
    for measure, digits, values in rows:
        margin = MARGINS[name, cell].get(measure)
        interval = [values[key] for key in ("difference", "low", "high")]
        found.append({"study": name, "cell": cell, "measure": measure, "only_first": "",
                      "only_second": "", **values, "margin": "" if margin is None else margin,
                      "verdict": verdict(interval, margin), "digits": digits})
    return found


def trials_of(folder, trials):
    """The first trials of a run by number, simulator faults left out."""
    columns = study.trial_columns(folder)
    rows = [dict(zip(columns, values)) for values in zip(*columns.values())]
    return {int(row["trial"]): row for row in rows if row["trial"] < trials}


def paired(folders, trials):
    """Trials of the first and of the second run that both have."""
    first, second = (trials_of(folder, trials) for folder in folders)
    both = sorted(first.keys() & second.keys())
    if not both:
        sys.exit(f"{folders[0]}, {folders[1]}: no trial ended in both runs")
    return [first[trial] for trial in both], [second[trial] for trial in both]


def choose_folder(out, name):
    """The folder of a run: where several may hold it, the first one that is there."""
    names = next((names for names in SAME_RUN if name in names), (name,))
    return next((out / each for each in names if (out / each).exists()), out / names[0])


def fingerprint(args, scenario, settings):
    """Of the scenario with its settings and seed; the number of trials does not count."""
    changes = [part for setting in [f"seed={args.seed}", *settings] for part in ("--set", setting)]
    text = study.run([args.rockyard, "validate", scenario, *changes])
    found = re.search(r"fingerprint (\w+)", text)
    return found[1] if found else sys.exit(f"{args.rockyard} validate gave no fingerprint: {text}")


def described(scenario, seed, settings):
    return f"{scenario}, seed {seed}, {', '.join(settings) or 'nothing set'}"


def drive(args, name, scenario, trials, settings):
    """Folder and summary of a run, which is made unless it is there."""
    folder = choose_folder(args.out, name)
    wanted, path = fingerprint(args, scenario, settings), folder / "summary.json"
    told, how = described(scenario.stem, args.seed, settings), "run"
    if path.is_file():
        summary = json.loads(path.read_text(encoding="utf-8"))
        if summary.get("fingerprint") != wanted:
            there = described(summary.get("scenario", "?"), summary.get("seed", "?"),
                              summary.get("settings", []))
            sys.exit(f"{folder} holds another run: {there}; fingerprint {summary.get('fingerprint')}, "
                     f"by rockyard {study.program(summary)}.\nWanted: {told}; fingerprint {wanted}, by "
                     f"{args.rockyard}.\nChoose another --out, or move that folder away.")
        how = "taken" if summary["trials"]["stored"] >= trials else "extended"
    print(f"{name}: {trials} trials, {told}: {how} ({folder})", file=sys.stderr, flush=True)
    if how != "taken":
        changes = [part for setting in settings for part in ("--set", setting)]
        study.run([args.rockyard, "run", scenario, "--trials", trials, "--seed", args.seed,
                   "--threads", args.threads, "--quiet", "--resume", *changes, "--out", folder])
        summary = json.loads(path.read_text(encoding="utf-8"))
    return folder, summary


def measure(args, name):
    """Rows of a study, and the programs that made its runs."""
    rows, programs = [], set()
    for cell, (scenario, pairs, changes) in CELLS[name].items():
        folders, trials = [], min(args.trials, pairs)
        for side, settings in SIDES[name]:
            folder, summary = drive(args, f"{name}/{cell}_{side}", PATHFINDER / f"{scenario}.json",
                                    trials, [*args.set, *changes, *settings])
            folders.append(folder)
            programs.add(study.program(summary))
        first, second = paired(folders, trials)
        rows += cell_rows(name, cell, first, second)
        if len(first) < trials:
            print(f"{name}/{cell}: {trials - len(first)} of {trials} pairs left out for simulator "
                  "faults", file=sys.stderr)
    return rows, programs


def text_of(args, name, rows, programs):
    (first, _), (second, _) = SIDES[name]

    def line(row):
        digits = row["digits"]
        size = f"{row['margin']:g}" if row["margin"] else "-"
        change = study.with_interval([row[key] for key in ("difference", "low", "high")], digits)
        return [row["cell"], row["measure"], str(row["pairs"]), f"{row['first']:.{digits}f}",
                f"{row['second']:.{digits}f}", change, size, row["verdict"]]
    made = " and ".join(sorted(programs)) + (": not one program" if len(programs) > 1 else "")
    held = f"held: {', '.join(args.set)}; " if args.set else ""
    return study.table(
        ["cell", "measure", "pairs", first, second, "second less first (90 %)", "margin", "verdict"],
        [line(row) for row in rows]) + f"\n\nSeed {args.seed}; {held}made by rockyard {made}."


def write_rows(path, rows, studies):
    """Rows of other studies that the file has stay."""
    kept = []
    if path.is_file():
        kept = [row for row in study.read_csv(path) if row["study"] not in studies]
    rows = kept + [{key: value for key, value in row.items() if key != "digits"} for row in rows]
    path.parent.mkdir(parents=True, exist_ok=True)
    study.write_csv(path, sorted(rows, key=lambda row: list(CELLS).index(row["study"])))


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--studies", nargs="+", choices=list(CELLS), default=list(CELLS))
    study.add_run_arguments(parser, trials=max(pairs for cells in CELLS.values() for _, pairs, _ in cells.values()),
                            out="equivalence")
    parser.add_argument("--csv", type=Path, metavar="FILE", help="write the rows to this file")
    parser.add_argument("--markdown", type=Path, metavar="PAGE",
                        help="write the tables between the marks of this page")
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
        text = text_of(args, name, rows, programs)
        study.show(args, name, text)
        if args.csv:
            write_rows(args.csv, rows, [name])
    return int(any(row["verdict"] in ("different", "cannot tell") for row in found))


if __name__ == "__main__":
    sys.exit(main())
