#!/usr/bin/env python3
"""What each choice of GESTALT's scenarios does in dense terrain, alone and left out, and confirmed once.

The scenarios of scenarios/gestalt/ differ in some choices from the reading by the letter of Goldberg 2002
and from rockyard's first safeguards. Each choice is undone by settings, so that one program gives the
printed reading ("printed"), each choice alone on top of it, the scenarios as they are ("chosen"), and these
without one choice. The same trials (same seed, same index) are driven each way by the quasi-static rover;
differences are in points of true success with the 95 % interval of pairs that `rockyard compare` prints,
one by one and not adjusted for their number.

    changes         every choice, in four cells
    other_readings  what else the papers allow, against the chosen settings
    odometer        rim way over true way: what makes it long among rocks, and the scale that corrects it
    dense           Viking Lander 2: printed and chosen, own and perfect localization, both fidelities

The choices were made on seed 1, point turns of one angle after the courses of sense had been driven; `dense`
is run once on a seed that no choice has seen (--seed).
Runs that are there already are resumed. --markdown writes the tables between <!-- begin NAME --> and
<!-- end NAME --> of a page.

    scripts/studies/gestalt/gestalt.py [--trials 200] [--tables odometer,changes,...] [--markdown PAGE]
"""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/gestalt"
QUASI_STATIC, MULTIBODY = "rover.fidelity=quasi_static", "rover.fidelity=multibody"
ORACLE = ["localization.estimator=oracle"]
DRIVE, MAP = "navigation.gestalt.drive", "navigation.gestalt.map"
# Name: scenario, settings that make the cell.
CELLS = {
    "Viking Lander 2, perfect localization": ("viking_lander_2", ORACLE),
    "Viking Lander 2": ("viking_lander_2", []),
    "narrow course": ("narrow_course", []),
    "nominal terrain": ("abundance", []),
}
# Name: settings that undo the choice, by the letter of the paper or by rockyard's first value.
CHANGES = {
    "a stall is a strained wheel that hardly turns, for 1.5 s": [
        "perception.vehicle_hazard.max_turn_share=2", "perception.vehicle_hazard.current_ticks=3"],
    "joints may bend as far as a rock of obst_height bends them": [
        "perception.vehicle_hazard.max_bogie_deg=30"],
    "backward arcs as a last resort": [f"{DRIVE}.backward_arcs=below_threshold"],
    "point turns compete, and are followed by a straight drive": [
        f"{DRIVE}.point_turns=below_min_vote"],
    "steps count from the patch's plane, slopes by the pitch test": [
        f"{MAP}.step_reference=level", f"{MAP}.tests.pitch=false"],
    "an arc on which a hazard was felt is vetoed": [f"{DRIVE}.veto_felt=false"],
    "odometer calibrated in Viking Lander 2 terrain": [
        "perception.dead_reckoning.distance_scale=0.995"],
}
READINGS = {
    "six point turns to either side": ["navigation.gestalt.arcs.num_point_turns=6"],
    "six, at a price of 20 votes": ["navigation.gestalt.arcs.num_point_turns=6",
                                    f"{DRIVE}.point_turn_margin=20"],
    "unknown cells by certainty": ["navigation.gestalt.plan.unknown_cells=by_certainty"],
    "tight arcs judged over 90 deg": ["navigation.gestalt.plan.max_path_turn_deg=90"],
    "backward arcs always": [f"{DRIVE}.backward_arcs=always"],
}


# What the odometer of a rover is that believes its rims, where the terrain differs; Goldberg 2002 names
# "Viking Lander II-type terrain", so that its scale is the one that the scenarios take.
NO_SLIP = {"soil": "terrain.ground.soil.preset=hard_ground", "rocks": "rover.contact.wheel_rock_friction=3"}
GROUND = {
    "sand without rocks": ["terrain.rocks.kind=none"],
    "Viking Lander 2": [],
    "Viking Lander 2, hard ground between the rocks": [NO_SLIP["soil"]],
    "Viking Lander 2, rocks that hold (friction 3)": [NO_SLIP["rocks"]],
    "Viking Lander 2, both: no slip": list(NO_SLIP.values()),
}
RIMS = "perception.dead_reckoning.distance_scale=1"
STUCK = ("jammed", "high_centred")  # their wheels spin where they stand


