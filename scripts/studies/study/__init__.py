"""What the studies share: the package of the build (`ry`), running a scenario with settings, tables, curves."""

import argparse
import csv
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from .drawing import write_svg  # noqa: F401
from .package import ROOT, ry

sys.path.append(str(ROOT / "scripts"))  # studies use the package `calibrations`
rates = ry.rates
ARRIVED = ("goal_reached", "false_goal")  # as the rover believes
NO_PATH = ("gave_up", "noticed_stuck", "patience_distance", "patience_turning", "patience_time")  # who ended the drive


def called(command, codes=(0,)):
    """Runs a command and returns what `subprocess.run` does; ends with its message where its exit code is none of these."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if result.returncode not in codes:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {result.returncode}\n{result.stderr}{result.stdout}")
    return result


def run(command):
    """What a command prints; ends with its message if it fails."""
    return called(command).stdout


def settings(values):
    """PATH=VALUE settings as words of a command."""
    return [part for setting in values for part in ("--set", setting)]


def argument_parser(text):
    """A parser whose help shows the text of the script as it stands."""
    return argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)


def add_program(parser, threads=False):
    parser.add_argument("--rockyard", type=Path, default=ROOT / "build/release/bin/rockyard")
    if threads:
        parser.add_argument("--threads", type=int, default=1)


def add_page(parser):
    parser.add_argument("--markdown", type=Path, metavar="PAGE", help="write the tables between the marks of this page")


def add_run_arguments(parser, trials, out, seed=1):
    add_program(parser, threads=True)
    if trials:
        parser.add_argument("--trials", type=int, default=trials, help=f"trials a point ({trials})")
    parser.add_argument("--seed", type=int, default=seed, help="seed of the trials")
    parser.add_argument("--out", type=Path, default=ROOT / "results/runs" / out)
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="held at every point, for example rover.fidelity=multibody")


def add_sweep_arguments(parser, name):
    """Arguments of a study that counts one sweep, which it makes or goes on with (run_sweep)."""
    add_program(parser, threads=True)
    add_page(parser)
    parser.add_argument("--sweep", type=Path, default=ROOT / "results/runs" / name,
                        help="folder of the sweep, made or gone on with")
    parser.add_argument("--out", type=Path, default=ROOT / "results/studies")
    parser.add_argument("--count-only", action="store_true", help="the sweep is there: count it")


def run_sweep(args, sweep, folder=None):
    """Runs the sweep into a folder, or goes on with what is there, unless it is only to be counted; the folder."""
    folder = folder or args.sweep
    if not args.count_only:
        command = [args.rockyard, "sweep", sweep, "--out", folder, "--threads", args.threads, "--quiet"]
        run(command + (["--resume", "--force"] if folder.exists() else []))
    return folder


def counted_sweep(args, sweep, axes):
    """The trials of a sweep, run before, as frames by their levels, and what is noted below its tables."""
    found = ry.Sweep(run_sweep(args, sweep))
    cells = cells_of(counted(found), axes)
    if not cells:
        sys.exit(f"{args.sweep}: holds no trial")
    return cells, f"\n\n{len(next(iter(cells.values())))} trials a cell; made by rockyard {program(found)}."


def counted(run_or_sweep):
    """The trials that are no faults as a frame; those of a sweep with their levels along its axes."""
    return run_or_sweep.trials[run_or_sweep.trials.outcome != "simulator_fault"]


def cells_of(trials, axes):
    """Frames of trials by their values of some columns, in the order in which these come."""
    cells = trials.groupby(list(axes) if len(axes) > 1 else axes[0], sort=False)
    return {key if isinstance(key, tuple) else (key,): cell for key, cell in cells}


def run_scenario(args, scenario, folder, values, existing=("--resume", "--force")):
    """Runs a scenario with PATH=VALUE settings into a folder, or goes on with a run that is there; that run.

    It is run by the command, as the runner of studies notes its calls.
    """
    options = {"--trials": args.trials, "--seed": args.seed, "--out": folder, "--threads": getattr(args, "threads", None)}
    run([args.rockyard, "run", scenario, "--quiet", *(existing if Path(folder).exists() else ()),
         *(part for option, value in options.items() if value is not None for part in (option, value)),
         *settings(values)])
    return ry.Run(folder)


def example_navigator(name, folder):
    """The library of a plugin of examples/navigators, built into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    library = folder / f"lib{name}.so"
    if not library.exists():  # one that is there may be in use
        run(["g++", "-std=c++20", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", ROOT / "src", "-I",
             "/usr/include/eigen3", ROOT / f"examples/navigators/{name}.cc", "-o", library])
    return library


def trials_of(rockyard, scenario, trials, seed, values):
    """The trials of a run that is not kept, as a frame without simulator faults."""
    with tempfile.TemporaryDirectory() as folder:
        args = argparse.Namespace(rockyard=rockyard, trials=trials, seed=seed)
        return counted(run_scenario(args, scenario, f"{folder}/run", values))


