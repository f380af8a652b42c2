#!/usr/bin/env python3
"""Missions of 30 sols by what tells the rover where it is: the scenarios of scenarios/mission, counted.

Runs each scenario, or goes on with a run that is there, and reads every mission. Writes missions.csv (one row
an aid), missions.svg and five tables:

    rows     hours and days against Matthies 1995, section 2 and 6, in closed form and from runs
    missions goals reached, beliefs, where the rover is after 7 and 30 sols
    pairs    what each aid changes, on the same rocks and noise: means of paired differences
    ends     what ended sols and missions
    energy   sources and sinks of a sol

    scripts/studies/mission/mission.py [--trials 300] [--threads 2] [--out FOLDER] [--markdown results/missions.md]
"""

import argparse
import math
import sys
from pathlib import Path
from statistics import median

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/mission"
# Scenario, name. The first is what the others are held against.
AIDS = (("no_aid", "none"), ("tour", "lander, evening"), ("lander_noon", "lander, noon"), ("sun", "sun sensor"),
        ("lander_and_sun", "lander, evening, and sun sensor"), ("vision", "visual odometry"),
        ("beacon", "radio beacon"))
SOL_ENDS = ("goal", "time", "energy", "stuck", "no_path", "slip", "tipped", "no_command", "patience")
MISSION_ENDS = ("sols_done", "goals_done", "no_power", "tipped", "stuck", "lost", "left_field")
SOURCES = ("sun", "battery", "overdrawn")
SINKS = ("drive", "turn", "steer", "scan", "stall", "imaging", "compute", "overhead", "idle", "transmit", "sleep")
PAIRED = (("goals_reached", "goals reached"), ("distance_m", "way (m)"), ("after_7_position_m", "error, 7 sols (m)"),
          ("after_30_position_m", "error, 30 sols (m)"))
# Settings of level.json, words, published, closed form. 0.22 cm/s is the net rate with one scan every 6.5 cm (sec. 6).
FAR = ["mission.goals.x_m=[110]", "terrain.arena.length_m=150"]
ROWS = (("hour", FAR + ["mission.day.window_h=1"], "way in an hour, 'a few meters'", "7.9 m", 0.0022 * 3600),
        ("day", FAR, "way in a day of 4 h, 'under 40 m'", "40 m", 0.0022 * 14400),
        ("no_stops", FAR + ["clock.scan_time_s=0", "clock.scan_fixed_s=0"], "the same without a stop, 'about 95 m'",
         "95 m", 0.0067 * 14400))


def mean(values):
    return sum(values) / len(values)


def ratio(missions, part, whole):
    return rates.share(missions[part], missions[whole])


def summary_rows(missions):
    """One row an aid; `missions` by aid: records."""
    rows = []
    for aid, own in missions.items():
        row = {"aid": aid, "missions": len(own)}
        row |= zip(("goals_reached", "goals_reached_low", "goals_reached_high"), rates.mean(own["goals_reached"], least=0.0))
        row |= {name: mean(own[name]) for name in ("goals_believed", "goals_given_up")}
        row |= zip(("wrong_beliefs", "wrong_low", "wrong_high"), ratio(own, "wrong_beliefs", "goals_believed"))
        row |= {"distance_m": mean(own["distance_m"]), "longest_sol_m": max(own["longest_sol_m"])}
        for sols in (7, 30):
            errors = own[f"after_{sols}_position_m"]
            row |= {f"median_{sols}_m": median(errors), f"p95_{sols}_m": rates.quantile(errors, 0.95),
                    f"median_{sols}_deg": median(own[f"after_{sols}_heading_deg"]),
                    f"median_{sols}_told_m": median(own[f"after_{sols}_goal_frame_m"])}
            row |= {f"{name}_{sols}": ratio(own, f"after_{sols}_{frame}inside_95", f"after_{sols}_judged")[0]
                    for frame, name in (("", "inside"), ("goal_frame_", "inside_told"))}
        row["battery_left_wh"] = mean(own["battery_left_wh"])
        sources, sinks = (sum(own[f"{name}_wh"] for name in names) for names in (SOURCES, SINKS))
        row["closure"] = max(abs(sources - sinks) / sinks)
        rows.append(row)
    return rows


