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

THRESHOLD = "perception.hazard.neighbour_threshold_m"
SCENARIOS = [study.ROOT / f"scenarios/pathfinder/{name}.json" for name in ("nominal", "vl2")]
# Name, digits, scale, value with interval from the summary and the columns of the trials.
MEASURES = [
    ("declared success (%)", 1, 100.0,
     lambda s, c: (s["declared_success"]["rate"], *s["declared_success"]["ci95"])),
    ("true success (%)", 1, 100.0,
     lambda s, c: (s["true_success"]["rate"], *s["true_success"]["ci95"])),
    ("true distance (m)", 2, 1.0, lambda s, c: study.mean_interval(c["true_distance_m"])),
    ("scrapes a trial", 2, 1.0, lambda s, c: study.mean_interval(c["scrapes"])),
    ("hazards met a trial", 2, 1.0, lambda s, c: study.mean_interval(c["hazards_met"])),
    ("hazards driven onto unseen (%)", 2, 100.0,
     lambda s, c: study.ratio_interval(c["hazards_missed"], c["hazards_met"])),
    ("time (min)", 1, 1.0 / 60.0, lambda s, c: study.mean_interval(c["sim_time_s"])),
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
    held = ["rover.fidelity=quasi_static", *args.set]
    rows, series = [], {name: [] for name in DRAWN}
    for scenario in args.scenarios:
        curves = {name: [] for name in DRAWN}
        for threshold_cm in range(args.low, args.high + 1):
            folder = args.out / scenario.stem / f"{threshold_cm:02d}"
            summary = study.run_scenario(args, scenario, folder,
                                         [*held, f"{THRESHOLD}={threshold_cm / 100}"])
            columns = study.trial_columns(folder)
            row = {"scenario": scenario.stem, "threshold_cm": threshold_cm,
                   "program": study.program(summary), "trials": len(columns["outcome"])}
            cells = {}
            for name, digits, scale, measure in MEASURES:
                values = measure(summary, columns)
                cells[name] = study.with_interval(values, digits, scale)
                for part, value in zip(("", " low", " high"), values):
                    row[name + part] = scale * value
                if name in curves:
                    curves[name].append((threshold_cm, *(scale * value for value in values)))
            rows.append((row, cells))
            print(f"\r{scenario.stem}: {threshold_cm} cm", end="", file=sys.stderr)
        print(file=sys.stderr)
        for name in DRAWN:
            series[name].append((scenario.stem, curves[name]))
    study.write_csv(args.out / "threshold.csv", [row for row, _ in rows])
    names = [name for name, *_ in MEASURES]
    text = study.table(["scenario", "t_dh (cm)", *names],
                       [[row["scenario"], str(row["threshold_cm"]), *(cells[name] for name in names)]
                        for row, cells in rows])
    programs = ", ".join(sorted({row["program"] for row, _ in rows}))
    text += (f"\n\n{args.trials} trials a point, seed {args.seed}, 95 % intervals; held: "
             f"{', '.join(held)}; made by rockyard {programs}.\n")
    (args.out / "threshold.md").write_text(text, encoding="utf-8")
    study.write_svg(args.out / "threshold.svg", list(series.items()), "t_dh (cm)")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
