"""What the studies share: running a scenario with settings, tables, intervals, curves."""

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
Z95 = 1.959963984540054  # two-sided 95 % of a normal distribution


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


def trial_columns(folder):
    """The columns of trials.csv as lists, simulator faults left out; outcomes as text."""
    with open(Path(folder) / "trials.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["outcome"] != "simulator_fault"]
    columns = {name: [row[name] for row in rows] for name in (rows[0] if rows else {})}
    return {name: values if name in ("outcome", "detail") else [float(value) for value in values]
            for name, values in columns.items()}


def mean_interval(values):
    """Mean and its 95 % interval by the normal approximation."""
    n = len(values)
    mean = sum(values) / n
    variance = sum((value - mean) ** 2 for value in values) / (n - 1) if n > 1 else 0.0
    half = Z95 * math.sqrt(variance / n)
    return mean, mean - half, mean + half


def ratio_interval(parts, wholes):
    """sum(parts) / sum(wholes) over trials, with its 95 % interval by the delta method.

    Trials are independent, what happens within one is not: so they are what is resampled in spirit.
    Without any part the upper end is that of no event in as many wholes (rule of three).
    """
    n, whole = len(wholes), sum(wholes)
    if whole == 0:
        return math.nan, math.nan, math.nan
    ratio = sum(parts) / whole
    if sum(parts) == 0:
        return 0.0, 0.0, min(1.0, 3.0 / whole)
    square = sum((part - ratio * w) ** 2 for part, w in zip(parts, wholes))
    half = Z95 * math.sqrt(square * n / max(1, n - 1)) / whole
    return ratio, max(0.0, ratio - half), min(1.0, ratio + half)


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
