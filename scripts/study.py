"""What the studies share: running a scenario with settings, tables, intervals, curves."""

import csv
import json
import math
import re
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
Z95 = 1.959963984540054  # two-sided 95 % of a normal distribution


class Progress:
    """Says on standard error, twice a minute, how much of a long study is done and what it has found."""
    EVERY_S = 30.0

    def __init__(self, what, total):
        self.what, self.total = what, total
        self.start = self.told = time.monotonic()

    def at(self, done, found):
        now = time.monotonic()
        if now - self.told < self.EVERY_S or done == 0:
            return
        self.told = now
        left_min = (now - self.start) * (self.total - done) / done / 60
        print(f"{self.what}: {done} of {self.total}, {found} found, about {left_min:.0f} min left",
              file=sys.stderr, flush=True)


def run(command):
    """Runs a command; ends with its message if it fails."""
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                            check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nexit code {result.returncode}\n"
                 f"{result.stderr}{result.stdout}")
    return result.stdout


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
    with open(path, encoding="utf-8", newline="") as file:
        means = {(row["trials"], row["column"]): row for row in csv.DictReader(file)}
    return success, means


# Columns of trials.csv that hold words (report/run_csv.cc).
TEXT_COLUMNS = ("outcome", "cause", "detail")


def trial_columns(folder):
    """The columns of trials.csv as lists, simulator faults left out.

    Those of TEXT_COLUMNS are text; a number that is undefined is NaN.
    """
    with open(Path(folder) / "trials.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"] != "simulator_fault"]
    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else {})}
    return {name: values if name in TEXT_COLUMNS else [float(value or "nan") for value in values]
            for name, values in columns.items()}


def mean_interval(values):
    """Mean and its 95 % interval by the normal approximation; not below zero where no value is."""
    n = len(values)
    mean = sum(values) / n
    variance = sum((value - mean) ** 2 for value in values) / (n - 1) if n > 1 else 0.0
    half = Z95 * math.sqrt(variance / n)
    return mean, max(mean - half, 0.0 if min(values) >= 0.0 else -math.inf), mean + half


def signed_mean_interval(values):
    """Mean of values of either sign and its 95 % interval by the normal approximation."""
    n = len(values)
    mean = sum(values) / n if n else math.nan
    variance = sum((value - mean) ** 2 for value in values) / (n - 1) if n > 1 else math.nan
    half = Z95 * math.sqrt(variance / n) if n > 1 else math.nan
    return mean, mean - half, mean + half


def _beta_fraction(a, b, x):
    """Continued fraction of the incomplete beta function by Lentz (Press et al. 2007, 6.4.5)."""
    tiny = 1e-300
    c, d = 1.0, 1.0 / ((1.0 - (a + b) * x / (a + 1.0)) or tiny)
    value = d
    for m in range(1, 10000):
        for term in (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                     -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))):
            d = 1.0 / ((1.0 + term * d) or tiny)
            c = (1.0 + term / c) or tiny
            value *= c * d
        if abs(c * d - 1.0) < 1e-14:
            break
    return value


def beta_cdf(a, b, x):
    """Regularized incomplete beta function I_x(a, b)."""
    if x <= 0.0 or x >= 1.0:
        return float(x >= 1.0)
    front = math.exp(math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) +
                     b * math.log1p(-x))
    if x < (a + 1.0) / (a + b + 2.0):
        return front * _beta_fraction(a, b, x) / a
    return 1.0 - front * _beta_fraction(b, a, 1.0 - x) / b


def exact_interval(count, trials):
    """Clopper's and Pearson's 95 % interval (1934); counts need not be whole."""
    def quantile(a, b, probability):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if beta_cdf(a, b, middle) < probability else (low, middle)
        return 0.5 * (low + high)
    return (quantile(count, trials - count + 1.0, 0.025) if count > 0 else 0.0,
            quantile(count + 1.0, trials - count, 0.975) if count < trials else 1.0)


def wilson_interval(count, trials):
    """Wilson's 95 % interval of a share (1927)."""
    share, square = count / trials, Z95 ** 2 / trials
    middle = share + 0.5 * square
    half = math.sqrt(square * (share * (1.0 - share) + 0.25 * square))
    # Exact at the ends, where rounding is not.
    low = (middle - half) / (1.0 + square) if count > 0 else 0.0
    high = (middle + half) / (1.0 + square) if count < trials else 1.0
    return low, high


