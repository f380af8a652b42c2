"""What the studies share: running a scenario with settings, tables, intervals, curves."""

import argparse
import csv
import json
import math
import re
import sqlite3
import subprocess
import sys
from pathlib import Path

from .drawing import write_svg  # noqa: F401
from .intervals import (Z95, beta_cdf, exact_interval, holm, mcnemar, mean_interval, quantile,  # noqa: F401
                        ratio_interval, signed_mean_interval, wilson_interval)

ROOT = Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "scripts"))  # studies use the package `calibrations`


def run(command):
    """Runs a command; ends with its message if it fails."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                            check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {result.returncode}\n"
                 f"{result.stderr}{result.stdout}")
    return result.stdout


def argument_parser(text):
    """A parser whose help shows the text of the script as it stands."""
    return argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)


def add_run_arguments(parser, trials, out):
    parser.add_argument("--trials", type=int, default=trials, help=f"trials a point ({trials})")
    parser.add_argument("--seed", type=int, default=1, help="seed of the trials")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs" / out)
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="held at every point, for example rover.fidelity=multibody")
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")


def add_sweep_arguments(parser, name, markdown_help):
    """Arguments of a study that counts one sweep, which it makes or goes on with (run_sweep)."""
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--sweep", type=Path, default=ROOT / "results/runs" / name,
                        help="folder of the sweep, made or gone on with")
    parser.add_argument("--out", type=Path, default=ROOT / "results/studies")
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    parser.add_argument("--markdown", type=Path, metavar="PAGE", help=markdown_help)
    parser.add_argument("--count-only", action="store_true", help="the sweep is there: count it")


def run_sweep(args, sweep):
    """Runs the sweep into its folder, or goes on with what is there, unless it is only to be counted."""
    if args.count_only:
        return
    command = [args.rockyard, "sweep", sweep, "--out", args.sweep, "--threads", args.threads, "--quiet"]
    run(command + (["--resume", "--force"] if args.sweep.exists() else []))


def counted_sweep(args, sweep, read_cells):
    """Cells that `read_cells` finds in the sweep, run before, and what is noted below its tables."""
    run_sweep(args, sweep)
    cells = read_cells(args.sweep)
    if not cells:
        sys.exit(f"{args.sweep}: holds no trial")
    made = program(json.loads((args.sweep / "summary.json").read_text(encoding="utf-8")))
    return cells, f"\n\n{len(next(iter(cells.values())))} trials a cell; made by rockyard {made}."


def stored_trials(folder, columns):
    """The trials of a sweep that are no faults: levels by axis, number, and a row of these columns and the outcome."""
    path = Path(folder).resolve() / "results.sqlite"
    store = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
    names = dict(store.execute("select cell, name from cells"))
    wanted = ", ".join(f'"{name}"' for name in columns)
    for cell, trial, outcome, *values in store.execute(
            f"select campaign_cell, trial, outcome, {wanted} from trials "
            "where outcome != 'simulator_fault' order by campaign_cell, trial"):
        levels = dict(part.split("=", 1) for part in names[cell].split(","))
        row = {name: math.nan if value is None else float(value) for name, value in zip(columns, values)}
        yield levels, trial, row | {"outcome": outcome}


def run_scenario(args, scenario, folder, settings):
    """Runs a scenario with PATH=VALUE settings into a folder, or goes on with a run that is there."""
    command = [args.rockyard, "run", scenario, "--trials", args.trials, "--seed", args.seed,
               "--out", folder, "--quiet"]
    command += [part for setting in settings for part in ("--set", setting)]
    if getattr(args, "threads", None):
        command += ["--threads", args.threads]
    if Path(folder).exists():
        command += ["--resume", "--force"]
    run(command)
    return json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))


def value_at(rockyard, scenario, path):
    """The effective value of a parameter in a scenario."""
    rows = csv.DictReader(run([rockyard, "parameters", scenario, "--csv"]).splitlines())
    return next(float(row["value"]) for row in rows if row["path"] == path)


def compare(rockyard, first, second):
    """What `rockyard compare` says of two run folders.

    Success: difference in points with its interval, McNemar's p, for "declared" and "true"; means: rows
    of its CSV by (trials, column), where trials are "all" or "arrived".
    """
    path = Path(second) / "compared.csv"
    text = run([rockyard, "compare", first, second, "--csv", path])
    number = r"([+-][\d.]+)"
    found = re.findall(rf"B - A {number} points \(95 % interval {number} .. {number}\)\n"
                       r".*?p = (\S+)", text)
    success = {kind: tuple(float(part) for part in parts)
               for kind, parts in zip(("declared", "true"), found)}
    return success, {(row["trials"], row["column"]): row for row in read_csv(path)}


# Columns of trials.csv that hold words (report/run_files.cc).
TEXT_COLUMNS = ("outcome", "cause", "detail")


def trial_columns(folder):
    """The columns of trials.csv as lists, simulator faults left out.

    Those of TEXT_COLUMNS are text; a number that is undefined is NaN.
    """
    rows = [row for row in read_csv(Path(folder) / "trials.csv") if row["outcome"] != "simulator_fault"]
    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else {})}
    return {name: values if name in TEXT_COLUMNS else [float(value or "nan") for value in values]
            for name, values in columns.items()}


def trial_rows(folder):
    """The same numbers as a dictionary for each trial."""
    numbers = {name: values for name, values in trial_columns(folder).items() if name not in TEXT_COLUMNS}
    return [dict(zip(numbers, values)) for values in zip(*numbers.values())]


def failures(summary):
    """Outcomes that are no arrival, with their counts."""
    outcomes = {name: count for name, count in summary["outcomes"].items()
                if count and name not in ("goal_reached", "false_goal")}
    return ", ".join(f"{name} {count}" for name, count in outcomes.items()) or "-"


def program(summary):
    """Version and commit of the program that made a run."""
    made = summary.get("provenance", {})
    return f"{made.get('version', '?')} {made.get('commit', '?')}"


def with_interval(values, digits, scale=1.0):
    """ "value (low..high)" of a (value, low, high)."""
    if any(math.isnan(value) for value in values):
        return "-"
    # Without the sign of a zero that rounding leaves.
    value, low, high = (round(scale * value, digits) + 0.0 for value in values)
    return f"{value:.{digits}f} ({low:.{digits}f}..{high:.{digits}f})"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def read_csv(path):
    """Rows of a file, as dictionaries of text."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, rows):
    """Rows are dictionaries with equal keys."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def write_table(pages, name, content):
    """Replaces what stands between the marks of the table, on every page that has them."""
    pattern = rf"(<!-- begin {name} -->\n).*?(\n<!-- end {name} -->)"
    found = False
    for page in pages:
        text, count = re.subn(pattern, lambda match: match[1] + content + match[2],
                              page.read_text(encoding="utf-8"), flags=re.DOTALL)
        if count:
            page.write_text(text, encoding="utf-8")
            found = True
    if not found:
        sys.exit(f"no page has a table {name}")


def show(args, name, text):
    """Prints a table, and writes it between its marks on the page of the arguments, if that names one."""
    print(f"{name}\n\n{text}\n", flush=True)
    if args.markdown:
        write_table([args.markdown], name, text)


def parse_with_tables(parser, tables):
    """Adds --tables and --markdown to the arguments and parses them; refuses names of no table."""
    parser.add_argument("--tables", default=",".join(tables), help="which, joined by commas")
    parser.add_argument("--markdown", type=Path, metavar="PAGE",
                        help="write the tables between the marks of this page")
    args = parser.parse_args()
    for name in args.tables.split(","):
        if name not in tables:
            parser.error(f"{name} is no table; there are {', '.join(tables)}")
    return args


def print_tables(args, tables, make_runs, note=""):
    """Makes the tables asked for, each with what it was run with, and writes them to the page.

    `tables` are functions by name of what `make_runs(args)` gives, which knows its `programs`.
    """
    for name in args.tables.split(","):
        runs = make_runs(args)
        text = tables[name](runs)
        held = f"held: {', '.join(args.set)}; " if args.set else ""
        text += (f"\n\n{args.trials} trials each, seed {args.seed}; {note}{held}made by rockyard "
                 f"{' and '.join(sorted(runs.programs))}.")
        show(args, name, text)
