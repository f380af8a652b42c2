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


def ratio(columns, part, whole):
    return study.ratio_interval(columns[part], columns[whole])


def summary_rows(missions):
    """One row an aid; `missions` by aid: columns as lists over missions."""
    rows = []
    for aid, columns in missions.items():
        reached, low, high = study.mean_interval(columns["goals_reached"])
        row = {"aid": aid, "missions": len(columns["goals_reached"]), "goals_reached": reached,
               "goals_reached_low": low, "goals_reached_high": high,
               "goals_believed": study.mean_interval(columns["goals_believed"])[0],
               "goals_given_up": study.mean_interval(columns["goals_given_up"])[0]}
        row["wrong_beliefs"], row["wrong_low"], row["wrong_high"] = ratio(columns, "wrong_beliefs", "goals_believed")
        row["distance_m"] = study.mean_interval(columns["distance_m"])[0]
        row["longest_sol_m"] = max(columns["longest_sol_m"])
        for sols in (7, 30):
            errors = columns[f"after_{sols}_position_m"]
            row[f"median_{sols}_m"], row[f"p95_{sols}_m"] = median(errors), study.quantile(errors, 0.95)
            row[f"median_{sols}_deg"] = median(columns[f"after_{sols}_heading_deg"])
            row[f"median_{sols}_told_m"] = median(columns[f"after_{sols}_goal_frame_m"])
            for frame, name in (("", "inside"), ("goal_frame_", "inside_told")):
                row[f"{name}_{sols}"] = ratio(columns, f"after_{sols}_{frame}inside_95", f"after_{sols}_judged")[0]
        row["battery_left_wh"] = study.mean_interval(columns["battery_left_wh"])[0]
        row["closure"] = max(abs(sum(columns[f"{s}_wh"][i] for s in SOURCES) - sum(columns[f"{s}_wh"][i] for s in SINKS))
                             / sum(columns[f"{s}_wh"][i] for s in SINKS) for i in range(row["missions"]))
        rows.append(row)
    return rows


def missions_table(rows):
    lines = []
    for row in rows:
        lines.append([row["aid"],
                      study.with_interval((row["goals_reached"], row["goals_reached_low"],
                                           row["goals_reached_high"]), 1),
                      f"{row['goals_believed']:.1f}",
                      study.with_interval((row["wrong_beliefs"], row["wrong_low"], row["wrong_high"]), 0, 100.0),
                      f"{row['goals_given_up']:.1f}", f"{row['distance_m']:.0f}", f"{row['longest_sol_m']:.1f}",
                      f"{row['median_7_m']:.2f} / {row['p95_7_m']:.2f}",
                      f"{row['median_30_m']:.2f} / {row['p95_30_m']:.2f}",
                      f"{row['median_7_deg']:.0f}, {row['median_30_deg']:.0f}",
                      f"{row['median_7_told_m']:.2f}, {row['median_30_told_m']:.2f}",
                      f"{100 * row['inside_7']:.0f}, {100 * row['inside_30']:.0f}",
                      f"{100 * row['inside_told_7']:.0f}, {100 * row['inside_told_30']:.0f}"])
    return study.table(["aid", "goals reached of 30", "believed", "of these wrong (%)", "given up", "way (m)",
                        "longest sol (m)", "error after 7 sols (m, median / 95 %)", "after 30", "heading (deg), 7, 30",
                        "error in the frame of goals (m), 7, 30", "inside its 95 % (%), 7, 30",
                        "in the frame of goals"], lines)


def pairs_table(missions):
    names = list(missions)
    lines = []
    for aid in names[1:]:
        line = [aid]
        for column, _ in PAIRED:
            pairs = zip(missions[names[0]][column], missions[aid][column])
            line.append(study.with_interval(study.signed_mean_interval([b - a for a, b in pairs]), 1))
        lines.append(line)
    return study.table([f"less {names[0]}, mean (95 %)", *[name for _, name in PAIRED]], lines)


