#!/usr/bin/env python3
"""Which hazard sensors are worth their power and time (Matthies 1995, section 7).

Drives the same trials with every subset of the Pathfinder rover's hazard sensors: light stripe,
contact switches, accelerometers (tilt), joint angles (articulation) and motor currents. Writes
sensor_suite.csv, sensor_suite_pairs.csv and sensor_suite.md. What sensors add to success is tested by pairs of trials with
the same index: each subset against the one that keeps of it only the light stripe (McNemar, exact),
all tests of all scenarios together one family (Holm).

    scripts/studies/sensor_suite/sensor_suite.py [--trials 100] [SCENARIO ...]
"""

import itertools
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

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
SUCCESS = {"declared": study.ARRIVED, "true": ("goal_reached",)}


def pairs(run, base, outcomes):
    """Trials in both runs: how many succeeded only with, and how many only without the sensors."""
    ended, of_base = (dict(zip(each.counted["trial"].tolist(), each.ended(*outcomes))) for each in (run, base))
    both = [(ended[trial], of_base[trial]) for trial in ended if trial in of_base]
    return both.count((True, False)), both.count((False, True))


def paired_tests(runs):
    """One row per (scenario, subset) and kind of success; runs by scenario and sensors."""
    tests = []
    for (scenario, names), run in runs.items():
        base = ("light stripe",) if "light stripe" in names and len(names) > 1 else ()
        if names == base:
            continue
        for kind, outcomes in SUCCESS.items():
            gained, lost = pairs(run, runs[scenario, base], outcomes)
            tests.append({"scenario": scenario, "sensors": "+".join(names), "against": "+".join(base) or "none",
                          "success": kind, "gained": gained, "lost": lost, "p": rates.mcnemar(gained, lost)})
    for test, adjusted in zip(tests, rates.holm(test["p"] for test in tests)):
        test["holm"] = adjusted
    return tests


def paired_text(tests):
    """The tests that show something, and those of single sensors in which any trial changed."""
    def shown(test):
        added = test["sensors"].count("+") - (test["against"] != "none")
        return test["holm"] <= 0.05 or (added == 0 and test["gained"] + test["lost"] > 0)
    differ = sum(test["holm"] <= 0.05 for test in tests)
    text = (f"\n{len(tests)} tests by pairs (McNemar, Holm), {differ} differ at 0.05: those, and single "
            "sensors that changed any trial. Gained, lost: trials that succeed only with, or only "
            "without what is added.\n\n")
    return text + study.listed(sorted(filter(shown, tests), key=lambda test: test["p"]), {
        **{name: f"{{{name}}}" for name in ("scenario", "sensors", "against", "success", "gained", "lost")},
        "p": "{p:.2g}", "Holm": "{holm:.2g}"}) + "\n"


def measures(run):
    rows = run.counted
    mean = lambda values: rates.mean(values, least=0.0)
    return {
        "declared success (%)": [100.0 * value for value in run.declared_success],
        "true success (%)": [100.0 * value for value in run.true_success],
        "hazards driven onto unseen (%)": [100.0 * value for value in rates.share(rows["hazards_missed"], rows["hazards_met"])],
        "scrapes a trial": mean(rows["scrapes"]),
        "felt a trial": mean(sum(rows[name] for name in FELT)),
        "energy (Wh)": mean(rows["energy_wh"]),
        "scan energy (Wh)": mean(rows["scan_energy_wh"]),
        "time (min)": mean(rows["sim_time_s"] / 60.0),
    }


def subsets():
    """Every subset, from none to all."""
    for on in itertools.product((False, True), repeat=len(SENSORS)):
        yield dict(zip(SENSORS, on))


def parse_arguments():
    parser = study.argument_parser(__doc__)
    parser.add_argument("scenarios", nargs="*", type=Path, default=SCENARIOS)
    study.add_run_arguments(parser, trials=100, out="sensor_suite")
    return parser.parse_args()


def main():
    args = parse_arguments()
    args.set = ["rover.fidelity=quasi_static", *args.set]
    rows, lines, runs = [], [], {}
    for scenario in args.scenarios:
        for suite in sorted(subsets(), key=lambda each: sum(each.values())):
            names = [name for name, on in suite.items() if on]
            folder = args.out / scenario.stem / ("_".join(names).replace(" ", "") or "none")
            switches = [f"{SENSORS[name]}={str(on).lower()}" for name, on in suite.items()]
            run = runs[scenario.stem, tuple(names)] = study.run_scenario(args, scenario, folder, [*args.set, *switches])
            found = measures(run)
            row = {"scenario": scenario.stem, "suite": "+".join(names) or "none",
                   "program": study.program(run), "trials": len(run.counted)}
            for name, values in found.items():
                row |= zip((name, f"{name} low", f"{name} high"), values)
            rows.append(row)
            lines.append([scenario.stem, row["suite"], *(study.with_interval(values, 1) for values in found.values()),
                          *(f"{100.0 * run.ended(*ends).mean():.0f}" for ends in (STUCK, ("no_path",)))])
            print(f"\r{scenario.stem}: {len(rows)} subsets", end="", file=sys.stderr)
        print(file=sys.stderr)
    study.write_csv(args.out / "sensor_suite.csv", rows)
    tests = paired_tests(runs)
    study.write_csv(args.out / "sensor_suite_pairs.csv", tests)
    text = study.table(["scenario", "sensors", *found, "stuck or tipped (%)", "no path (%)"], lines)
    text += (f"\n\n{args.trials} trials a subset, seed {args.seed}, 95 % intervals; {study.held(args)}"
             f"{study.made_by(runs.values(), ', ')}.\n") + paired_text(tests)
    (args.out / "sensor_suite.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
