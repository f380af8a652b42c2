#!/usr/bin/env python3
"""Stop and look, continuous steering or driving, and both at once, over the same rocks (Howard 2012, section 3).

Counts the sweeps scenarios/sweeps/continuous*.json, which it runs or goes on with:
  continuous_drives    success, and time, way, speed, steering and energy of fields in which all three arrive
  continuous_paired    paired differences of these fields, and where the published pair lies among them
  continuous_strata    the gain by rock abundance
  continuous_plans     plans on the move: how many, unsafe, late, and how far off they began
  continuous_maps      time and steering of CSAD over those of CSOD, by replan fraction and steering rate
  continuous_assumptions   what each assumption does to success, time and steering, alone and with neighbours
The first four are counted for the quasi-static rover and for the multibody one. Writes continuous.csv,
continuous_maps.csv, continuous_maps.svg and continuous_assumptions.csv.

    scripts/studies/continuous/continuous.py [--sweep FOLDER] [--out FOLDER] [--markdown results/continuous.md]
"""

import argparse
import math
import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SWEEPS = study.ROOT / "scenarios/sweeps"
CYCLES = ("stop_and_look", "csod", "csad")
COLUMNS = ("sim_time_s", "true_distance_m", "visual_distance_m", "steer_turned_rad", "energy_wh", "true_goal_distance_m",
           "plans_on_the_move", "unsafe_plans", "late_plans", "plan_start_error_m", "moves", "point_turns", "image_sets")
# Howard 2012, section 3: one drive each.
PUBLISHED = {"csod": {"sim_time_s": 287.58, "visual_distance_m": 14.92, "speed_cm_s": 5.19, "steer_turned_rad": 2.03},
             "csad": {"sim_time_s": 231.97, "visual_distance_m": 14.94, "speed_cm_s": 6.44, "steer_turned_rad": 0.93}}
GAIN = 1.0 - PUBLISHED["csad"]["sim_time_s"] / PUBLISHED["csod"]["sim_time_s"]  # the printed 19.3 %
STEERING_RATIO = PUBLISHED["csad"]["steer_turned_rad"] / PUBLISHED["csod"]["steer_turned_rad"]
ARRIVED = "goal_reached"
ALIKE_M = 0.2  # about half of what the published ways exceed 14.5 m by
SHOWN = {"sim_time_s": ("time, s", 0), "visual_distance_m": ("way as seen, m", 2), "true_distance_m": ("true way, m", 2),
         "speed_cm_s": ("speed, cm/s", 2), "steer_turned_rad": ("turned by a steering motor, rad", 2),
         "energy_wh": ("energy, Wh", 2)}
PARTS = ("multibody", "maps", "assumptions")
AS_ASSUMED = "as assumed"
MAP_AXES = ("steer_rate", "replan_fraction")


def read_fields(folder):
    """Rows by field (abundance, number), each by cycle; speed is the seen way over the time, as published."""
    fields = defaultdict(dict)
    for levels, trial, row in study.stored_trials(folder, COLUMNS):
        row["speed_cm_s"] = 100.0 * row["visual_distance_m"] / row["sim_time_s"]
        fields[float(levels["k_per_m2"]), trial][levels["cycle"]] = row
    return fields


def shared_arrivals(fields, cycles=CYCLES):
    """Fields in which every one of the cycles arrives: only there their times mean the same drive."""
    return {key: rows for key, rows in fields.items()
            if all(name in rows and rows[name]["outcome"] == ARRIVED for name in cycles)}


def place(values, published):
    """Share of the values below the published one, and its two-sided chance among n + 1."""
    below = sum(value < published for value in values)
    n = len(values)
    return below / n, min(1.0, 2.0 * min(below + 1, n - below + 1) / (n + 1))


def spread(values, digits):
    return (f"{study.quantile(values, 0.5):.{digits}f} ({study.quantile(values, 0.05):.{digits}f}.."
            f"{study.quantile(values, 0.95):.{digits}f})")