def ends_table(missions):
    lines = []
    for aid, columns in missions.items():
        line = [aid]
        line += [f"{100 * ratio(columns, f'sols_{end}', 'sols')[0]:.1f}" for end in SOL_ENDS]
        line += [f"{100 * ratio(columns, f'end_{end}', 'missions')[0]:.0f}" for end in MISSION_ENDS]
        lines.append(line)
    words = lambda ends: [end.replace("_", " ") for end in ends]
    return study.table(["aid", *[f"sols: {word} (%)" for word in words(SOL_ENDS)],
                        *[f"missions: {word} (%)" for word in words(MISSION_ENDS)]], lines)


def energy_table(missions):
    lines = []
    for aid, columns in missions.items():
        sols = sum(columns["sols"])
        per_sol = lambda name: f"{sum(columns[f'{name}_wh']) / sols:.2f}"
        left = study.mean_interval(columns["battery_left_wh"])[0]
        lines.append([aid, per_sol("sun_available"), per_sol("sun"), per_sol("battery"),
                      *[per_sol(sink) for sink in ("drive", "turn", "steer", "scan", "idle", "transmit", "sleep")],
                      f"{left:.0f}"])
    return study.table(["Wh a sol", "sun could give", "from the sun", "from batteries", "driving", "turning", "steering",
                        "scans", "idle", "transmitting", "asleep", "batteries at the end"], lines)


def rows_table(ways_m):
    """`ways_m`: by name of a row, what a run drove."""
    lines = [[words, published, f"{closed:.1f} m", f"{ways_m[name]:.1f} m"]
             for name, _, words, published, closed in ROWS]
    return study.table(["Matthies 1995, sections 2 and 6", "published", "closed form", "runs"], lines)


def draw(path, missions):
    """Shares of the missions whose rover is off by less than so much, after 7 and 30 sols."""
    panels = []
    for sols in (7, 30):
        series = []
        for aid in list(missions)[:4]:
            errors = sorted(missions[aid][f"after_{sols}_position_m"])
            points = [(math.log10(max(error, 1e-3)), (i + 1) / len(errors)) for i, error in enumerate(errors)]
            series.append((aid, [(x, share, share, share) for x, share in points]))
        panels.append((f"after {sols} sols", series))
    study.write_svg(path, panels, "log10 of the position error (m)")


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, 300, "missions")
    parser.set_defaults(seed=4)
    parser.add_argument("--studies", type=Path, default=study.ROOT / "results/studies", help="where files go")
    parser.add_argument("--markdown", type=Path, metavar="PAGE", help="write the tables between the marks of this page")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    missions, made = {}, set()
    for scenario, name in AIDS:
        made.add(study.program(study.run_scenario(args, SCENARIOS / f"{scenario}.json", args.out / scenario, args.set)))
        missions[name] = study.trial_columns(args.out / scenario)
    note = f"\n\n{args.trials} missions each, seed {args.seed}; made by rockyard {' and '.join(sorted(made))}."
    ways_m = {}
    level = argparse.Namespace(**vars(args) | {"trials": 1})
    for name, settings, *_ in ROWS:
        study.run_scenario(level, SCENARIOS / "level.json", args.out / name, settings)
        ways_m[name] = study.trial_columns(args.out / name)["distance_m"][0]
    rows = summary_rows(missions)
    args.studies.mkdir(parents=True, exist_ok=True)
    study.write_csv(args.studies / "missions.csv", rows)
    draw(args.studies / "missions.svg", missions)
    closure = max(row["closure"] for row in rows)
    tables = {"rows": rows_table(ways_m), "missions": missions_table(rows), "pairs": pairs_table(missions),
              "ends": ends_table(missions),
              "energy": energy_table(missions) + f"\n\nSources less sinks, over sinks: {closure:.1g} at most."}
    for name, text in tables.items():
        text += note if name != "rows" else ""
        study.show(args, f"missions_{name}", text)


if __name__ == "__main__":
    main()
