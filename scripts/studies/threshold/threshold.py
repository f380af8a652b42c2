#!/usr/bin/env python3
"""The threshold debate of Matthies 1995, section 6: t_dh against success, distance and scrapes.

The paper sets the threshold of the elevation difference between neighbours to 5 cm, which "in some
quarters is considered unduly conservative", and leaves the matter to experiment. This drives the
same trials with every threshold and writes threshold.csv, threshold.md and threshold.svg. The
threshold of the whole array's range stays at the clearance of the undercarriage.

    scripts/studies/threshold/threshold.py [--trials 300] [--low 3 --high 13] [SCENARIO ...]
"""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

THRESHOLD = "perception.hazard.neighbour_threshold_m"
SCENARIOS = [study.ROOT / f"scenarios/pathfinder/{name}.json" for name in ("nominal", "vl2")]
# Name, digits, scale, value with interval of a run.
MEASURES = [
    ("declared success (%)", 1, 100.0, lambda run: run.declared_success),
    ("true success (%)", 1, 100.0, lambda run: run.true_success),
    ("true distance (m)", 2, 1.0, lambda run: rates.mean(run.counted["true_distance_m"], least=0.0)),
    ("scrapes a trial", 2, 1.0, lambda run: rates.mean(run.counted["scrapes"], least=0.0)),
    ("hazards met a trial", 2, 1.0, lambda run: rates.mean(run.counted["hazards_met"], least=0.0)),
    ("hazards driven onto unseen (%)", 2, 100.0,
     lambda run: rates.share(run.counted["hazards_missed"], run.counted["hazards_met"])),
    ("time (min)", 1, 1.0 / 60.0, lambda run: rates.mean(run.counted["sim_time_s"], least=0.0)),
]
DRAWN = ("declared success (%)", "true success (%)", "true distance (m)", "scrapes a trial",
         "hazards driven onto unseen (%)")


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("scenarios", nargs="*", type=Path, default=SCENARIOS)
    parser.add_argument("--low", type=int, default=3, help="smallest threshold, cm")
    parser.add_argument("--high", type=int, default=13, help="largest threshold, cm")
    study.add_run_arguments(parser, trials=300, out="threshold")
    args = parser.parse_args()
    if not 0 < args.low <= args.high:
        parser.error("--low must be positive and no larger than --high")
    return args


def main():
    args = parse_arguments()
    args.set = ["rover.fidelity=quasi_static", *args.set]
    rows, lines, runs, series = [], [], [], {name: {} for name in DRAWN}
    for scenario in args.scenarios:
        for threshold_cm in range(args.low, args.high + 1):
            print(f"\r{scenario.stem}: {threshold_cm} cm", end="", file=sys.stderr)
            runs.append(run := study.run_scenario(args, scenario, args.out / scenario.stem / f"{threshold_cm:02d}",
                                                  [*args.set, f"{THRESHOLD}={threshold_cm / 100}"]))
            row = {"scenario": scenario.stem, "threshold_cm": threshold_cm, "program": study.program(run),
                   "trials": len(run.counted)}
            line = [scenario.stem, str(threshold_cm)]
            for name, digits, scale, measure in MEASURES:
                values = [scale * value for value in measure(run)]
                line.append(study.with_interval(values, digits))
                row |= zip((name, f"{name} low", f"{name} high"), values)
                if name in series:
                    series[name].setdefault(scenario.stem, []).append((threshold_cm, *values))
            rows.append(row)
            lines.append(line)
        print(file=sys.stderr)
    study.write_csv(args.out / "threshold.csv", rows)
    text = study.table(["scenario", "t_dh (cm)", *(name for name, *_ in MEASURES)], lines)
    text += (f"\n\n{args.trials} trials a point, seed {args.seed}, 95 % intervals; {study.held(args)}"
             f"{study.made_by(runs, ', ')}.\n")
    (args.out / "threshold.md").write_text(text, encoding="utf-8")
    study.write_svg(args.out / "threshold.svg", [(name, list(curves.items())) for name, curves in series.items()],
                    "t_dh (cm)")
    print(text)


if __name__ == "__main__":
    main()
