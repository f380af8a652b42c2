#!/usr/bin/env python3
"""What the navigators' remedies do on courses of sense: none, each alone, all but each, all.

Remedies are those of scenarios/navigation/remedied.json. GESTALT and the behaviour controller drive as on the page of
courses (course.py), CSOD and CSAD as in scenarios/continuous with the course's ground, goal and referee. Beside the
courses there are the rocks of those scenarios, a zig-zag of five waypoints, a cross-slope of 12 degrees over 15 m, and,
for CSAD, empty slopes of 0 to 12 degrees up, down and across. All arms have 40 m of patience, the same seeds and so the
same noise. A way is that of the trials that truly arrive, with what is left to the goal, over the mean one of a rover
that drives an oracle's route, or over the straight one; differences are in pairs.
Writes remedies.csv and remedies.md.

    scripts/studies/course/remedies.py [--navigators gestalt] [--courses wall_3] [--trials 40] [--threads 2]
"""

import json
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from course import course  # noqa: E402

GESTALT = "navigation.gestalt.remedies"
REMEDIES = {name: f"{GESTALT}.{name}.enabled=true"
            for name in ("cost_to_go", "turn_first", "stop_to_turn", "against_drift")}
REMEDIES["plane"] = "perception.cloud_elevations.frame=plane"
# Those that can do anything: wheels measure no drift, and only splines cannot turn in place.
OF = {"gestalt": ("cost_to_go", "turn_first"), "csod": ("cost_to_go", "turn_first", "against_drift"),
      "csad": ("cost_to_go", "turn_first", "stop_to_turn", "against_drift"), "behaviour": ("plane",)}
PATIENCE = "referee.no_path_distance_m=40"
ROCKS = {"gestalt": study.ROOT / "scenarios/gestalt/viking_lander_2.json"}
ROCKS |= {navigator: study.ROOT / f"scenarios/continuous/{navigator}.json" for navigator in ("csod", "csad")}
WALLS = ("cul_de_sac", "wall_3", "wall_6", "slalom", "ditch")  # an oracle has to plan on these
OPEN = ("goal_behind", "goal_abeam", "zigzag", "across_12")
COURSES = {"gestalt": (*WALLS, *OPEN[:2], "rocks"), "csod": (*WALLS[:4], *OPEN, "rocks"),
           "csad": (*WALLS[:4], *OPEN, "rocks"),
           "behaviour": ("slope_8", "cross_slope", "short_12")}
SAGS = "across_12"  # how far aside of the straight way rovers come there
EMPTY = {"arena": {"kind": "open", "x_min_m": -8, "length_m": 32, "width_m": 16}, "rocks": {"kind": "none"}}
SAND = {"dead_reckoning": {"distance_scale": 0.995}}  # the odometer of the courses
OWN = {"zigzag": {"terrain": EMPTY, "course": {"waypoints": {"x_m": [3, 6, 9, 12], "y_m": [1.5, -1.5, 1.5, -1.5]},
                                               "goal_x_m": 15}},
       "across_12": {"terrain": EMPTY | {"ground": {"slope_deg": 12, "slope_direction_deg": 90}}, "perception": SAND,
                     "course": {"goal_x_m": 15}}}
OWN["short_12"] = OWN["across_12"] | {"course": {"goal_x_m": 6}}  # for odometers that see no drift
WAYS = {"goal_behind": 6.0, "goal_abeam": 6.0, "zigzag": 2 * (1.5**2 + 3**2)**0.5 + 3 * 18**0.5, "across_12": 15.0,
        "slope_8": 6.0, "cross_slope": 6.0, "short_12": 6.0}  # straight ones
SLOPES = [(slope, direction) for slope in (0, 3, 6, 9, 12) for direction in (0, 90, 180, 270)]
CIRCLES = 1.25  # times the straight way: no drive on an empty slope has a reason for it
SLOPE_ARMS = ("papers", "stop_to_turn", "all")


def arms_of(navigator):
    """Names of arms and their remedies."""
    own = OF[navigator]
    arms = {"papers": ()} | {name: (name,) for name in own if len(own) > 1}
    arms |= {f"all but {name}": tuple(other for other in own if other != name) for name in own if len(own) > 2}
    return arms | {"all": own}


