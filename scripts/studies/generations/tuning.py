#!/usr/bin/env python3
"""The same tuning budget for every navigator of the study of generations, on seeds for development.

Eight parameters of each that its paper leaves open (brains.py) are drawn within the ranges that `rockyard parameters`
states: 12 configurations and the one as assumed drive the same layouts; the best four and the one as assumed drive others,
and the best there by true arrivals is taken. Six cells: level and 10 degrees up, three rock abundances, the rover's own
localization. Writes generations_tuned.json, which generations.py drives on a seed that nothing here has seen, and
generations_tuning.csv with every configuration.

    scripts/studies/generations/tuning.py [--only gestalt enav] [--threads 2]
"""

import csv
import io
import json
import sys
from pathlib import Path

import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from generations import brains  # noqa: E402

DRAWS, FINALISTS = 12, 4
CELLS = brains.ground_axes(("level", "10 deg up"), (0.002, 0.0055, 0.009))
FIRST, SECOND = (1995, 8), (2012, 20)  # seed and layouts of a cell


def ranges(args, name, levers):
    """Rows of `rockyard parameters` for the parameters to be drawn."""
    brain = brains.BRAINS[name]
    plugin = ["--plugin", study.example_navigator(brain.plugin, args.out / "plugins")] if brain.plugin else []
    told = study.run([args.rockyard, "parameters", brains.BASE, "--csv", *plugin])
    rows = {row["path"]: row for row in csv.DictReader(io.StringIO(told))}
    return [rows[lever] for lever in levers]


def drawn(row, share):
    """The value of a parameter at a share of its range, or of its choices."""
    if row["kind"] in ("choice", "boolean"):
        choices = row["choices"].split("|") if row["kind"] == "choice" else [False, True]
        return choices[min(int(share * len(choices)), len(choices) - 1)]
    value = float(row["study_low"]) + share * (float(row["study_high"]) - float(row["study_low"]))
    return round(value) if row["kind"] == "integer" else float(f"{value:.3g}")


def configurations(rows, draws, seed):
    """As assumed, then draws that fill each range evenly (a Latin hypercube)."""
    rng = np.random.default_rng(seed)
    shares = np.stack([(rng.permutation(draws) + rng.random(draws)) / draws for _ in rows], axis=1)
    return [{}] + [{row["path"]: drawn(row, share) for row, share in zip(rows, line)} for line in shares]


def tried(args, name, stage, configs, seed, layouts):
    """Mean true arrivals of configurations by their numbers."""
    axis = {"name": "configuration", "levels": [{"name": str(number), "set": values} for number, values in configs.items()]}
    asked = type(args)(**vars(args) | {"seed": seed, "layouts": layouts})
    trials, program = brains.swept(asked, name, args.out / stage / brains.file_of(name), [axis, *CELLS], {})
    return {int(key[0]): brains.by_layout(cell).mean() for key, cell in study.cells_of(trials, ("configuration",)).items()}, program


def tune(args, name):
    """The rows of all configurations of a navigator, and the one that is taken."""
    rows = ranges(args, name, brains.BRAINS[name].levers)
    configs = dict(enumerate(configurations(rows, DRAWS, FIRST[0])))
    first, program = tried(args, name, "first", configs, *FIRST)
    best = sorted((number for number in configs if number), key=lambda number: -first[number])[:FINALISTS]
    second, _ = tried(args, name, "second", {number: configs[number] for number in (0, *best)}, *SECOND)
    taken = max(second, key=lambda number: (second[number], -number))
    shown = [{"navigator": name, "configuration": number, "first": f"{first[number]:.4f}",
              "second": f"{second[number]:.4f}" if number in second else "", "taken": "yes" if number == taken else "",
              "values": json.dumps({path.split(".", 2)[2]: value for path, value in values.items()}), "program": program}
             for number, values in configs.items()]
    return shown, configs[taken]


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser, threads=True)
    names = [name for name, brain in brains.BRAINS.items() if brain.levers]
    parser.add_argument("--only", nargs="+", choices=names, default=names, metavar="NAVIGATOR")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/runs/generations_tuning")
    args = parser.parse_args()
    rows, taken = [], {}
    for name in args.only:
        shown, values = tune(args, name)
        rows += shown
        taken[name] = values
        study.write_csv(args.out / "generations_tuning.csv", rows)
        (args.out / "generations_tuned.json").write_text(json.dumps(taken, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
