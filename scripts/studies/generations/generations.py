#!/usr/bin/env python3
"""What each generation of navigators brought: all of them on one rover, over rock abundance and slope.

Navigators drive as tuned on seeds for development (generations_tuned.json, by tuning.py) on a seed that nothing has seen:
four abundances by four slopes, by what they know of where they are. Layouts are the units; a score is the mean of true
arrivals over the 16 cells, intervals are Student's over layouts, differences are in pairs. Prints the tables
  generations_standing   arrivals, safety, time, energy, checks, with the rover's own localization
  generations_knowing    the same navigators by localization and sensor
  generations_ground     arrivals by abundance and slope
  generations_steps      from each generation's sensor, localization and planner to the next, one at a time
  generations_tuning     what tuning brought, and how far configurations spread
  generations_envelope   ENav over the choices that its papers leave open
and writes generations.csv, a row for each navigator, knowledge and cell.

    scripts/studies/generations/generations.py [--layouts 20] [--markdown results/generations.md]
"""

import json
import sys
from pathlib import Path

import numpy as np

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from generations import brains, tuning  # noqa: E402
from generations.brains import BRAINS, DEAD, IDEAL, PERFECT, VISUAL, by_layout, estimate  # noqa: E402

BASELINE = "gestalt"
ENVELOPE = "as drawn"
DRAWS = 24  # of all that ENav's papers leave open
# What is no choice of theirs: the rover's, the same for everybody, or another entry's.
HELD = ("lengths", "goal_tolerance_m", "risk", "height_side_m", "cost_side_m")
# A generation: navigator, what it knows; each step changes one thing, planner, sensor or localization.
STEPS = [("1995: light stripe, dead reckoning, behaviour", ("behaviour, light stripe", DEAD)),
         ("stereo cameras in its place", ("behaviour", DEAD)),
         ("2002: GESTALT", ("gestalt", DEAD)),
         ("visual odometry", ("gestalt", VISUAL)),
         ("2007: a way to go on its map", ("gestalt, way to go", VISUAL)),
         ("2012: splines while driving, remedied", ("csad, remedied", VISUAL)),
         ("2020: ENav in its place", ("enav", VISUAL)),
         ("a perfect pose", ("enav", PERFECT)), ("exact points", ("enav", IDEAL))]
CHECKS = "enav.checks_per_cycle"


class Drives:
    """Trials by navigator, tuned or not, and by what it knows; each run once."""

    def __init__(self, args):
        self.args, self.programs, self.made = args, set(), {}
        self.tuned = json.loads(brains.TUNED.read_text(encoding="utf-8"))

    def run(self, name, tuned=True, knows=None):
        key = (name, tuned)
        if key not in self.made:
            known = (BRAINS[name].knows if tuned else (VISUAL,))
            axes = [brains.knowing_axis(known), *brains.ground_axes()]
            folder = self.args.out / ("tuned" if tuned else "assumed") / brains.file_of(name)
            trials, program = brains.swept(self.args, name, folder, axes, self.tuned.get(name, {}) if tuned else {})
            self.programs.add(program)
            self.made[key] = {level: part for (level,), part in study.cells_of(trials, ("knows",)).items()}
        return self.made[key] if knows is None else self.made[key][knows]


def points(first, second):
    """A paired difference of scores, second less first, in points."""
    return estimate(by_layout(second).to_numpy() - by_layout(first).to_numpy())


def ratio(base, trials, column):
    """A sum over that of the base, over drives in which both arrive."""
    keys = ["ground", "k_per_m2", "trial"]
    both = trials.merge(base, on=keys, suffixes=("", "_base"))
    both = both[(both.outcome == "goal_reached") & (both.outcome_base == "goal_reached")]
    return f"{both[column].sum() / both[f'{column}_base'].sum():.2f}" if len(both) else "-"


def standing(drives):
    base = drives.run(BASELINE, knows=VISUAL)
    lines = []
    for name, brain in BRAINS.items():
        trials = drives.run(name, knows=VISUAL)
        share = lambda *outcomes: f"{100 * trials.outcome.isin(outcomes).mean():.1f}"
        lines.append((by_layout(trials).mean(), [
            name, brain.year or "-", estimate(by_layout(trials)), "-" if name == BASELINE else points(base, trials),
            share("false_goal"), share("tip_over", "high_centred"), share("jammed"), share("no_path"),
            *(ratio(base, trials, column) for column in ("true_distance_m", "sim_time_s", "energy_wh")),
            f"{trials[CHECKS].mean():.0f}" if name.startswith("enav") else "-"]))
    return study.table(["navigator", "year", "truly arrives (%)", f"to {BASELINE} (points)", "false goal (%)", "body on a rock or over (%)",
                        "jammed (%)", "no path (%)", "way", "time", "energy", "checks a cycle"],
                       [line for _, line in sorted(lines, key=lambda line: -line[0])])


def knowing(drives):
    lines = []
    for name in BRAINS:
        parts = drives.run(name)
        cells = [estimate(by_layout(parts[level])) if level in parts else "-" for level in brains.KNOWS]
        steps = [points(parts[first], parts[second]) if second in parts else "-"
                 for first, second in ((DEAD, VISUAL), (VISUAL, PERFECT), (PERFECT, IDEAL))]
        lines.append([name, *cells, *steps])
    return study.table(["navigator: truly arrives (%)", *brains.KNOWS, "visual odometry brings (points)", "a perfect pose", "exact points"],
                       lines)


