#!/usr/bin/env python3
"""Which hazard sensors are worth their power and time (Matthies 1995, section 7).

Drives the same trials with every subset of the Pathfinder rover's hazard sensors: light stripe,
contact switches, accelerometers (tilt), joint angles (articulation) and motor currents. Writes
sensor_suite.csv and sensor_suite.md.

    scripts/sensor_suite_study.py [--trials 100] [SCENARIO ...]
"""

import argparse
import itertools
import sys
from pathlib import Path

import study

SENSORS = {
    "light stripe": "perception.hazard.enabled",
    "contact": "sensors.vehicle.contact.enabled",
    "tilt": "sensors.vehicle.accelerometers.enabled",
    "articulation": "sensors.vehicle.articulation.enabled",
    "motor current": "sensors.vehicle.motor_current.enabled",
}
SCENARIOS = [study.ROOT / f"scenarios/mars/{name}.json" for name in ("mfex_nominal", "mfex_vl2")]
FELT = ("contact_hazards", "tilt_hazards", "articulation_hazards", "current_hazards")
STUCK = ("jammed", "high_centred", "tip_over")


def share(columns, outcomes):
    """Share of the trials that ended so, in per cent, as text."""
    ended = [outcome in outcomes for outcome in columns["outcome"]]
    return f"{100.0 * sum(ended) / len(ended):.0f}"


def measures(summary, columns):
    return {
        "declared success (%)": (100.0 * summary["declared_success"]["rate"],
                                 *(100.0 * end for end in summary["declared_success"]["ci95"])),
        "true success (%)": (100.0 * summary["true_success"]["rate"],
                             *(100.0 * end for end in summary["true_success"]["ci95"])),
        "hazards missed (%)": tuple(
            100.0 * value
            for value in study.ratio_interval(columns["hazards_missed"], columns["hazards_met"])),
        "scrapes a trial": study.mean_interval(columns["scrapes"]),
        "felt a trial": study.mean_interval([sum(felt) for felt in
                                             zip(*(columns[name] for name in FELT))]),
        "energy (Wh)": study.mean_interval(columns["energy_wh"]),
        "scan energy (Wh)": study.mean_interval(columns["scan_energy_wh"]),
        "time (min)": study.mean_interval([time / 60.0 for time in columns["sim_time_s"]]),
    }


def subsets():
    """Every subset, from none to all."""
    for on in itertools.product((False, True), repeat=len(SENSORS)):
        yield dict(zip(SENSORS, on))


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenarios", nargs="*", type=Path, default=SCENARIOS)
    study.add_run_arguments(parser, trials=100, out="sensor_suite")
    return parser.parse_args()


def main():
    args = parse_arguments()
    held = ["rover.fidelity=quasi_static", *args.set]
    rows, lines = [], []
    for scenario in args.scenarios:
        for suite in sorted(subsets(), key=lambda each: sum(each.values())):
            names = [name for name, on in suite.items() if on]
            folder = args.out / scenario.stem / ("_".join(names).replace(" ", "") or "none")
            switches = [f"{SENSORS[name]}={str(on).lower()}" for name, on in suite.items()]
            summary = study.run_scenario(args, scenario, folder, [*held, *switches])
            columns = study.trial_columns(folder)
            found = measures(summary, columns)
            row = {"scenario": scenario.stem, "suite": "+".join(names) or "none",
                   "trials": len(columns["outcome"])}
            for name, values in found.items():
                row.update(zip((name, f"{name} low", f"{name} high"), values))
            rows.append(row)
            lines.append([scenario.stem, row["suite"],
                          *(study.with_interval(values, 1) for values in found.values()),
                          share(columns, STUCK), share(columns, ("no_path",))])
            print(f"\r{scenario.stem}: {len(rows)} subsets", end="", file=sys.stderr)
        print(file=sys.stderr)
    study.write_csv(args.out / "sensor_suite.csv", rows)
    text = study.table(["scenario", "sensors", *found, "stuck or tipped (%)", "no path (%)"], lines)
    text += (f"\n\n{args.trials} trials a subset, seed {args.seed}, 95 % intervals; held: "
             f"{', '.join(held)}.\n")
    (args.out / "sensor_suite.md").write_text(text, encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