def missions_table(rows):
    return study.listed(rows, {
        "aid": "{aid}", "goals reached of 30": lambda row: study.interval_of(row, "goals_reached", 1),
        "believed": "{goals_believed:.1f}",
        "of these wrong (%)": lambda row: study.with_interval(
            (row["wrong_beliefs"], row["wrong_low"], row["wrong_high"]), 0, 100.0),
        "given up": "{goals_given_up:.1f}", "way (m)": "{distance_m:.0f}", "longest sol (m)": "{longest_sol_m:.1f}",
        "error after 7 sols (m, median / 95 %)": "{median_7_m:.2f} / {p95_7_m:.2f}",
        "after 30": "{median_30_m:.2f} / {p95_30_m:.2f}", "heading (deg), 7, 30": "{median_7_deg:.0f}, {median_30_deg:.0f}",
        "error in the frame of goals (m), 7, 30": "{median_7_told_m:.2f}, {median_30_told_m:.2f}",
        "inside its 95 % (%), 7, 30": lambda row: f"{100 * row['inside_7']:.0f}, {100 * row['inside_30']:.0f}",
        "in the frame of goals": lambda row: f"{100 * row['inside_told_7']:.0f}, {100 * row['inside_told_30']:.0f}"})


def pairs_table(missions):
    first, *others = missions
    return study.table([f"less {first}, mean (95 %)", *[name for _, name in PAIRED]], [
        [aid, *(study.with_interval(rates.mean(missions[aid][column] - missions[first][column]), 1)
                for column, _ in PAIRED)] for aid in others])


def ends_table(missions):
    words = lambda ends: [end.replace("_", " ") for end in ends]
    return study.table(["aid", *[f"sols: {word} (%)" for word in words(SOL_ENDS)],
                        *[f"missions: {word} (%)" for word in words(MISSION_ENDS)]], [
        [aid, *(f"{100 * ratio(own, f'sols_{end}', 'sols')[0]:.1f}" for end in SOL_ENDS),
         *(f"{100 * ratio(own, f'end_{end}', 'missions')[0]:.0f}" for end in MISSION_ENDS)]
        for aid, own in missions.items()])


def energy_table(missions):
    shown = ("sun_available", "sun", "battery", "drive", "turn", "steer", "scan", "idle", "transmit", "sleep")
    return study.table(["Wh a sol", "sun could give", "from the sun", "from batteries", "driving", "turning", "steering",
                        "scans", "idle", "transmitting", "asleep", "batteries at the end"], [
        [aid, *(f"{sum(own[f'{name}_wh']) / sum(own['sols']):.2f}" for name in shown),
         f"{mean(own['battery_left_wh']):.0f}"] for aid, own in missions.items()])


def rows_table(ways_m):
    """`ways_m`: by name of a row, what a run drove."""
    lines = [[words, published, f"{closed:.1f} m", f"{ways_m[name]:.1f} m"]
             for name, _, words, published, closed in ROWS]
    return study.table(["Matthies 1995, sections 2 and 6", "published", "closed form", "runs"], lines)


def draw(path, missions):
    """Shares of the missions whose rover is off by less than so much, after 7 and 30 sols."""
    def curve(values):
        errors = sorted(values)
        return [(math.log10(max(error, 1e-3)), *[(i + 1) / len(errors)] * 3) for i, error in enumerate(errors)]
    study.write_svg(path, [(f"after {sols} sols", [(aid, curve(missions[aid][f"after_{sols}_position_m"]))
                                                   for aid in list(missions)[:4]])
                           for sols in (7, 30)], "log10 of the position error (m)")


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, 300, "missions", seed=4)
    study.add_page(parser)
    parser.add_argument("--studies", type=Path, default=study.ROOT / "results/studies", help="where files go")
    args = parser.parse_args()
    runs = {name: study.run_scenario(args, SCENARIOS / f"{scenario}.json", args.out / scenario, args.set)
            for scenario, name in AIDS}
    missions = {name: run.counted for name, run in runs.items()}
    level = argparse.Namespace(**vars(args) | {"trials": 1})
    ways_m = {name: study.run_scenario(level, SCENARIOS / "level.json", args.out / name, settings).counted["distance_m"][0]
              for name, settings, *_ in ROWS}
    rows = summary_rows(missions)
    study.write_csv(args.studies / "missions.csv", rows)
    draw(args.studies / "missions.svg", missions)
    closure = max(row["closure"] for row in rows)
    study.show(args, {"missions_rows": rows_table(ways_m)})
    study.show(args, {"missions_missions": missions_table(rows), "missions_pairs": pairs_table(missions),
                      "missions_ends": ends_table(missions), "missions_energy": energy_table(missions) +
                      f"\n\nSources less sinks, over sinks: {closure:.1g} at most."},
               f"\n\n{args.trials} missions each, seed {args.seed}; {study.made_by(runs.values())}.")


if __name__ == "__main__":
    main()
