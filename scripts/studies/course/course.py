#!/usr/bin/env python3
"""Courses of sense: what both navigators do on scenarios/courses, against what was expected of them.

Drives every course with GESTALT as its scenario says and with the behaviour controller and the same stereo
cameras (scenarios/gestalt/abundance_behaviour_stereo.json). expected.csv was written down before either had
driven: least share of trials that truly arrive, largest path over the straight way of those, most turning in
place of any trial. A course is passed where the share itself (not its interval) and both extremes keep to that.
Writes courses.csv and courses.md.

    scripts/studies/course/course.py [--courses wall_3 gravel] [--trials 40] [--threads 2]
"""

import json
import math
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

COURSES = study.ROOT / "scenarios/courses"
BEHAVIOUR = study.ROOT / "scenarios/gestalt/abundance_behaviour_stereo.json"
SEED = 20261123  # of the courses' own files


def expectations():
    return study.read_csv(COURSES / "expected.csv")


def read_course(path):
    """A course's groups; where it extends another file than the base of all, with that one's."""
    own = json.loads(path.read_text(encoding="utf-8"))
    base = path.parent / own["extends"]
    if base.name == "viking_lander_2.json":
        return own
    merged = read_course(base)
    for group, value in own.items():
        merged[group] = merged[group] | value if isinstance(merged.get(group), dict) else value
    return merged


def scenario_of(course, navigator, out):
    """The course's own file, or what it says of ground, odometer, goal and referee for the other one."""
    path = COURSES / f"{course}.json"
    if navigator == "gestalt":
        return path
    own = read_course(path)
    scenario = {"extends": str(BEHAVIOUR), "name": f"{own['name']}_behaviour"}
    scenario |= {group: own[group] for group in ("terrain", "perception", "course", "referee") if group in own}
    # The base is of random rocks: the course says what stands in its way.
    scenario["terrain"].setdefault("rocks", {"kind": "none"})
    out.mkdir(parents=True, exist_ok=True)
    composed = out / f"{course}_behaviour.json"
    composed.write_text(json.dumps(scenario, indent=2) + "\n", encoding="utf-8")
    return composed


def course_row(args, expected):
    course, navigator = expected["course"], expected["navigator"]
    print(course, navigator, file=sys.stderr)
    settings = args.set + (args.set_gestalt if navigator == "gestalt" else [])
    run = study.run_scenario(args, scenario_of(course, navigator, args.out), args.out / course / navigator, settings)
    arrived, success = run.ended("goal_reached"), run.true_success
    row = {"course": course, "navigator": navigator, "trials": len(arrived),
           "arrivals_percent": 100.0 * arrived.sum() / len(arrived),
           "arrivals_low": 100.0 * success.low, "arrivals_high": 100.0 * success.high,
           "path_ratio": max(run.counted["path_ratio"][arrived], default=math.nan),
           "turned_deg": max(map(math.degrees, run.counted["turned_in_place_rad"]))}
    row |= {key: float(expected[key]) for key in ("least_arrivals_percent", "largest_path_ratio", "most_turned_deg")}
    row["passed"] = bool(row["arrivals_percent"] >= row["least_arrivals_percent"]
                         and not row["path_ratio"] > row["largest_path_ratio"]
                         and row["turned_deg"] <= row["most_turned_deg"])
    row["other_ends"] = study.ends(run, "goal_reached", none="")
    return row | {"program": study.program(run)}


def table_of(rows):
    ratio = lambda value: "-" if math.isnan(value) else f"{value:.2f}"
    return study.table(
        ["course", "navigator", "truly arrive (%)", "at least", "largest path ratio", "at most",
         "most turned (deg)", "at most", "other ends", "passed"],
        [[row["course"], row["navigator"],
          study.with_interval([row["arrivals_percent"], row["arrivals_low"], row["arrivals_high"]], 0),
          f"{row['least_arrivals_percent']:.0f}", ratio(row["path_ratio"]),
          f"{row['largest_path_ratio']:g}", f"{row['turned_deg']:.0f}",
          f"{row['most_turned_deg']:.0f}", row["other_ends"] or "-", "yes" if row["passed"] else "**no**"]
         for row in rows])


def main():
    parser = study.argument_parser(__doc__)
    every = expectations()
    names = list(dict.fromkeys(row["course"] for row in every))
    parser.add_argument("--courses", nargs="+", choices=names, default=names, metavar="COURSE")
    parser.add_argument("--set-gestalt", action="append", default=[], metavar="PATH=VALUE",
                        help="held where GESTALT drives")
    study.add_page(parser)
    study.add_run_arguments(parser, trials=40, out="courses", seed=SEED)
    args = parser.parse_args()
    rows = [course_row(args, row) for row in every if row["course"] in args.courses]
    study.write_csv(args.out / "courses.csv", rows)
    args.set += args.set_gestalt
    text = "\n\n".join([
        table_of(rows),
        f"{sum(row['passed'] for row in rows)} of {len(rows)} passed. {args.trials} trials each, seed "
        f"{args.seed}, Wilson's 95 % intervals; {study.held(args)}made by "
        f"rockyard {', '.join(sorted({row['program'] for row in rows}))}.\n"])
    (args.out / "courses.md").write_text(text, encoding="utf-8")
    if args.markdown:
        study.write_table([args.markdown], "courses", text.rstrip())
    print(text)


if __name__ == "__main__":
    main()