def compare(first, second):
    """What a comparison of two runs or their folders says.

    Success: difference in points with its interval and McNemar's p for "declared" and "true", rounded as
    `rockyard compare` prints them; means: rows by (trials, column), where trials are "all" or "arrived".
    """
    found = ry.compare(first, second).json["comparison"]
    success = {row["what"].split()[0]: (*(round(100.0 * row[key], 1) for key in ("difference", "low", "high")),
                                        float(f"{row['p']:.3g}")) for row in found["successes"]}
    return success, {(row["trials"], row["name"]): row for row in found["columns"]}


def nested(values, document):
    """The document with values by paths, as groups within groups."""
    for path, value in values.items():
        *groups, key = path.split(".")
        group = document
        for part in groups:
            group = group.setdefault(part, {})
        group[key] = value
    return document


def others(outcomes, *but, none="-"):
    """Outcomes with their counts, by name; `but`: what is left out."""
    return ", ".join(f"{name} {count}" for name, count in outcomes.items() if count and name not in but) or none


def ends(run, *but, none="-"):
    """Outcomes of a run with their counts, by name; those of no_path by who ended the drive; `but`: what is left out."""
    counts = dict(sorted(run.outcomes.items()))
    counts |= {f"no_path ({cause})": run.summary["causes"].get(cause, 0) for cause in NO_PATH if counts.get("no_path")}
    return others(counts, *but, "no_path", "simulator_fault", none=none)


def program(run_or_sweep):
    """Version and commit of the program that made a run or a sweep."""
    made = run_or_sweep.summary.get("provenance", {})
    return f"{made.get('version', '?')} {made.get('commit', '?')}"


def made_by(runs, joined=" and "):
    """The programs that made runs, in words."""
    return f"made by rockyard {joined.join(sorted({program(run) for run in runs}))}"


def with_interval(values, digits, scale=1.0):
    """ "value (low..high)" of a rate or a (value, low, high)."""
    values = tuple(values)
    if not all(map(math.isfinite, values)):
        return "-"
    # Without the sign of a zero that rounding leaves.
    value, low, high = (round(scale * value, digits) + 0.0 for value in values)
    return f"{value:.{digits}f} ({low:.{digits}f}..{high:.{digits}f})"


def table(header, rows, rule=" --- "):
    """Of Markdown; rows and header are lists of texts."""
    lines = ["| " + " | ".join(line) + " |" for line in (header, *rows)]
    return "\n".join([lines[0], "|" + "|".join([rule] * len(header)) + "|", *lines[1:]])


def listed(rows, columns, rule=" --- "):
    """A table of rows by what is shown of each: by head a format of its members, or a function of it."""
    return table(list(columns), [[shown(row) if callable(shown) else shown.format_map(row) for shown in columns.values()]
                                 for row in rows], rule)


def interval_of(row, name, digits, scale=1.0):
    """Of a row with NAME, NAME_low and NAME_high."""
    return with_interval([row[name], row[f"{name}_low"], row[f"{name}_high"]], digits, scale)


def read_csv(path):
    """Rows of a file, as dictionaries of text."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, rows):
    """Rows are dictionaries with equal keys."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_portable(path):
    """The pixels of a PGM or PFM file, rows from above."""
    magic, size, most, data = Path(path).read_bytes().split(b"\n", 3)
    columns, rows = (int(part) for part in size.split())
    if magic == b"P5":
        return np.frombuffer(data, np.uint8).reshape(rows, columns).astype(float)
    return np.frombuffer(data, "<f4" if float(most) < 0 else ">f4").reshape(rows, columns)[::-1].astype(float)


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


def show(args, tables, note=""):
    """Prints tables by name, and writes them between their marks on the page of the arguments, if that names one."""
    for name, text in tables.items():
        print(f"{name}\n\n{text}{note}\n", flush=True)
        if args.markdown:
            write_table([args.markdown], name, text + note)


def parse_with_tables(parser, tables):
    """Adds --tables and --markdown to the arguments and parses them; refuses names of no table."""
    parser.add_argument("--tables", default=",".join(tables), help="which, joined by commas")
    add_page(parser)
    args = parser.parse_args()
    for name in args.tables.split(","):
        if name not in tables:
            parser.error(f"{name} is no table; there are {', '.join(tables)}")
    return args


def held(args):
    """What was held at every point, in words for a note."""
    return f"held: {', '.join(args.set)}; " if args.set else ""


def print_tables(args, tables, make_runs):
    """Makes the tables asked for, each with what it was run with, and writes them to the page.

    `tables` are functions by name of what `make_runs(args)` gives, which knows its `programs`.
    """
    for name in args.tables.split(","):
        runs = make_runs(args)
        text = tables[name](runs)
        note = (f"\n\n{args.trials} trials each, seed {args.seed}; {held(args)}made by rockyard "
                f"{' and '.join(sorted(runs.programs))}.")
        show(args, {name: text}, note)
