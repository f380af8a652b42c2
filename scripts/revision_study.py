#!/usr/bin/env python3
"""What each change of the revised Pathfinder model does, alone and left out, and other readings.

The changes were made after the published values were seen (scenarios/pathfinder/ASSUMPTIONS.md). Each
is undone by settings, so that one program gives the model before them ("before"), every change alone,
the revised model ("revised"), and that without one change. The same trials (same seed, same index) are
driven each way by the quasi-static rover; differences are in points of success, with the 95 % interval
of pairs that `rockyard compare` prints, one by one and not adjusted for their number.

    revision   the changes
    readings   what the text allows besides, against the revised model
    heights    both readings of the rocks' heights, with hazard sensing and blind

Runs that are there already are resumed. --markdown writes the tables between <!-- begin NAME --> and
<!-- end NAME --> of a page.

    scripts/revision_study.py [--trials 100] [--tables revision,readings] [--markdown PAGE]
"""

import argparse
import sys
from functools import partial

import calibrate_profile
import study

PATHFINDER = study.ROOT / "scenarios/pathfinder"
QUASI_STATIC = "rover.fidelity=quasi_static"
CELLS = ("nominal", "obstacles_0.85")
PUBLISHED = ("obstacles_0.28", "obstacles_0.57", "obstacles_0.85", "nominal")
# Name: settings that undo the change.
CHANGES = {
    "rocks on the mirror lines": ["terrain.rocks.mirror_line=keep_off"],
    "pointed rocks": ["terrain.rocks.pointedness=0"],
    "no clocks": ["referee.no_path_time_s=3600", "referee.time_limit_s=14400",
                  "energy.battery_wh=50"],
    "heading and distance noise calibrated on level sand": [
        "sensors.gyro.level_sand_gain=1", "sensors.encoders.level_sand_gain=1"],
}
# Readings of choices that were kept: name, settings.
READINGS = {
    "rocks may overlap": ["terrain.rocks.overlap=allow"],
    "clear zones of 0.42 m": ["terrain.rocks.clear_radius_m=0.42"],
    "smallest rock 0.05 m": ["terrain.rocks.min_diameter_m=0.05"],
    "smallest rock 0.14 m": ["terrain.rocks.min_diameter_m=0.14"],
}
BLIND = ["perception.hazard.enabled=false"]


LOW_HEIGHTS = ["terrain.rocks.min_height_ratio=0.4", "terrain.rocks.max_height_ratio=0.9"]


def low_rocks(rockyard):
    """The low reading of the heights, with the pointedness that single rocks of it ask for."""
    pointedness = calibrate_profile.calibrate(
        partial(calibrate_profile.seen_from, rockyard, settings=LOW_HEIGHTS),
        calibrate_profile.TARGET_M)
    if pointedness is None:
        sys.exit("no pointedness lets half of the low rocks of "
                 f"{100 * calibrate_profile.TARGET_M} cm be seen")
    return [*LOW_HEIGHTS, f"{calibrate_profile.POINTEDNESS}={pointedness:.4f}"]


class Runs:
    """Runs of the study by their settings, each made once."""

    def __init__(self, args):
        self.args, self.programs = args, set()

    def folder(self, name, scenario):
        return self.args.out / name / scenario

    def run(self, name, scenario, settings=()):
        print(f"{name}/{scenario}", file=sys.stderr, flush=True)
        summary = study.run_scenario(self.args, PATHFINDER / f"{scenario}.json",
                                     self.folder(name, scenario),
                                     [QUASI_STATIC, *self.args.set, *settings])
        self.programs.add(study.program(summary))
        return summary

    def difference(self, scenario, first, second):
        """Points of declared and of true success, second less first, with intervals."""
        success, _ = study.compare(self.args.rockyard, self.folder(first, scenario),
                                   self.folder(second, scenario))
        return [study.with_interval(success[kind][:3], 1) for kind in ("declared", "true")]


def label(name):
    return name.replace(" ", "_")


def rates(summary):
    return [study.with_interval((summary[key]["rate"], *summary[key]["ci95"]), 1, 100.0)
            for key in ("declared_success", "true_success")]


def undone(names):
    return [setting for name in names for setting in CHANGES[name]]


def revision(runs):
    rows = []
    for scenario in CELLS:
        before = runs.run("before", scenario, undone(CHANGES))
        revised = runs.run("revised", scenario)
        rows.append([f"**{scenario}**", *rates(before), *rates(revised)])
        for name in CHANGES:
            runs.run(f"alone_{label(name)}", scenario, undone(set(CHANGES) - {name}))
            runs.run(f"without_{label(name)}", scenario, CHANGES[name])
            rows.append([name, *runs.difference(scenario, "before", f"alone_{label(name)}"),
                         *runs.difference(scenario, f"without_{label(name)}", "revised")])
        rows.append(["all of them", *runs.difference(scenario, "before", "revised"), "-", "-"])
    head = ["change", "before, and what it adds alone: declared", "true",
            "revised, and what it adds last: declared", "true"]
    return study.table(head, rows)


def readings(runs):
    rows = []
    for scenario in CELLS:
        rows.append([f"**{scenario}**, revised", *rates(runs.run("revised", scenario))])
        for name, settings in READINGS.items():
            runs.run(f"reading_{label(name)}", scenario, settings)
            rows.append([name, *runs.difference(scenario, "revised", f"reading_{label(name)}")])
    return study.table(["reading", "declared", "true"], rows)


def heights(runs):
    low = low_rocks(runs.args.rockyard)
    rows = []
    for scenario in PUBLISHED:
        for name, settings in (("upright", []), ("low", low)):
            folder = "revised" if name == "upright" else "low"
            seeing = runs.run(folder, scenario, settings)
            blind = runs.run(f"blind_{folder}", scenario, [*settings, *BLIND])
            metres = sum(study.trial_columns(runs.folder(folder, scenario))["true_distance_m"])
            begun = sum(study.trial_columns(runs.folder(folder, scenario))["hazards_begun"])
            rows.append([scenario, name, *rates(seeing), *rates(blind), f"{begun / metres:.2f}"])
    text = study.table(["scenario", "rocks", "declared (%)", "true (%)", "blind: declared (%)",
                        "blind: true (%)", "avoidances begun a metre"], rows)
    return f"{text}\n\nlow: {', '.join(low)}"


TABLES = {f.__name__: f for f in (revision, readings, heights)}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    study.add_run_arguments(parser, trials=1000, out="revision")
    study.print_tables(study.parse_with_tables(parser, TABLES), TABLES, Runs, "quasi-static; ")
    return 0


if __name__ == "__main__":
    sys.exit(main())