def scenario_of(name, navigator, out):
    if name == "rocks":
        return ROCKS[navigator]
    if name not in OWN and navigator in ("gestalt", "behaviour"):
        return course.scenario_of(name, navigator, out)
    base = course.BEHAVIOUR if navigator == "behaviour" else study.ROOT / f"scenarios/continuous/{navigator}.json"
    own = OWN.get(name) or course.read_course(course.COURSES / f"{name}.json")
    scenario = {"extends": str(base), "name": f"{name}_{navigator}"}
    scenario |= {group: own[group] for group in ("terrain", "perception", "course", "referee") if group in own}
    scenario["terrain"].setdefault("rocks", {"kind": "none"})
    out.mkdir(parents=True, exist_ok=True)
    composed = out / f"{name}_{navigator}.json"
    composed.write_text(json.dumps(scenario, indent=2) + "\n", encoding="utf-8")
    return composed


def drive(args, name, navigator, arm, remedies):
    print(name, navigator, arm, file=sys.stderr)
    folder = args.out / name / navigator / arm.replace(" ", "_")
    return study.run_scenario(args, scenario_of(name, navigator, args.out), folder,
                              [PATIENCE, *(REMEDIES[remedy] for remedy in remedies), *args.set])


def oracle_way(args, name):
    """Mean way of a rover that is told the shortest one, m."""
    if name in WAYS or name in ("ditch", "rocks"):  # a ditch is no rock, and no oracle sees it
        return WAYS.get(name)
    run = study.run_scenario(args, course.COURSES / f"{name}.json", args.out / name / "oracle",
                             [PATIENCE, "navigation.navigator=route", "course.route_map.source=oracle"])
    return way_of(run).mean()


def way_of(run):
    """The way of each trial and what is left to the goal, m: rovers stop at different distances from it."""
    return run.counted["true_distance_m"] + run.counted["true_goal_distance_m"]


def pair(row, prefix, first, second):
    """Adds the difference of true success, in points, and of the way where both arrive, m, of two runs."""
    success, means = study.compare(first, second)
    row |= zip((f"{prefix}_points", f"{prefix}_low", f"{prefix}_high", f"{prefix}_p"), success["true"])
    way = means.get(("arrived", "true_distance_m"), {"n": 0})
    for key, name in (("n", "n"), ("difference", "m"), ("low", "m_low"), ("high", "m_high")):
        value = way.get(key)
        row[f"{prefix}_{name}"] = float("nan") if value is None else value


def course_rows(args, name, navigator):
    runs = {arm: drive(args, name, navigator, arm, remedies) for arm, remedies in arms_of(navigator).items()}
    oracle_m = oracle_way(args, name)
    rows = []
    for arm, run in runs.items():
        arrived = run.ended("goal_reached")
        ways = way_of(run)[arrived]
        way_m = ways.mean() if arrived.any() else float("nan")
        row = {"course": name, "navigator": navigator, "arm": arm, "trials": len(arrived)}
        row |= zip(("arrive", "arrive_low", "arrive_high"), (100.0 * part for part in run.true_success))
        row |= {"way_m": way_m, "oracle_m": oracle_m or float("nan"),
                "way_ratio": way_m / oracle_m if oracle_m else float("nan"),
                "turned_deg": 57.2957795 * run.counted["turned_in_place_rad"].mean()}
        row["aside_m"] = float("nan")
        if name == SAGS:
            aside_m = [abs(run.trial(int(trial)).trace.position_m[:, 1]).max() for trial in run.counted["trial"]]
            row["aside_m"] = sum(aside_m) / len(aside_m)
        pair(row, "papers", runs["papers"], run)
        pair(row, "all", runs["all"], run)
        row["other_ends"] = study.ends(run, "goal_reached", none="")
        rows.append(row | {"program": study.program(run)})
    return rows


def orbit_rows(args):
    """Of CSAD on empty slopes: how many never arrive, and how far those drive that do."""
    rows = []
    for arm in SLOPE_ARMS:
        remedies = arms_of("csad")[arm]
        runs = []
        for slope, direction in SLOPES:
            print("slope", slope, direction, arm, file=sys.stderr)
            folder = args.out / "slopes" / f"{slope}_{direction}" / arm
            settings = ["terrain.rocks.kind=none", f"terrain.ground.slope_deg={slope}", PATIENCE,
                        f"terrain.ground.slope_direction_deg={direction}", *(REMEDIES[remedy] for remedy in remedies)]
            slopes = type(args)(**vars(args) | {"trials": args.slope_trials})
            runs.append(study.run_scenario(slopes, study.ROOT / "scenarios/continuous/csad.json", folder, settings))
        ended = [run.ended(*study.ARRIVED) for run in runs]
        rate = study.rates.rate(int(sum((~arrived).sum() for arrived in ended)), sum(map(len, ended)))
        circles = study.rates.rate(int(sum((run.counted["path_ratio"] > CIRCLES).sum() for run in runs)), rate.trials)
        rows.append({"arm": arm, "drives": rate.trials, "never arrive": rate.count,
                     f"way above {CIRCLES:g}": circles.count,
                     "of all (%)": study.with_interval([100.0 * part for part in circles], 2),
                     "largest way (m)": f"{max(run.counted['true_distance_m'].max() for run in runs):.1f}"})
    return rows