def ratio_interval(parts, wholes):
    """sum(parts) / sum(wholes) over trials, parts no larger than wholes, with its 95 % interval.

    Trials are independent, what happens within one is not: the exact interval of both sums divided
    by the design effect (Korn and Graubard 1998), the variance by trials over the binomial one, at
    least 1. From few events it is uncertain, from none it cannot be seen and is 1.
    """
    n, whole = len(wholes), sum(wholes)
    if whole == 0:
        return math.nan, math.nan, math.nan
    ratio = sum(parts) / whole
    binomial = whole * ratio * (1.0 - ratio)
    square = sum((part - ratio * w) ** 2 for part, w in zip(parts, wholes)) * n / max(1, n - 1)
    effect = max(1.0, square / binomial) if binomial > 0 else 1.0
    return (ratio, *exact_interval(sum(parts) / effect, whole / effect))


def mcnemar(only_first, only_second):
    """Two-sided exact p-value of paired trials: those that only the first or the second won."""
    n, fewer = only_first + only_second, min(only_first, only_second)
    return min(1.0, 2.0 * sum(math.comb(n, k) for k in range(fewer + 1)) / 2 ** n)


def holm(p_values):
    """p-values adjusted for all of them together (Holm 1979)."""
    adjusted, largest = [1.0] * len(p_values), 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=lambda i: p_values[i])):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        adjusted[index] = largest
    return adjusted


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
        print(f"{name}\n\n{text}\n", flush=True)
        if args.markdown:
            write_table([args.markdown], name, text)


COLOURS = ("#1b6ca8", "#c0392b", "#2e8b57", "#8e5ea2")
PANEL_W, PANEL_H, MARGIN = 300, 190, 55


def _panel(title, series, x_label, left, top):
    """One diagram: series of (name, [(x, value, low, high)])."""
    points = [point for _, values in series for point in values if not math.isnan(point[1])]
    x0, x1 = min(p[0] for p in points), max(p[0] for p in points)
    y1 = max(p[3] for p in points) or 1.0
    place = lambda x, y: (left + (x - x0) / ((x1 - x0) or 1.0) * PANEL_W,
                          top + PANEL_H - y / y1 * PANEL_H)
    parts = [f'<rect x="{left}" y="{top}" width="{PANEL_W}" height="{PANEL_H}" fill="none" '
             'stroke="#888"/>',
             f'<text x="{left}" y="{top - 8}">{title}</text>',
             f'<text x="{left + PANEL_W / 2:.0f}" y="{top + PANEL_H + 32}" '
             f'text-anchor="middle">{x_label}</text>']
    for share in (0.0, 0.5, 1.0):
        parts.append(f'<text x="{left - 6}" y="{top + PANEL_H * (1 - share) + 4:.0f}" '
                     f'text-anchor="end">{share * y1:.3g}</text>')
        parts.append(f'<text x="{left + share * PANEL_W:.0f}" y="{top + PANEL_H + 16}" '
                     f'text-anchor="middle">{x0 + share * (x1 - x0):.3g}</text>')
    for index, (name, values) in enumerate(series):
        colour = COLOURS[index % len(COLOURS)]
        good = [value for value in values if not math.isnan(value[1])]
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y, _, _ in good)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
        for x, _, low, high in good:
            (px, bottom), (_, above) = place(x, max(0.0, low)), place(x, high)
            parts.append(f'<line x1="{px:.1f}" x2="{px:.1f}" y1="{bottom:.1f}" y2="{above:.1f}" '
                         f'stroke="{colour}"/>')
        above_frame = top - 8 - 15 * (len(series) - 1 - index)
        parts.append(f'<text x="{left + PANEL_W}" y="{above_frame}" '
                     f'text-anchor="end" fill="{colour}">{name}</text>')
    return parts


def write_svg(path, panels, x_label):
    """Diagrams two beside each other, with 95 % intervals: panels of (title, series)."""
    rows = (len(panels) + 1) // 2
    width, height = 2 * (PANEL_W + 2 * MARGIN), rows * (PANEL_H + 2 * MARGIN)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
             'font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for index, (title, series) in enumerate(panels):
        parts += _panel(title, series, x_label, MARGIN + (index % 2) * (PANEL_W + 2 * MARGIN),
                        MARGIN + (index // 2) * (PANEL_H + 2 * MARGIN))
    Path(path).write_text("\n".join([*parts, "</svg>"]) + "\n", encoding="utf-8")