def drives_table(fields):
    arrivals = shared_arrivals(fields)
    lines = []
    for cycle in CYCLES:
        rows = [by_cycle[cycle] for by_cycle in fields.values() if cycle in by_cycle]
        reached = sum(row["outcome"] == ARRIVED for row in rows)
        rate = (reached / len(rows), *study.wilson_interval(reached, len(rows)))
        line = [cycle, study.with_interval(rate, 1, 100.0)]
        for column, (_, digits) in SHOWN.items():
            values = [by_cycle[cycle][column] for by_cycle in arrivals.values()]
            text = spread(values, digits)
            published = PUBLISHED.get(cycle, {}).get(column)
            if published is not None:
                share, chance = place(values, published)
                text += f"; {published:g} is above {100 * share:.0f} % (p {chance:.2g})"
            line.append(text)
        lines.append(line)
    excess = "; ".join(f"{cycle} " + spread([rows[cycle]["visual_distance_m"] - rows[cycle]["true_distance_m"]
                                             for rows in arrivals.values()], 2) for cycle in CYCLES)
    header = ["cycle", "true success, %", *(name for name, _ in SHOWN.values())]
    return (study.table(header, lines) + f"\n\nMedians (5 to 95 %) over the {len(arrivals)} of {len(fields)} fields in "
            "which all three arrive; p: two-sided chance of a value as far out as the published one. Way as seen less true way, m: "
            f"{excess}.")


def differences(arrivals, column, first, second):
    return [rows[second][column] - rows[first][column] for rows in arrivals.values()]


def gains(arrivals, first, second):
    return [1.0 - rows[second]["sim_time_s"] / rows[first]["sim_time_s"] for rows in arrivals.values()]


def ratios(arrivals, column, first, second):
    return [rows[second][column] / rows[first][column] for rows in arrivals.values() if rows[first][column] > 0.0]


def alike(arrivals):
    """Fields whose ways are like the published ones of both drives."""
    return {key: rows for key, rows in arrivals.items()
            if all(abs(rows[cycle]["visual_distance_m"] - values["visual_distance_m"]) < ALIKE_M
                   for cycle, values in PUBLISHED.items())}


def alike_text(arrivals):
    found = alike(arrivals)
    if not found:
        return f"No field has ways within {ALIKE_M:g} m of both published ones."
    medians = {cycle: [study.quantile([rows[cycle][column] for rows in found.values()], 0.5)
                       for column in ("sim_time_s", "steer_turned_rad")] for cycle in PUBLISHED}
    gain = study.with_interval(study.signed_mean_interval(gains(found, "csod", "csad")), 1, 100.0)
    return (f"In the {len(found)} fields with ways within {ALIKE_M:g} m of both published ones csad gains {gain} %; medians "
            + "; ".join(f"{cycle} {time_s:.0f} s and {turned_rad:.2f} rad" for cycle, (time_s, turned_rad) in medians.items())
            + ".")


def paired_table(fields):
    arrivals = shared_arrivals(fields)
    pairs = (("stop_and_look", "csod"), ("stop_and_look", "csad"), ("csod", "csad"))
    lines = []
    for first, second in pairs:
        line = [f"{second} - {first}"]
        for column, (_, digits) in SHOWN.items():
            values = differences(arrivals, column, first, second)
            line.append(study.with_interval(study.signed_mean_interval(values), max(digits, 1)))
        values = gains(arrivals, first, second)
        line.append(study.with_interval(study.signed_mean_interval(values), 1, 100.0))
        lines.append(line)
    gain, gain_chance = place(gains(arrivals, "csod", "csad"), GAIN)
    steering, steering_chance = place(ratios(arrivals, "steer_turned_rad", "csod", "csad"), STEERING_RATIO)
    reached = [[rows[cycle]["outcome"] == ARRIVED for cycle in ("csod", "csad")] for rows in fields.values()]
    wins = sum(csad and not csod for csod, csad in reached)
    losses = sum(csod and not csad for csod, csad in reached)
    header = ["difference", *(name for name, _ in SHOWN.values()), "time gained, %"]
    return (study.table(header, lines) +
            f"\n\nMeans with 95 % intervals over the {len(arrivals)} fields. Of csad over csod the published gain of "
            f"{100 * GAIN:.1f} % is above {100 * gain:.0f} % of them (p {gain_chance:.2g}), the published ratio of "
            f"steering, {STEERING_RATIO:.2f}, above {100 * steering:.0f} % (p {steering_chance:.2g}). "
            f"csad alone arrives in {wins} fields, csod alone in {losses} "
            f"(McNemar's p {study.mcnemar(losses, wins):.2g}).\n\n{alike_text(arrivals)}")


def strata_table(fields):
    lines = []
    for k in sorted({key[0] for key in fields}):
        stratum = {key: rows for key, rows in fields.items() if key[0] == k}
        arrivals = shared_arrivals(stratum)
        reached = [sum(rows[cycle]["outcome"] == ARRIVED for rows in stratum.values()) for cycle in CYCLES]
        steering = ratios(arrivals, "steer_turned_rad", "csod", "csad")
        lines.append([f"{k:g}", str(len(stratum)), ", ".join(f"{100 * n / len(stratum):.0f}" for n in reached),
                      str(len(arrivals)),
                      study.with_interval(study.signed_mean_interval(gains(arrivals, "csod", "csad")), 1, 100.0),
                      study.with_interval(study.signed_mean_interval(gains(arrivals, "stop_and_look", "csad")), 1, 100.0),
                      study.with_interval(study.signed_mean_interval(steering), 2)])
    return study.table(["k", "fields", f"true success, %: {', '.join(CYCLES)}", "all arrive",
                        "csad's gain of time over csod, %", "over stop_and_look, %",
                        "steering of csad over csod"], lines)


