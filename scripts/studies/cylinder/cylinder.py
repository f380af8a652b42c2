#!/usr/bin/env python3
"""Where the coloured cylinder is seen from the lander, beside what Matthies 1995, section 5, says of it.

Runs scenarios/cylinder/published.json (five distances, all orientations, ten measurements at each), green.json
(a green panel for the orange one) and views.json (a rover before the lander's mast: any orientation, sun from any
side, clutter), or takes the runs that are there, and prints tables: bias and spread of orientation and distance
against the one-pixel limits of appendix A.2, statements of the text with a verdict, and of the views what was
found, how well, and how many poses are wrong. --markdown writes them between <!-- begin cylinder_NAME --> and
<!-- end cylinder_NAME --> of a page; --studies writes the cells as CSV. Delete the runs after a change of the code.

    scripts/studies/cylinder/cylinder.py [--seed 1] [--tables bias,limits,verdicts,green,views,without] [--markdown PAGE]
"""

import json
import math
import sys
from pathlib import Path
from statistics import median

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates, ry  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/cylinder"
FINDERS = {"published": "published", "robust": "ours"}
MISSES = ("nothing", "clipped", "too_few_regions", "unlike_order", "unlike_eyes", "swapped_eyes", "two_cylinders",
          "not_a_cylinder", "ambiguous")
TABLES = ("bias", "limits", "verdicts", "green", "views", "without")
RUN_OF = {"bias": "published", "limits": "published", "verdicts": "published", "green": "green",
          "views": "views", "without": "views_without"}
# Section 5: a cylinder of 19.2 cm, 512 columns of 29.33 deg, a baseline of 12 cm, fronts 7.6 cm before the origin.
RADIUS_M, COLUMNS, FIELD_DEG, BASELINE_M, FRONT_M = 0.096, 512, 29.33, 0.12, 0.076
PUBLISHED_M = (0.914, 1.829, 4.572, 10.058)
BAD_DEG = (-180.0, -90.0)  # the range that the text excepts at 10 m
# Printed in section 5: distance from the fronts, finest turn in degrees, relative distance by stereo.
PRINTED_LIMITS = ((0.838, 0.50, 0.0071), (1.753, 1.06, 0.015), (4.496, 2.70, 0.038), (9.982, 6.09, 0.085))


def tangent():
    return math.tan(math.radians(FIELD_DEG / 2))


def finest_turn_deg(d_m):
    """Equation 20 in degrees."""
    return math.degrees(2.0 / COLUMNS * (d_m / RADIUS_M - RADIUS_M / d_m) * tangent())


def stereo_step(d_m):
    """Equation 23 without its sign."""
    return 2.0 * d_m * tangent() / (COLUMNS * BASELINE_M)


class Sums:
    """Columns of some runs, added up, of one finder."""

    def __init__(self, rows, finder):
        self.rows, self.finder = rows, finder

    def total(self, column):
        return self.rows[column].sum()

    def __getitem__(self, column):
        return self.total(f"{self.finder}_{column}")

    @property
    def measurements(self):
        return self.total("measurements")

    def mean(self, name, suffix="", of="found"):
        return self[f"{name}_bias{suffix}"] / self[of] if self[of] else math.nan

    def spread(self, name, suffix="", of="found"):
        """The standard deviation about the mean, of a sample."""
        count = self[of]
        if count < 2:
            return math.nan
        square = self[f"{name}_error{suffix}"] / count - self.mean(name, suffix, of) ** 2
        return math.sqrt(max(square, 0.0) * count / (count - 1))


def groups(rows, *factors):
    return dict(sorted(study.cells_of(rows, factors).items()))


def is_excepted(distance_m, orientation_deg):
    """The text's exception: from -180 to -90 deg, 180 being -180, at 10 m and beyond."""
    turned = -180.0 if orientation_deg == 180.0 else orientation_deg
    return distance_m > 10.0 and BAD_DEG[0] <= turned <= BAD_DEG[1]


def cells_of(rows, finder):
    """(distance, orientation): Sums, where anything was found."""
    cells = {key: Sums(part, finder) for key, part in groups(rows, "distance_m", "orientation_deg").items()}
    return {key: cell for key, cell in cells.items() if cell["found"] > 0}