class Runs:
    """Runs of the study by their settings, each made once."""

    def __init__(self, args):
        self.args, self.programs, self.made = args, set(), {}

    def run(self, name, cell, settings=(), fidelity=QUASI_STATIC):
        print(f"{name} / {cell}", file=sys.stderr, flush=True)
        letters = lambda text: "".join(c if c.isalnum() else "_" for c in text)
        scenario, own = CELLS[cell]
        run = study.run_scenario(self.args, SCENARIOS / f"{scenario}.json", self.args.out / letters(name) / letters(cell),
                                 [fidelity, *own, *self.args.set, *settings])
        self.programs.add(study.program(run))
        self.made[name, cell] = run
        return run

    def difference(self, cell, first, second):
        """Points of true success, second less first, with its interval."""
        success, _ = study.compare(self.made[first, cell], self.made[second, cell])
        return study.with_interval(success["true"][:3], 1)


def percent(rate):
    return study.with_interval(rate, 1, 100.0)


def undone(names):
    return [setting for name in names for setting in CHANGES[name]]


def changes(runs):
    rows = []
    for cell in CELLS:
        printed = runs.run("printed", cell, undone(CHANGES))
        chosen = runs.run("chosen", cell)
        rows.append([f"**{cell}**", percent(printed.true_success), percent(chosen.true_success)])
        for name in CHANGES:
            runs.run(f"alone {name}", cell, undone(other for other in CHANGES if other != name))
            runs.run(f"without {name}", cell, CHANGES[name])
            rows.append([name, runs.difference(cell, "printed", f"alone {name}"),
                         runs.difference(cell, f"without {name}", "chosen")])
        rows.append(["all of them", runs.difference(cell, "printed", "chosen"), "-"])
    return study.table(["choice", "as printed: true success (%), and what it adds alone (points)",
                        "as chosen, and what it adds last"], rows)


def other_readings(runs):
    rows = []
    for cell in CELLS:
        rows.append([f"**{cell}**, chosen", percent(runs.run("chosen", cell).true_success)])
        for name, settings in READINGS.items():
            runs.run(f"reading {name}", cell, settings)
            rows.append([name, runs.difference(cell, "chosen", f"reading {name}")])
    return study.table(["reading", "true success (%), and the difference that it makes (points)"], rows)


def odometer(runs):
    rows = []
    for name, settings in GROUND.items():
        run = runs.run(f"odometer {name}", "Viking Lander 2", [RIMS, *settings])
        ways = run.counted[~run.ended(*STUCK)]
        ratio = sum(ways["dead_reckoned_distance_m"]) / sum(ways["true_distance_m"])
        rows.append([name, str(len(ways)), f"{ratio:.4f}", f"{1.0 / ratio:.4f}"])
    return study.table(["ground", "drives that did not get stuck", "rim way over true way",
                        "distance_scale that corrects it"], rows)


def dense_row(runs, reading, cell, fidelity):
    name = fidelity.split("=")[1]
    run = runs.run(f"{reading} {name}", cell, undone(CHANGES) if reading == "printed" else (), fidelity)
    total = lambda column: run.counted[column].sum()
    moves, trials = total("moves"), len(run.counted)
    ratio = total("dead_reckoned_distance_m") / total("true_distance_m")
    return [cell, name.replace("_", "-"), reading, percent(run.declared_success), percent(run.true_success),
            study.ends(run, *study.ARRIVED), f"{moves / trials:.0f}",
            f"{total('rear_image_sets') / trials:.1f}", f"{100.0 * total('reversals') / moves:.0f}",
            f"{total('safeguard_stops') / trials:.1f}", f"{100.0 * (ratio - 1.0):+.0f}"]


def dense(runs):
    rows = [dense_row(runs, reading, cell, fidelity)
            for cell in ("Viking Lander 2", "Viking Lander 2, perfect localization")
            for fidelity in (QUASI_STATIC, MULTIBODY) for reading in ("printed", "chosen")]
    return study.table(["terrain, localization", "fidelity", "reading", "declared (%)", "true (%)",
                        "failures", "moves a trial", "rear looks a trial", "moves that reverse (%)",
                        "stops by safeguards a trial", "odometer over true way (%)"], rows)


TABLES = {f.__name__: f for f in (odometer, changes, other_readings, dense)}


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, trials=200, out="gestalt_study")
    study.print_tables(study.parse_with_tables(parser, TABLES), TABLES, Runs)


if __name__ == "__main__":
    main()