def plans_table(fields):
    lines = []
    for cycle in CYCLES[1:]:
        rows = [by_cycle[cycle] for by_cycle in fields.values() if cycle in by_cycle]
        errors = [row["plan_start_error_m"] for row in rows if not math.isnan(row["plan_start_error_m"])]
        mean = lambda name: sum(row[name] for row in rows) / len(rows)
        lines.append([cycle, f"{mean('plans_on_the_move'):.1f}", f"{mean('unsafe_plans'):.2f}",
                      f"{mean('late_plans'):.2f}", f"{mean('point_turns'):.2f}", f"{mean('image_sets'):.1f}",
                      f"{1000 * study.quantile(errors, 0.5):.1f} ({1000 * study.quantile(errors, 0.95):.1f})"])
    return study.table(["cycle", "plans on the move a drive", "without a safe one", "late", "turns in place",
                        "image sets", "predicted less real start, mm rms: median (95 %)"], lines)


def read_map(folder):
    """Rows by (steering rate, replan fraction) and field, each by cycle."""
    cells = defaultdict(lambda: defaultdict(dict))
    for levels, trial, row in study.stored_trials(folder, COLUMNS):
        row["speed_cm_s"] = 100.0 * row["visual_distance_m"] / row["sim_time_s"]
        cells[tuple(float(levels[name]) for name in MAP_AXES)][trial][levels["cycle"]] = row
    return cells


def map_rows(cells):
    rows = []
    for (rate, fraction), fields in sorted(cells.items()):
        arrivals = shared_arrivals(fields, CYCLES[1:])
        found = {"steer_rate_deg_s": rate, "replan_fraction": fraction, "fields": len(fields), "arrivals": len(arrivals)}
        for column, name in (("sim_time_s", "time"), ("steer_turned_rad", "steering")):
            found[f"{name}_ratio"], found[f"{name}_low"], found[f"{name}_high"] = study.signed_mean_interval(
                ratios(arrivals, column, "csod", "csad"))
        rows.append(found)
    return rows


def map_table(rows):
    fractions = sorted({row["replan_fraction"] for row in rows})
    lines = []
    for rate in sorted({row["steer_rate_deg_s"] for row in rows}):
        line = [f"{rate:g}"]
        for fraction in fractions:
            row = next(r for r in rows if (r["steer_rate_deg_s"], r["replan_fraction"]) == (rate, fraction))
            time = "*" if row["time_low"] <= 1.0 - GAIN <= row["time_high"] else ""
            steering = "*" if row["steering_low"] <= STEERING_RATIO <= row["steering_high"] else ""
            line.append(f"{row['time_ratio']:.2f}{time}, {row['steering_ratio']:.2f}{steering}")
        lines.append(line)
    return (study.table(["steering rate, deg/s", *(f"fraction {fraction:g}: time, steering" if i == 0 else f"{fraction:g}"
                                                   for i, fraction in enumerate(fractions))], lines) +
            f"\n\nMeans of the ratios csad over csod over fields in which both arrive; * where the 95 % interval holds the "
            f"published ratio ({1.0 - GAIN:.3f} of time, {STEERING_RATIO:.3f} of steering).")


def map_panels(rows):
    """Both ratios against the replan fraction, a line for each steering rate."""
    panels = []
    for name, title in (("time", "time of CSAD over CSOD"), ("steering", "steering of CSAD over CSOD")):
        series = [(f"{rate:g} deg/s", [(r["replan_fraction"], r[f"{name}_ratio"], r[f"{name}_low"], r[f"{name}_high"])
                                       for r in rows if r["steer_rate_deg_s"] == rate])
                  for rate in sorted({row["steer_rate_deg_s"] for row in rows})]
        published = 1.0 - GAIN if name == "time" else STEERING_RATIO
        fractions = sorted({row["replan_fraction"] for row in rows})
        series.append(("published", [(fraction, published, published, published) for fraction in fractions]))
        panels.append((title, series))
    return panels


TABLES = {"continuous_drives": drives_table, "continuous_paired": paired_table, "continuous_strata": strata_table,
          "continuous_plans": plans_table}