def share(count, total):
    """Count of a total with the exact 95 % interval of its share in per cent."""
    low, high = rates.exact_interval(count, total)
    return f"{count:.0f} of {total:.0f} ({100 * low:.1f}..{100 * high:.1f} %)"


def bias_table(rows):
    """Means at each orientation: how many lie within 5 deg and 5 %, and the range that the text excepts apart."""
    lines = []
    for finder, called in FINDERS.items():
        cells = cells_of(rows, finder)
        for (distance,), part in groups(rows, "distance_m").items():
            for excepted in (False, True):
                those = [c for (d, t), c in cells.items() if d == distance and is_excepted(d, t) == excepted]
                everything = Sums(part[[is_excepted(distance, t) == excepted for t in part.orientation_deg]], finder)
                if everything.measurements == 0:
                    continue
                turns = [c.mean("orientation", "_deg") for c in those]
                stereo = [c.mean("stereo") for c in those]
                lines.append([called, f"{distance:g}", "-180 to -90" if excepted else "all others" if
                              distance > 10 else "all", f"{everything['found']:.0f} of {everything.measurements:.0f}",
                              f"{sum(abs(t) <= 5 for t in turns)} of {len(turns)}",
                              f"{median(turns):+.1f} ({min(turns):+.1f} to {max(turns):+.1f})" if turns else "-",
                              f"{sum(abs(s) <= 0.05 for s in stereo)} of {len(stereo)}",
                              f"{100 * median(stereo):+.1f} ({100 * min(stereo):+.1f} to {100 * max(stereo):+.1f})"
                              if stereo else "-", f"{everything['wrong']:.0f}"])
    return study.table(["finder", "distance, m", "orientations, deg", "found", "means within 5 deg",
                        "mean error, deg: median (range)", "means within 5 %",
                        "mean error of stereo, %: median (range)", "wrong poses"], lines)


def limits_table(rows):
    """Spreads beside one pixel: printed, by equations 20 and 23, and measured."""
    lines = []
    for (d_m, turn, step), distance in zip(PRINTED_LIMITS, PUBLISHED_M):
        line = [f"{d_m:g}", f"{turn:.2f} / {finest_turn_deg(d_m):.3f}", f"{step:g} / {stereo_step(d_m):.4f}"]
        for finder in FINDERS:
            cells = [c for (d, _), c in cells_of(rows, finder).items() if d == distance]
            turns = [c.spread("orientation", "_deg") for c in cells if c["found"] > 1]
            stereo = [c.spread("stereo") for c in cells if c["found"] > 1]
            line += [f"{median(turns):.2f} ({max(turns):.2f})" if turns else "-",
                     f"{median(stereo):.4f} ({max(stereo):.4f})" if stereo else "-"]
        lines.append(line)
    return study.table(["d, m", "one pixel, deg: printed / eq. 20", "one pixel, share: printed / eq. 23",
                        "published finder, deg: median (most)", "the same, share", "ours, deg", "ours, share"], lines)


def verdict(holds):
    return "agrees" if holds else "differs"


def measured_verdict(holds, *values):
    """Undecided where a value of the measurements is missing."""
    return "undecided" if any(math.isnan(value) for value in values) else verdict(holds)


