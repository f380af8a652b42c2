#!/usr/bin/env python3
"""Where drives end by what tells the rover where it is: scenarios/sweeps/localization.json, counted.

Runs the sweep, or goes on with it, and reads every trial of its store. Writes localization.csv (one row a
cell and radius), localization_pairs.csv (each aid against dead reckoning on the same rocks and noise),
localization.md and localization.svg.

    reach    share of the trials that end within so far of the true place of the goal
    pairs    what each aid changes of it, in points: McNemar, exact, all tests one family (Holm)
    belief   how well the filter knows its own error at the end of the drive
    day      the longest of the distances at which half of the trials, or 95 %, still end there

    scripts/studies/localization/localization.py [--threads 2] [--out FOLDER] [--markdown results/localization.md]
"""

import math
import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/localization.json"
# Half a vehicle width, a vehicle length (Matthies 1995, sections 4 and 8), and two of these.
RADII_M = (0.24, 0.6, 1.2)
MAIN_M = 0.6
FIRST = "dead reckoning"
TERRAINS = {"0.00415": "nominal", "0.013": "Viking Lander 2"}
DRAWN = (FIRST, "lander every 2.5 m", "sun")  # as many as a legend has room for
COLUMNS = ("true_goal_distance_m", "position_error_m", "heading_error_deg", "pose_nees", "inside_95",
           "believed_position_sd_m", "aids_used", "aids_gated_out", "aids_in_doubt", "scrapes")
ARRIVED = ("goal_reached", "false_goal")


def read_cells(folder):
    """Trials by (terrain, distance, aid): lists of rows in the order of trials."""
    cells = defaultdict(list)
    for levels, _, row in study.stored_trials(folder, COLUMNS):
        cells[TERRAINS[levels["k_per_m2"]], levels["distance_m"], levels["aids"]].append(row)
    return cells


def count_within(rows, radius_m):
    return sum(row["true_goal_distance_m"] <= radius_m for row in rows)


def levels_of(cells, place):
    return list(dict.fromkeys(key[place] for key in cells))


def reach_rows(cells):
    rows = []
    for (terrain, distance, aid), trials in cells.items():
        for radius_m in RADII_M:
            count = count_within(trials, radius_m)
            low, high = study.wilson_interval(count, len(trials))
            rows.append({"terrain": terrain, "distance": distance, "aids": aid, "radius_m": radius_m,
                         "trials": len(trials), "within": count, "share": count / len(trials),
                         "low": low, "high": high})
    return rows


def pair_rows(cells):
    rows = []
    for (terrain, distance, aid), trials in cells.items():
        if aid == FIRST:
            continue
        for radius_m in RADII_M:
            first = [row["true_goal_distance_m"] <= radius_m for row in cells[terrain, distance, FIRST]]
            second = [row["true_goal_distance_m"] <= radius_m for row in trials]
            lost = sum(a and not b for a, b in zip(first, second))
            won = sum(b and not a for a, b in zip(first, second))
            rows.append({"terrain": terrain, "distance": distance, "aids": aid, "radius_m": radius_m,
                         "lost": lost, "won": won, "points": 100.0 * (won - lost) / len(trials),
                         "p": study.mcnemar(lost, won)})
    for row, p in zip(rows, study.holm([row["p"] for row in rows])):
        row["p_holm"] = p
    return rows


