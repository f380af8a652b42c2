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
from itertools import product
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/localization.json"
# Half a vehicle width, a vehicle length (Matthies 1995, sections 4 and 8), and two of these.
RADII_M = (0.24, 0.6, 1.2)
MAIN_M = 0.6
FIRST = "dead reckoning"
TERRAINS = {0.00415: "nominal", 0.013: "Viking Lander 2"}
DRAWN = (FIRST, "lander every 2.5 m", "sun")  # as many as a legend has room for
KEY = ("terrain", "distance", "aids")


def named(cells):
    """Trials by (terrain, distance, aid)."""
    return {(TERRAINS[k_per_m2], *others): trials for (k_per_m2, *others), trials in cells.items()}


def levels_of(cells, place):
    return list(dict.fromkeys(key[place] for key in cells))


def reach_rows(cells):
    rows = []
    for (key, trials), radius_m in product(cells.items(), RADII_M):
        count = int((trials.true_goal_distance_m <= radius_m).sum())
        low, high = rates.wilson_interval(count, len(trials))
        rows.append(dict(zip(KEY, key)) | {"radius_m": radius_m, "trials": len(trials), "within": count,
                                           "share": count / len(trials), "low": low, "high": high})
    return rows


def pair_rows(cells):
    rows = []
    for ((*place, aid), trials), radius_m in product(cells.items(), RADII_M):
        if aid != FIRST:
            first, second = (part.true_goal_distance_m.to_numpy() <= radius_m for part in (cells[*place, FIRST], trials))
            lost, won = int((first & ~second).sum()), int((second & ~first).sum())
            rows.append(dict(zip(KEY, (*place, aid))) | {
                "radius_m": radius_m, "lost": lost, "won": won, "points": 100.0 * (won - lost) / len(trials),
                "p": rates.mcnemar(lost, won)})
    for row, p in zip(rows, rates.holm(row["p"] for row in rows)):
        row["p_holm"] = p
    return rows


def belief_rows(cells):
    rows = []
    for (key, trials), which in product(cells.items(), ("all", "arrived")):
        known = trials[trials.pose_nees.notna() & (trials.outcome.isin(study.ARRIVED) | (which == "all"))]
        count = len(known)
        if not count:
            continue
        inside = int(known.inside_95.sum())
        low, high = rates.wilson_interval(inside, count)
        rms = lambda name: math.sqrt(sum(value ** 2 for value in known[name]) / count)
        mean = lambda name: sum(known[name]) / count
        rows.append(dict(zip(KEY, key)) | {
            "trials": which, "count": count, "inside_95": inside / count, "low": low, "high": high,
            "median_nees": sorted(known.pose_nees)[count // 2], "error_m": rms("position_error_m"),
            "believed_m": rms("believed_position_sd_m"), "heading_deg": rms("heading_error_deg"),
            "used": mean("aids_used"), "gated_out": mean("aids_gated_out"), "in_doubt": mean("aids_in_doubt")})
    return rows


def by_key(rows, *names):
    return {tuple(row[name] for name in names): row for row in rows}


def crossed(cells, title, text, aids):
    """A table of aids by distances, terrain by terrain; `text` of a (terrain, distance, aid)."""
    distances = levels_of(cells, 1)
    return study.table([title, *distances], [
        line for terrain in levels_of(cells, 0)
        for line in ([f"**{terrain}**"] + [""] * len(distances),
                     *([aid, *(text(terrain, distance, aid) for distance in distances)] for aid in aids))])


def within(row, name="share"):
    return study.with_interval((row[name], row["low"], row["high"]), 0, 100.0)


def reach_table(cells, rows):
    found = by_key(rows, *KEY, "radius_m")
    return crossed(cells, f"% within {MAIN_M:g} m of the goal", lambda *key: within(found[*key, MAIN_M]), levels_of(cells, 2))


def pairs_table(cells, rows):
    found = by_key(rows, *KEY, "radius_m")

    def text(*key):
        row = found[*key, MAIN_M]
        return f"{row['points']:+.0f}{'*' if row['p_holm'] < 0.05 else ''}"
    return crossed(cells, f"points within {MAIN_M:g} m, against {FIRST}", text,
                   [aid for aid in levels_of(cells, 2) if aid != FIRST])


def belief_table(cells, rows):
    found = by_key(rows, *KEY, "trials")
    lines = []
    for key in cells:
        if (*key, "all") not in found or key[1] not in ("10 m", "40 m"):
            continue
        every = found[*key, "all"]
        arrived = found.get((*key, "arrived"))  # of a hard course none may
        lines.append([*key, within(every, "inside_95"), within(arrived, "inside_95") if arrived else "-",
                      f"{arrived['median_nees']:.1f}" if arrived else "-", f"{every['error_m']:.2f}",
                      f"{every['believed_m']:.2f}", f"{every['heading_deg']:.1f}",
                      f"{every['used']:.1f}", f"{every['gated_out']:.1f}", f"{every['in_doubt']:.2f}"])
    return study.table([*KEY, "inside 95 % (%)", "of arrivals", "median NEES", "rms error (m)", "believed (m)",
                        "heading (deg)", "used", "turned away", "in doubt"], lines)


def day_table(cells, rows):
    found = by_key(rows, *KEY, "radius_m")
    wanted = list(product(RADII_M, (0.5, 0.95)))

    def longest(terrain, aid, radius_m, share):
        reached = "none"
        for distance in levels_of(cells, 1):
            if found[terrain, distance, aid, radius_m]["share"] < share:
                break
            reached = distance
        return reached
    header = [f"{100 * share:g} % within {radius_m:g} m" for radius_m, share in wanted]
    return study.table(["terrain", "aids", *header], [
        [*pair, *(longest(*pair, *each) for each in wanted)] for pair in product(levels_of(cells, 0), levels_of(cells, 2))])


def draw(path, cells, rows):
    found = by_key(rows, *KEY, "radius_m")

    def points(terrain, aid, radius_m):
        for distance in levels_of(cells, 1):
            row = found[terrain, distance, aid, radius_m]
            yield float(distance.split()[0]), row["share"], row["low"], row["high"]
    study.write_svg(path, [
        (f"{terrain}: within {radius_m:g} m", [(aid, list(points(terrain, aid, radius_m))) for aid in DRAWN])
        for terrain, radius_m in product(levels_of(cells, 0), RADII_M[:2])], "distance to the goal (m)")


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "localization")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, ("k_per_m2", "distance_m", "aids"))
    cells = named(cells)
    reach, pairs, belief = reach_rows(cells), pair_rows(cells), belief_rows(cells)
    for name, rows in (("localization", reach), ("localization_pairs", pairs), ("localization_belief", belief)):
        study.write_csv(args.out / f"{name}.csv", rows)
    draw(args.out / "localization.svg", cells, reach)
    study.show(args, {"reach": reach_table(cells, reach), "pairs": pairs_table(cells, pairs),
                      "belief": belief_table(cells, belief), "day": day_table(cells, reach)}, note)


if __name__ == "__main__":
    main()