def ratio(row):
    value = row["way_ratio"] if row["way_ratio"] == row["way_ratio"] else row["way_m"]
    return "-" if value != value else f"{value:.2f}" + ("" if row["way_ratio"] == row["way_ratio"] else " m")


def before_and_after(rows):
    cells = {(row["course"], row["navigator"], row["arm"]): row for row in rows}
    lines = []
    for (name, navigator, arm), after in cells.items():
        if arm != "all":
            continue
        before = cells[name, navigator, "papers"]
        difference = "-" if not after["papers_n"] >= 5 else study.with_interval(
            [after["papers_m"], after["papers_m_low"], after["papers_m_high"]], 1)
        lines.append([navigator, name, *(text for row in (before, after) for text in (
            study.interval_of(row, "arrive", 0), ratio(row))),
            f"{after['papers_points']:+.0f} ({after['papers_low']:+.0f}..{after['papers_high']:+.0f})", difference])
    return study.table(["navigator", "course", "papers: arrive (%)", "way over the oracle's", "remedied: arrive (%)",
                        "way over the oracle's", "difference (points)", "way where both arrive (m)"], lines)


def aside(rows):
    """How far aside of the straight way rovers come on a cross-slope."""
    sags = [row for row in rows if row["course"] == SAGS and row["navigator"] in ("csod", "csad")]
    arms = list(dict.fromkeys(row["arm"] for row in sags))
    cells = {(row["navigator"], row["arm"]): f"{row['aside_m']:.2f}" for row in sags}
    lines = [[navigator, *(cells.get((navigator, arm), "-") for arm in arms)]
             for navigator in dict.fromkeys(navigator for navigator, arm in cells)]
    return study.table([f"{SAGS}: largest distance from the straight way, mean (m)"] + arms, lines)


def each(rows, navigator):
    arms = list(arms_of(navigator))
    cells = {(row["course"], row["arm"]): row for row in rows if row["navigator"] == navigator}
    names = list(dict.fromkeys(name for name, arm in cells))
    return study.table([f"{navigator}: arrive (%), way"] + arms,
                       [[name, *(f"{cells[name, arm]['arrive']:.0f}, {ratio(cells[name, arm])}" for arm in arms)]
                        for name in names])


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--navigators", nargs="+", choices=list(OF), default=list(OF))
    parser.add_argument("--courses", nargs="+", metavar="COURSE", help="only these")
    parser.add_argument("--slope-trials", type=int, default=50, help="trials of a slope and direction (50)")
    study.add_page(parser)
    study.add_run_arguments(parser, trials=40, out="remedies", seed=course.SEED)
    args = parser.parse_args()
    rows = [row for navigator in args.navigators for name in COURSES[navigator]
            if not args.courses or name in args.courses for row in course_rows(args, name, navigator)]
    study.write_csv(args.out / "remedies.csv", rows)
    parts = [before_and_after(rows)]
    parts += [each(rows, navigator) for navigator in args.navigators if len(OF[navigator]) > 1]
    parts += [aside(rows)] if any(row["course"] == SAGS for row in rows) else []
    if "csad" in args.navigators and not args.courses:
        orbits = orbit_rows(args)
        parts += ["CSAD on empty slopes of 0 to 12 degrees, up, down and across:",
                  study.table(list(orbits[0]), [list(map(str, row.values())) for row in orbits])]
    parts.append(f"{args.trials} trials an arm, seed {args.seed}, 95 % intervals, differences in pairs; {study.held(args)}"
                 f"made by rockyard {', '.join(sorted({row['program'] for row in rows}))}.\n")
    text = "\n\n".join(parts)
    (args.out / "remedies.md").write_text(text, encoding="utf-8")
    if args.markdown:
        study.write_table([args.markdown], "remedies", text.rstrip())
    print(text)


if __name__ == "__main__":
    main()