def ground(drives):
    grounds = [f"k {k:g}" for k in brains.ABUNDANCES] + list(brains.SLOPES)
    lines = []
    for name in BRAINS:
        trials = drives.run(name, knows=VISUAL)
        parts = [trials[trials.k_per_m2.astype(float) == k] for k in brains.ABUNDANCES]
        parts += [trials[trials.ground == slope] for slope in brains.SLOPES]
        lines.append([name, *(f"{100 * (part.outcome == 'goal_reached').mean():.0f}" for part in parts)])
    return study.table(["truly arrives (%)", *grounds], lines)


def steps(drives):
    lines, before = [], None
    for what, (name, knows) in STEPS:
        trials = drives.run(name, knows=knows)
        lines.append([what, name, knows, estimate(by_layout(trials)), points(before, trials) if before is not None else "-",
                      ratio(before, trials, "sim_time_s") if before is not None else "-"])
        before = trials
    return study.table(["step", "navigator", "localization, sensor", "truly arrives (%)", "step brings (points)", "time over that before"],
                       lines)


def tuned(drives):
    every = study.read_csv(brains.TUNED.with_name("generations_tuning.csv"))
    lines = []
    for name, brain in BRAINS.items():
        if not brain.levers:
            continue
        first = [100 * float(row["first"]) for row in every if row["navigator"] == name]
        taken = next(row["configuration"] for row in every if row["navigator"] == name and row["taken"])
        lines.append([name, f"{first[0]:.0f}", f"{np.median(first[1:]):.0f} ({min(first[1:]):.0f}..{max(first[1:]):.0f})",
                      "as assumed" if taken == "0" else f"number {taken}",
                      points(drives.run(name, tuned=False, knows=VISUAL), drives.run(name, knows=VISUAL))])
    return study.table(["navigator", "development: as assumed (%)", "configurations drawn: median (range)", "taken",
                        "tuned less as assumed, unused seed (points)"], lines)


def open_choices(args):
    """All numbers and choices of ENav that are assumed."""
    told = study.run([args.rockyard, "parameters", brains.BASE, "--csv", "--origin", "assumed", "--search", "navigation.enav"])
    rows = tuning.csv.DictReader(tuning.io.StringIO(told))
    return [row for row in rows if row["path"].startswith("navigation.enav.") and row["path"].rsplit(".", 1)[1] not in HELD
            and "continuous" not in row["path"] and (row["study_low"] or row["kind"] in ("choice", "boolean"))]


def envelope(drives):
    args = drives.args
    rows = open_choices(args)
    configs = tuning.configurations(rows, DRAWS, args.seed)
    axis = {"name": "configuration", "levels": [{"name": str(number), "set": values} for number, values in enumerate(configs)]}
    asked = type(args)(**vars(args) | {"layouts": max(4, args.layouts // 3)})
    trials, program = brains.swept(asked, "enav", args.out / "envelope", [axis, *brains.ground_axes()], {})
    drives.programs.add(program)
    scores = {key: 100 * by_layout(part).mean() for (key,), part in study.cells_of(trials, ("configuration",)).items()}
    others = sorted(score for key, score in scores.items() if key != "0")
    layouts = trials.trial.unique()
    base = drives.run(BASELINE, knows=VISUAL)
    rival = 100 * by_layout(base[base.trial.isin(layouts)]).mean()
    quarter = lambda share: f"{np.quantile(others, share):.1f}"
    return study.table(["ENav, truly arrives (%)", "as assumed", "least", "quarter", "median", "three quarters", "most",
                        f"above {BASELINE}'s {rival:.1f} %"],
                       [[f"{len(rows)} choices drawn {DRAWS} times, {len(layouts)} layouts", f"{scores['0']:.1f}", f"{others[0]:.1f}",
                         quarter(0.25), quarter(0.5), quarter(0.75), f"{others[-1]:.1f}", f"{sum(score > rival for score in others)} of {DRAWS}"]])


TABLES = {f"generations_{name}": f for name, f in {
    "standing": standing, "knowing": knowing, "ground": ground, "steps": steps, "tuning": tuned, "envelope": envelope}.items()}


def csv_rows(drives):
    rows = []
    for (name, was_tuned), parts in drives.made.items():
        for knows, trials in parts.items():
            for (slope, k), cell in study.cells_of(trials, ("ground", "k_per_m2")).items():
                arrived = cell[cell.outcome == "goal_reached"]
                rows.append({"navigator": name, "tuned": was_tuned, "knows": knows, "ground": slope, "k_per_m2": k, "drives": len(cell),
                             **{outcome: int((cell.outcome == outcome).sum()) for outcome in (
                                 "goal_reached", "false_goal", "tip_over", "high_centred", "jammed", "no_path", "time_limit")},
                             **{f"mean_{column}": f"{arrived[column].mean():.4g}" for column in ("true_distance_m", "sim_time_s", "energy_wh")}})
    return rows


def main():
    parser = study.argument_parser(__doc__)
    study.add_program(parser, threads=True)
    parser.add_argument("--layouts", type=int, default=20, help="of each cell (20)")
    parser.add_argument("--seed", type=int, default=20261130, help="of the layouts: none that anything was tuned on")
    parser.add_argument("--out", type=Path, default=study.ROOT / "results/runs/generations")
    args = study.parse_with_tables(parser, TABLES)
    drives = Drives(args)
    for name in args.tables.split(","):
        text = TABLES[name](drives)
        study.show(args, {name: text}, f"\n\n{args.layouts} layouts of 16 cells, seed {args.seed}; made by rockyard "
                                       f"{' and '.join(sorted(drives.programs))}.")
    study.write_csv(args.out / "generations.csv", csv_rows(drives))


if __name__ == "__main__":
    main()