def belief_rows(cells):
    rows = []
    for (terrain, distance, aid), trials in cells.items():
        for which, chosen in (("all", trials),
                              ("arrived", [row for row in trials if row["outcome"] in ARRIVED])):
            known = [row for row in chosen if not math.isnan(row["pose_nees"])]
            if not known:
                continue
            inside = sum(row["inside_95"] for row in known)
            low, high = study.wilson_interval(inside, len(known))
            middle = sorted(row["pose_nees"] for row in known)[len(known) // 2]
            rms = lambda name: math.sqrt(sum(row[name] ** 2 for row in known) / len(known))
            rows.append({"terrain": terrain, "distance": distance, "aids": aid, "trials": which,
                         "count": len(known), "inside_95": inside / len(known), "low": low,
                         "high": high, "median_nees": middle, "error_m": rms("position_error_m"),
                         "believed_m": rms("believed_position_sd_m"),
                         "heading_deg": rms("heading_error_deg"),
                         "used": sum(row["aids_used"] for row in known) / len(known),
                         "gated_out": sum(row["aids_gated_out"] for row in known) / len(known),
                         "in_doubt": sum(row["aids_in_doubt"] for row in known) / len(known)})
    return rows


def by_key(rows, *names):
    return {tuple(row[name] for name in names): row for row in rows}


def reach_table(cells, rows):
    found = by_key(rows, "terrain", "distance", "aids", "radius_m")
    lines = []
    for terrain in levels_of(cells, 0):
        lines.append([f"**{terrain}**"] + [""] * len(levels_of(cells, 1)))
        for aid in levels_of(cells, 2):
            line = [aid]
            for distance in levels_of(cells, 1):
                row = found[terrain, distance, aid, MAIN_M]
                line.append(study.with_interval((row["share"], row["low"], row["high"]), 0, 100.0))
            lines.append(line)
    return study.table([f"% within {MAIN_M:g} m of the goal", *levels_of(cells, 1)], lines)


def pairs_table(cells, rows):
    found = by_key(rows, "terrain", "distance", "aids", "radius_m")
    lines = []
    for terrain in levels_of(cells, 0):
        lines.append([f"**{terrain}**"] + [""] * len(levels_of(cells, 1)))
        for aid in levels_of(cells, 2):
            if aid == FIRST:
                continue
            line = [aid]
            for distance in levels_of(cells, 1):
                row = found[terrain, distance, aid, MAIN_M]
                mark = "*" if row["p_holm"] < 0.05 else ""
                line.append(f"{row['points']:+.0f}{mark}")
            lines.append(line)
    return study.table([f"points within {MAIN_M:g} m, against {FIRST}", *levels_of(cells, 1)], lines)


def belief_table(cells, rows):
    found = by_key(rows, "terrain", "distance", "aids", "trials")
    lines = []
    for terrain, distance, aid in cells:
        if (terrain, distance, aid, "all") not in found or distance not in ("10 m", "40 m"):
            continue
        every = found[terrain, distance, aid, "all"]
        arrived = found.get((terrain, distance, aid, "arrived"))  # of a hard course none may
        inside = lambda row: study.with_interval((row["inside_95"], row["low"], row["high"]), 0, 100.0)
        lines.append([terrain, distance, aid, inside(every), inside(arrived) if arrived else "-",
                      f"{arrived['median_nees']:.1f}" if arrived else "-", f"{every['error_m']:.2f}",
                      f"{every['believed_m']:.2f}", f"{every['heading_deg']:.1f}",
                      f"{every['used']:.1f}", f"{every['gated_out']:.1f}", f"{every['in_doubt']:.2f}"])
    return study.table(["terrain", "distance", "aids", "inside 95 % (%)", "of arrivals",
                        "median NEES", "rms error (m)", "believed (m)", "heading (deg)", "used",
                        "turned away", "in doubt"], lines)


def day_table(cells, rows):
    found = by_key(rows, "terrain", "distance", "aids", "radius_m")
    lines = []
    for terrain in levels_of(cells, 0):
        for aid in levels_of(cells, 2):
            line = [terrain, aid]
            for radius_m in RADII_M:
                for share in (0.5, 0.95):
                    reached = "none"
                    for distance in levels_of(cells, 1):
                        if found[terrain, distance, aid, radius_m]["share"] < share:
                            break
                        reached = distance
                    line.append(reached)
            lines.append(line)
    header = [f"{100 * share:g} % within {radius_m:g} m"
              for radius_m in RADII_M for share in (0.5, 0.95)]
    return study.table(["terrain", "aids", *header], lines)


def draw(path, cells, rows):
    found = by_key(rows, "terrain", "distance", "aids", "radius_m")
    panels = []
    for terrain in levels_of(cells, 0):
        for radius_m in RADII_M[:2]:
            series = []
            for aid in DRAWN:
                points = []
                for distance in levels_of(cells, 1):
                    row = found[terrain, distance, aid, radius_m]
                    points.append((float(distance.split()[0]), row["share"], row["low"], row["high"]))
                series.append((aid, points))
            panels.append((f"{terrain}: within {radius_m:g} m", series))
    study.write_svg(path, panels, "distance to the goal (m)")


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "localization", "write the tables between the marks of this page")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, read_cells)
    reach, pairs, belief = reach_rows(cells), pair_rows(cells), belief_rows(cells)
    args.out.mkdir(parents=True, exist_ok=True)
    study.write_csv(args.out / "localization.csv", reach)
    study.write_csv(args.out / "localization_pairs.csv", pairs)
    study.write_csv(args.out / "localization_belief.csv", belief)
    draw(args.out / "localization.svg", cells, reach)
    tables = {"reach": reach_table(cells, reach), "pairs": pairs_table(cells, pairs),
              "belief": belief_table(cells, belief), "day": day_table(cells, reach)}
    for name, text in tables.items():
        study.show(args, name, text + note)


if __name__ == "__main__":
    main()