def verdict_lines(rows):
    """Statements of section 5 and app. A: where, what is printed, what was found, verdict."""
    cells = cells_of(rows, "published")
    fair = [(d, c) for (d, t), c in cells.items() if d in PUBLISHED_M and not is_excepted(d, t)]
    bad_10 = [c for (d, t), c in cells.items() if d == 10.058 and is_excepted(d, t)]
    any_15 = (rows.distance_m == 15.0).any()
    bad_15 = [c for (d, t), c in cells.items() if d == 15.0 and is_excepted(d, t)]
    good_10 = [c for d, c in fair if d == 10.058]

    def turn(cell):
        return abs(cell.mean("orientation", "_deg"))

    def part(those, test):
        return sum(map(test, those)) / len(those) if those else math.nan

    turns = part([c for _, c in fair], lambda c: turn(c) <= 5.0)
    stereo = part([c for _, c in fair], lambda c: abs(c.mean("stereo")) <= 0.05)
    short = part([c for _, c in fair], lambda c: c.mean("stereo") < 0.0)
    spread = part([(d, c) for d, c in fair if c["found"] > 1],
                  lambda p: p[1].spread("orientation", "_deg") <= 2 * finest_turn_deg(p[0] - FRONT_M))
    spread_d = part([(d, c) for d, c in fair if c["found"] > 1],
                    lambda p: p[1].spread("stereo") <= 2 * stereo_step(p[0] - FRONT_M))
    worse = median([turn(c) for c in bad_10]) if bad_10 else math.nan
    rest = median([turn(c) for c in good_10]) if good_10 else math.nan
    usable = part(bad_15, lambda c: turn(c) <= 5.0 and c["wrong"] == 0)
    yield ("sec. 5, figs. 9, 10", "mean errors of orientation typically within 5 deg (but -180 to -90 deg at 10 m)",
           f"{100 * turns:.0f} % of orientations", measured_verdict(turns > 0.5, turns))
    yield ("sec. 5, fig. 10", "mean errors of distance within 5 %", f"{100 * stereo:.0f} % of orientations",
           measured_verdict(stereo > 0.95, stereo))
    yield ("sec. 5", "distances usually short", f"{100 * short:.0f} % of orientations",
           measured_verdict(short > 0.5, short))
    yield ("sec. 5, figs. 11, 12", "standard deviations usually below one or two pixels: orientation",
           f"below two at {100 * spread:.0f} %", measured_verdict(spread > 0.5, spread))
    yield ("sec. 5, figs. 11, 12", "the same: distance", f"below two at {100 * spread_d:.0f} %",
           measured_verdict(spread_d > 0.5, spread_d))
    yield ("sec. 5", "at 10 m from -180 to -90 deg errors stand out",
           f"median {worse:.1f} deg, elsewhere {rest:.1f} deg", measured_verdict(worse > 2 * rest, worse, rest))
    yield ("sec. 5", "at 15 m from -180 to -90 deg no consistent result",
           f"{len(bad_15)} orientations with a result, {100 * usable:.0f} % of them within 5 deg and none wrong",
           verdict(not bad_15 or usable < 0.1) if any_15 else "undecided")


def exact_lines():
    """Numbers that follow from the equations alone."""
    d_m = COLUMNS * 0.1 / (17 * math.tan(math.radians(15)))
    yield "app. A.1.2", "m = 17: 11.24 m", f"{d_m:.3f} m", verdict(round(d_m, 2) == 11.24)
    finest = math.degrees(2 / 17)
    yield "app. A.2.1", "m = 17: 6.7 deg", f"{finest:.3f} deg", verdict(round(finest, 1) == 6.7)
    yield ("app. A.2.1", "m = 17: 9.5 deg", f"{math.sqrt(2) * finest:.3f} deg",
           verdict(round(math.sqrt(2) * finest, 1) == 9.5))
    yield "app. A.2.2", "one pixel: 0.66 m", f"{d_m / 17:.3f} m", verdict(round(d_m / 17, 2) == 0.66)
    yield ("app. A.2.2", "about 5.8 %", f"{100 / 17:.2f} %", "misprint: 5.9 when rounded")
    for d_front, turn, step in PRINTED_LIMITS:
        holds = abs(finest_turn_deg(d_front) - turn) <= 0.011 and abs(stereo_step(d_front) / step - 1) <= 0.02
        yield ("sec. 5, table", f"{d_front:g} m: {turn:.2f} deg, {step:g}",
               f"{finest_turn_deg(d_front):.3f} deg, {stereo_step(d_front):.5f}", verdict(holds))


def verdicts_table(rows):
    lines = [list(line) for line in (*exact_lines(), *verdict_lines(rows))]
    return study.table(["place", "printed", "here", "verdict"], lines)


def errors(sums, name, suffix, scale):
    """Mean and deviation of poses that are right, of which there have to be two."""
    if sums["right"] < 2:
        return "-"
    return (f"{scale * sums.mean(name, suffix, 'right'):+.2f} ± " f"{scale * sums.spread(name, suffix, 'right'):.2f}")