def read_choices(folder):
    """Rows by (cycle, choice), each by field."""
    cells = defaultdict(dict)
    for levels, trial, row in study.stored_trials(folder, COLUMNS):
        cells[levels["cycle"], levels["choice"]][trial] = row
    return cells


def choice_rows(cells):
    """Each choice against what is assumed: arrivals won and lost, and ratios where both arrive."""
    rows = []
    for (cycle, choice), fields in cells.items():
        base = cells[cycle, AS_ASSUMED]
        arrived = {name for name, row in fields.items() if row["outcome"] == ARRIVED}
        base_arrived = {name for name, row in base.items() if row["outcome"] == ARRIVED}
        found = {"cycle": cycle, "choice": choice, "fields": len(fields), "arrived": len(arrived),
                 "won": len(arrived - base_arrived), "lost": len(base_arrived - arrived)}
        pairs = {name: {"base": base[name], "choice": fields[name]} for name in arrived & base_arrived}
        for column, name in (("sim_time_s", "time"), ("steer_turned_rad", "steering"), ("true_distance_m", "way")):
            found[name], found[f"{name}_low"], found[f"{name}_high"] = study.signed_mean_interval(
                ratios(pairs, column, "base", "choice"))
        rows.append(found)
    return rows


def choices_table(rows):
    lines = []
    for choice in dict.fromkeys(row["choice"] for row in rows):
        line = [choice]
        for cycle in CYCLES[1:]:
            row = next(r for r in rows if (r["cycle"], r["choice"]) == (cycle, choice))
            line.append(f"{row['arrived']} of {row['fields']} (+{row['won']}, -{row['lost']})")
            line += ["" if choice == AS_ASSUMED else
                     study.with_interval((row[name], row[f"{name}_low"], row[f"{name}_high"]), 2)
                     for name in ("time", "steering", "way")]
        lines.append(line)
    names = ("arrive (won, lost)", "time", "steering", "true way")
    return (study.table(["choice", *(f"{cycle}: {name}" for cycle in CYCLES[1:] for name in names)], lines) +
            "\n\nRatios to what is assumed, over fields in which both arrive, with 95 % intervals.")


def csv_rows(fields, fidelity):
    return [{"fidelity": fidelity, "k_per_m2": key[0], "trial": key[1], "cycle": cycle, "outcome": row["outcome"]} |
            {name: f"{row[name]:.5g}" for name in SHOWN if name != "speed_cm_s"}
            for key, rows in sorted(fields.items()) for cycle, row in rows.items()]


def sweep_folder(args, name):
    """Runs a sweep beside that of the first table, or goes on with it."""
    folder = argparse.Namespace(**vars(args) | {"sweep": args.sweep.with_name(name)})
    study.run_sweep(folder, SWEEPS / f"{name}.json")
    return folder.sweep


def count_drives(args, skipped):
    rows = []
    for fidelity, name in (("quasi_static", "continuous"), ("multibody", "continuous_multibody")):
        if fidelity in skipped:
            continue
        fields = read_fields(sweep_folder(args, name))
        rows += csv_rows(fields, fidelity)
        for table, make in TABLES.items():
            study.show(args, table if fidelity == "quasi_static" else f"{table}_multibody", make(fields))
    study.write_csv(args.out / "continuous.csv", rows)


def count_maps(args):
    rows = map_rows(read_map(sweep_folder(args, "continuous_maps")))
    study.write_csv(args.out / "continuous_maps.csv", rows)
    study.write_svg(args.out / "continuous_maps.svg", map_panels(rows), "replan fraction")
    study.show(args, "continuous_maps", map_table(rows))


def count_assumptions(args):
    rows = choice_rows(read_choices(sweep_folder(args, "continuous_assumptions")))
    study.write_csv(args.out / "continuous_assumptions.csv", rows)
    study.show(args, "continuous_assumptions", choices_table(rows))


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "continuous", "write the tables between their marks on this page")
    parser.add_argument("--skip", default="", help=f"of {', '.join(PARTS)}: what is neither run nor counted")
    args = parser.parse_args()
    skipped = set(args.skip.split(",")) - {""}
    if unknown := skipped - set(PARTS):
        parser.error(f"{', '.join(sorted(unknown))}: there are {', '.join(PARTS)}")
    args.out.mkdir(parents=True, exist_ok=True)
    count_drives(args, skipped)
    if "maps" not in skipped:
        count_maps(args)
    if "assumptions" not in skipped:
        count_assumptions(args)
    return 0


if __name__ == "__main__":
    sys.exit(main())
