#!/usr/bin/env python3
"""How long an operator waits, against success: what every patience gives, from one run without any.

Matthies 1995, section 7, ended a run "when it became clear that the rover couldn't find a way to the
goal", which an operator's eye decided. Nothing before its end depends on that patience, so a run
that had none tells what it would have been with any: trials that drove or turned more without
progress (no_progress_distance_m, no_progress_turn_deg) end as no_path, all others as they did.
Writes patience.csv, patience.md, patience_distance.svg and patience_turn.svg. No patience is chosen
from it. Clocks are those of the scenario.

    scripts/patience_study.py [--trials 300] [SCENARIO ...]
"""

import argparse
import math
import sys
from pathlib import Path

import study

SCENARIOS = [study.ROOT / f"scenarios/pathfinder/{name}.json"
             for name in ("nominal", "obstacles_0.85")]
# None: what ends a rover that goes round for ever. Six courses, or thirty full turns, more than the
# longest patience; one that goes on can drive along a mirror line, reflected at every tick.
NONE_M, NONE_DEG = 50.0, 10800.0
WITHOUT = [f"referee.no_path_distance_m={NONE_M:g}", f"referee.no_path_turn_deg={NONE_DEG:g}"]
DISTANCES_M = (2.0, 3.0, 4.0, 6.0, 8.0, 10.0, math.inf)
TURNS_DEG = (720.0, 1080.0, 2160.0, math.inf)
HEADLINE = (4.0, 1080.0)
DECLARED = ("goal_reached", "false_goal")


def outcomes_under(columns, distance_m, turn_deg):
    """Outcomes of trials that had no patience, as they would be with this one."""
    return ["no_path" if driven > min(distance_m, NONE_M) or turned > min(turn_deg, NONE_DEG)
            else outcome
            for outcome, driven, turned in zip(columns["outcome"], columns["no_progress_distance_m"],
                                               columns["no_progress_turn_deg"])]


def share(count, trials):
    """Percentage with Wilson's interval."""
    return tuple(100.0 * value for value in (count / trials, *study.wilson_interval(count, trials)))


def row_of(scenario, columns, distance_m, turn_deg):
    outcomes = outcomes_under(columns, distance_m, turn_deg)
    row = {"scenario": scenario, "distance_m": distance_m, "turn_deg": turn_deg,
           "trials": len(outcomes)}
    for name, kinds in (("declared", DECLARED), ("true", DECLARED[:1]), ("no_path", ("no_path",))):
        values = share(sum(outcome in kinds for outcome in outcomes), len(outcomes))
        for part, value in zip(("", " low", " high"), values):
            row[f"{name} (%){part}"] = value
    return row


def rows_of(scenario, columns):
    """The headline; distances with turning without end; turns with distance without end."""
    pairs = [HEADLINE, *((distance, math.inf) for distance in DISTANCES_M),
             *((math.inf, turn) for turn in TURNS_DEG[:-1])]
    return [row_of(scenario, columns, *pair) for pair in pairs]


def band(row, name):
    return tuple(row[f"{name} (%){part}"] for part in ("", " low", " high"))


def limit_text(value, unit):
    return "none" if math.isinf(value) else f"{value:g} {unit}"


def table_of(rows):
    header = ["scenario", "distance", "turning", "declared (%)", "true (%)", "no path (%)"]
    return study.table(header, [
        [row["scenario"], limit_text(row["distance_m"], "m"), limit_text(row["turn_deg"], "deg"),
         *(study.with_interval(band(row, name), 1) for name in ("declared", "true", "no_path"))]
        for row in rows])


def panels(rows, varied, other):
    """One diagram a scenario: success against one patience, without the other."""
    result = []
    for scenario in dict.fromkeys(row["scenario"] for row in rows):
        curve = [row for row in rows if row["scenario"] == scenario and math.isinf(row[other])]
        curve.sort(key=lambda row: row[varied])
        last = 1.2 * max(row[varied] for row in curve if math.isfinite(row[varied]))
        result.append((scenario, [(name, [(min(row[varied], last), *band(row, name))
                                          for row in curve]) for name in ("declared", "true")]))
    return result


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenarios", nargs="*", default=SCENARIOS, type=Path)
    study.add_run_arguments(parser, trials=300, out="patience")
    return parser.parse_args()


def main():
    args = parse_arguments()
    held = ["rover.fidelity=quasi_static", *args.set]
    rows, programs = [], set()
    for scenario in args.scenarios:
        folder = args.out / scenario.stem
        programs.add(study.program(study.run_scenario(args, scenario, folder, [*held, *WITHOUT])))
        rows += rows_of(scenario.stem, study.trial_columns(folder))
    study.write_csv(args.out / "patience.csv", rows)
    text = table_of(rows)
    text += (f"\n\n{args.trials} trials a scenario, seed {args.seed}, simulator faults left out, Wilson's "
             "95 % intervals; held: "
             f"{', '.join(held)}; none: {NONE_M:g} m, {NONE_DEG:g} deg; made by rockyard "
             f"{', '.join(sorted(programs))}.\n")
    (args.out / "patience.md").write_text(text, encoding="utf-8")
    for name, varied, other, label in (
            ("distance", "distance_m", "turn_deg", "patience in distance (m); rightmost: none"),
            ("turn", "turn_deg", "distance_m", "patience in turning (deg); rightmost: none")):
        study.write_svg(args.out / f"patience_{name}.svg", panels(rows, varied, other), label)
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