def views_table(rows):
    """By finder, in all and by one factor at a time: found, errors, wrong poses."""
    lines = []
    for finder, called in FINDERS.items():
        cuts = [("all", rows)]
        for factor, words in (("distance_m", "{:g} m"), ("sun_elevation_deg", "sun at {:g} deg"),
                              ("clutter_level", "clutter x {:g}")):
            if factor in rows:
                cuts += [(words.format(value), part) for (value,), part in groups(rows, factor).items()]
        for name, part in cuts:
            sums = Sums(part, finder)
            lines.append([called, name, share(sums["found"], sums.measurements),
                          errors(sums, "right_orientation", "_deg", 1.0), errors(sums, "right_range", "", 100.0),
                          f"{sums['nees'] / sums['right']:.1f}" if sums["right"] else "-",
                          share(sums["wrong"], sums.measurements)])
    return study.table(["finder", "views", "found", "orientation error, deg", "range error, %",
                        "squared error / stated (4)", "wrong poses"], lines)


def misses(rows):
    """Why nothing was found, in words."""
    parts = []
    for finder, called in FINDERS.items():
        sums = Sums(rows, finder)
        counts = [f"{name.replace('_', ' ')} {sums[name]:.0f}" for name in MISSES if sums[name]]
        parts.append(f"{called}: {', '.join(counts) or 'none'}")
    return "Misses by reason: " + "; ".join(parts) + "."


def content(name, rows):
    made = {"bias": bias_table, "green": bias_table, "limits": limits_table, "verdicts": verdicts_table}.get(name)
    return made(rows) if made else f"{views_table(rows)}\n\n{misses(rows)}"


def write_cells(rows, path):
    """Of each distance and orientation what figures 9 to 12 draw, both finders."""
    names = ("orientation_mean_deg", "orientation_sd_deg", "stereo_mean", "stereo_sd", "size_mean")
    lines = []
    for finder in FINDERS:
        for (distance, orientation), part in groups(rows, "distance_m", "orientation_deg").items():
            sums = Sums(part, finder)
            numbers = (sums.mean("orientation", "_deg"), sums.spread("orientation", "_deg"), sums.mean("stereo"),
                       sums.spread("stereo"), sums.mean("size"))
            lines.append({"distance_m": f"{distance:g}", "orientation_deg": f"{orientation:g}", "finder": finder,
                          "measurements": f"{sums.measurements:.0f}", "found": f"{sums['found']:.0f}",
                          "wrong": f"{sums['wrong']:.0f}"} |
                         {name: "" if math.isnan(value) else f"{value:.5g}"
                          for name, value in zip(names, numbers)})
    study.write_csv(path, lines)


def run(args, path, trials, folder, settings):
    """The rows of a scenario, run or taken as they are, and a note on the program."""
    args.trials = trials
    if args.count_only:
        return study.counted(ry.Run(folder)), ""
    found = study.run_scenario(args, path, folder, settings)
    return study.counted(found), f"; made by rockyard {study.program(found)}"


def run_views(args, name):
    """The rows of a scenario of the cylinder, and a note on them."""
    path = SCENARIOS / f"{name}.json"
    trials = json.loads(path.read_text(encoding="utf-8")).get("trials", 180)
    rows, made = run(args, path, args.views if args.views and "views" in name else trials,
                     args.out / f"{name}-{args.seed}", args.set)
    return rows, f"{rows.measurements.sum():.0f} pairs of images, {len(rows)} views, seed {args.seed}{made}."


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, None, "cylinder")
    parser.add_argument("--views", type=int, help="views of views.json and views_without.json (the scenarios' own)")
    parser.add_argument("--studies", type=Path, help="folder for CSV files of the cells")
    parser.add_argument("--count-only", action="store_true", help="the runs are there: count them")
    args = study.parse_with_tables(parser, TABLES)
    runs = {}
    for name in args.tables.split(","):
        scenario = RUN_OF[name]
        if scenario not in runs:
            runs[scenario] = run_views(args, scenario)
            if args.studies and scenario in ("published", "green"):
                suffix = "" if scenario == "published" else "_green"
                write_cells(runs[scenario][0], args.studies / f"cylinder{suffix}.csv")
        rows, note = runs[scenario]
        study.show(args, {f"cylinder_{name}": f"{content(name, rows)}\n\n{note}"})


if __name__ == "__main__":
    main()
