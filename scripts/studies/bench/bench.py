#!/usr/bin/env python3
"""Navigators of three decades and of the examples on the benchmark's suite: the table of results/bench.md.

Runs every manifest of examples/bench, and the plugins of examples/navigators, by `rockyard bench run`; then
`rockyard bench report` with the first as the baseline. Writes bench.csv, bench_cells.csv, bench_ends.csv,
bench.svg and the tables of the page.

    scripts/studies/bench/bench.py [--layouts 40] [--threads 2] [--only gestalt behaviour]
"""

import json
import subprocess
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

MANIFESTS = study.ROOT / "examples/bench"
NAVIGATORS = study.ROOT / "examples/navigators"
PLUGINS = ("a_star", "arc_planner", "bug2", "potential_field")
BASELINE = "gestalt"
CELL_W, CELL_H, LABEL_W, TOP = 11, 18, 130, 150


def plugin_entry(name, out):
    """A folder with the library of an example and its manifest."""
    folder = out / "entries" / name
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["g++", "-std=c++20", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", study.ROOT / "src",
                    "-I", "/usr/include/eigen3", NAVIGATORS / f"{name}.cc", "-o", folder / f"lib{name}.so"], check=True)
    manifest = {"name": name, "navigator": name, "plugin": f"lib{name}.so",
                "about": "An example of a plugin.", "authors": "rockyard"}
    (folder / "entry.json").write_text(json.dumps(manifest, indent=2) + "\n", encoding="utf-8")
    return folder


def drive(args, name, manifest):
    print(name, file=sys.stderr)
    folder = args.out / name
    study.run([args.rockyard, "bench", "run", manifest, "--out", folder, "--threads", args.threads, "--quiet",
               *(["--layouts", args.layouts] if args.layouts else []),
               *(["--resume", "--force"] if folder.exists() else [])])
    study.run([args.rockyard, "bench", "verify", folder, "--sample", 40, "--seed", 1, "--threads", args.threads])
    return folder


def heat_map(rows, path):
    """Shares of arrivals by entry and cell, dark where none arrives."""
    entries = list(dict.fromkeys(row["entry"] for row in rows))
    cells = list(dict.fromkeys(row["cell"] for row in rows))
    share = {(row["entry"], row["cell"]): float(row["arrived"]) for row in rows}
    width, height = LABEL_W + CELL_W * len(cells) + 20, TOP + CELL_H * len(entries) + 10
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="9">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for column, cell in enumerate(cells):
        x = LABEL_W + CELL_W * (column + 0.7)
        parts.append(f'<text transform="translate({x:.1f} {TOP - 5}) rotate(-60)">{cell}</text>')
    for line, entry in enumerate(entries):
        y = TOP + CELL_H * line
        parts.append(f'<text x="{LABEL_W - 5}" y="{y + 12}" text-anchor="end">{entry}</text>')
        for column, cell in enumerate(cells):
            value = share[entry, cell]
            red, green, blue = (round(low + value * (high - low)) for low, high in ((60, 255), (20, 250), (90, 225)))
            parts.append(f'<rect x="{LABEL_W + CELL_W * column}" y="{y}" width="{CELL_W - 1}" height="{CELL_H - 1}" '
                         f'fill="rgb({red},{green},{blue})"><title>{entry}, {cell}: {100 * value:.0f} %</title></rect>')
    path.write_text("\n".join([*parts, "</svg>"]) + "\n", encoding="utf-8")


def ends_table(rows):
    """How drives end, and arrivals by patience, in percent."""
    shown = [end for end in dict.fromkeys(row["end"] for row in rows)
             if any(float(row["share"]) >= 0.005 for row in rows if row["end"] == end)]
    entries = list(dict.fromkeys(row["entry"] for row in rows))
    share = {(row["entry"], row["end"]): 100.0 * float(row["share"]) for row in rows}
    return study.table(["entry", *(end.replace("_", " ") for end in shown)],
                       [[entry, *(f"{share[entry, end]:.1f}" for end in shown)] for entry in entries])


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser, threads=True)
    study.add_page(parser)
    parser.add_argument("--layouts", type=int, help="of each cell (all)")
    parser.add_argument("--only", nargs="*", help="entries")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/runs/bench")
    args = parser.parse_args()
    entries = {path.stem: path for path in sorted(MANIFESTS.glob("*.json"))}
    entries = {BASELINE: entries.pop(BASELINE)} | entries
    wanted = lambda name: not args.only or name in args.only
    entries |= {name: plugin_entry(name, args.out) for name in PLUGINS if wanted(name)}
    folders = [drive(args, name, manifest) for name, manifest in entries.items() if wanted(name)]
    table = args.out / "table"
    study.run([args.rockyard, "bench", "report", *folders, "--out", table, "--force"])
    for name, to in (("standings", "bench"), ("cells", "bench_cells"), ("ends", "bench_ends")):
        (args.out / f"{to}.csv").write_bytes((table / f"{name}.csv").read_bytes())
    heat_map(study.read_csv(table / "cells.csv"), args.out / "bench.svg")
    standings, groups = (table / "bench.md").read_text(encoding="utf-8").split("\n\n")
    tables = {"standings": standings, "groups": groups.strip(), "ends": ends_table(study.read_csv(table / "ends.csv"))}
    study.show(args, tables)


if __name__ == "__main__":
    main()
