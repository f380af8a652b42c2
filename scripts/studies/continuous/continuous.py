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

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates, ry  # noqa: E402

SWEEPS = study.ROOT / "scenarios/sweeps"
CYCLES = ("stop_and_look", "csod", "csad")
MOVING = CYCLES[1:]
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
PLANS = ("plans_on_the_move", "unsafe_plans", "late_plans", "point_turns", "image_sets", "plan_start_error_m")
PARTS = ("multibody", "maps", "assumptions")
AS_ASSUMED = "as assumed"
MAP_AXES = ("steer_rate", "replan_fraction")


def fields_of(trials, *key):
    """Rows by field (`key`), columns by name and cycle; speed is the seen way over the time, as published."""
    found = trials.assign(speed_cm_s=100.0 * trials.visual_distance_m / trials.sim_time_s, outcome=trials.outcome.astype(str))
    return found.set_index([*key, "cycle"])[["outcome", *SHOWN, *PLANS]].unstack("cycle")


def shared_arrivals(fields, cycles=CYCLES):
    """Fields in which every one of the cycles arrives: only there their times mean the same drive."""
    return fields[(fields.outcome[list(cycles)] == ARRIVED).all(axis=1)]


def place(values, published):
    """Share of the values below the published one, and its two-sided chance among n + 1."""
    n, below = len(values), int((values < published).sum())
    return below / n, min(1.0, 2.0 * min(below + 1, n - below + 1) / (n + 1))


def spread(values, digits):
    middle, low, high = (rates.quantile(values, share) for share in (0.5, 0.05, 0.95))
    return f"{middle:.{digits}f} ({low:.{digits}f}..{high:.{digits}f})"


def mean(values, digits, scale=1.0):
    return study.with_interval(rates.mean(values), digits, scale)


def gains(arrivals, first, second):
    return 1.0 - arrivals.sim_time_s[second] / arrivals.sim_time_s[first]


def ratios(arrivals, column, first, second):
    """Where there is something to divide by."""
    base = arrivals[column, first]
    return (arrivals[column, second] / base)[base > 0.0]


def drives_table(fields):
    arrivals = shared_arrivals(fields)
    lines = []
    for cycle in CYCLES:
        reached = fields.outcome[cycle].dropna() == ARRIVED
        rate = (reached.mean(), *rates.wilson_interval(reached.sum(), len(reached)))
        line = [cycle, study.with_interval(rate, 1, 100.0)]
        for column, (_, digits) in SHOWN.items():
            text, published = spread(arrivals[column, cycle], digits), PUBLISHED.get(cycle, {}).get(column)
            if published is not None:
                share, chance = place(arrivals[column, cycle], published)
                text += f"; {published:g} is above {100 * share:.0f} % (p {chance:.2g})"
            line.append(text)
        lines.append(line)
    excess = arrivals.visual_distance_m - arrivals.true_distance_m
    header = ["cycle", "true success, %", *(name for name, _ in SHOWN.values())]
    return (study.table(header, lines) + f"\n\nMedians (5 to 95 %) over the {len(arrivals)} of {len(fields)} fields in "
            "which all three arrive; p: two-sided chance of a value as far out as the published one. Way as seen less true way, m: "
            f"{'; '.join(f'{cycle} {spread(excess[cycle], 2)}' for cycle in CYCLES)}.")


def alike(arrivals):
    """Fields whose ways are like the published ones of both drives."""
    ways = arrivals.visual_distance_m
    return arrivals[[all(abs(ways[cycle][field] - values["visual_distance_m"]) < ALIKE_M
                         for cycle, values in PUBLISHED.items()) for field in arrivals.index]]


def alike_text(arrivals):
    found = alike(arrivals)
    if found.empty:
        return f"No field has ways within {ALIKE_M:g} m of both published ones."
    middle = lambda column, cycle: rates.quantile(found[column, cycle], 0.5)
    medians = "; ".join(f"{cycle} {middle('sim_time_s', cycle):.0f} s and {middle('steer_turned_rad', cycle):.2f} rad"
                        for cycle in PUBLISHED)
    return (f"In the {len(found)} fields with ways within {ALIKE_M:g} m of both published ones csad gains "
            f"{mean(gains(found, 'csod', 'csad'), 1, 100.0)} %; medians {medians}.")


def paired_table(fields):
    arrivals = shared_arrivals(fields)
    lines = [[f"{second} - {first}", *(mean(arrivals[column, second] - arrivals[column, first], max(digits, 1))
                                       for column, (_, digits) in SHOWN.items()),
              mean(gains(arrivals, first, second), 1, 100.0)]
             for first, second in (("stop_and_look", "csod"), ("stop_and_look", "csad"), MOVING)]
    gain, gain_chance = place(gains(arrivals, *MOVING), GAIN)
    steering, steering_chance = place(ratios(arrivals, "steer_turned_rad", *MOVING), STEERING_RATIO)
    csod, csad = (fields.outcome[cycle] == ARRIVED for cycle in MOVING)
    wins, losses = int((csad & ~csod).sum()), int((csod & ~csad).sum())
    header = ["difference", *(name for name, _ in SHOWN.values()), "time gained, %"]
    return (study.table(header, lines) +
            f"\n\nMeans with 95 % intervals over the {len(arrivals)} fields. Of csad over csod the published gain of "
            f"{100 * GAIN:.1f} % is above {100 * gain:.0f} % of them (p {gain_chance:.2g}), the published ratio of "
            f"steering, {STEERING_RATIO:.2f}, above {100 * steering:.0f} % (p {steering_chance:.2g}). "
            f"csad alone arrives in {wins} fields, csod alone in {losses} "
            f"(McNemar's p {rates.mcnemar(losses, wins):.2g}).\n\n{alike_text(arrivals)}")


def strata_table(fields):
    lines = []
    for k, stratum in fields.groupby(level="k_per_m2"):
        arrivals = shared_arrivals(stratum)
        reached = (stratum.outcome == ARRIVED).sum()
        lines.append([f"{k:g}", str(len(stratum)), ", ".join(f"{100 * reached[cycle] / len(stratum):.0f}" for cycle in CYCLES),
                      str(len(arrivals)), mean(gains(arrivals, "csod", "csad"), 1, 100.0),
                      mean(gains(arrivals, "stop_and_look", "csad"), 1, 100.0),
                      mean(ratios(arrivals, "steer_turned_rad", "csod", "csad"), 2)])
    return study.table(["k", "fields", f"true success, %: {', '.join(CYCLES)}", "all arrive",
                        "csad's gain of time over csod, %", "over stop_and_look, %",
                        "steering of csad over csod"], lines)


def plans_table(fields):
    lines = []
    for cycle in MOVING:
        means = [f"{fields[name, cycle].mean():.{digits}f}" for name, digits in zip(PLANS, (1, 2, 2, 2, 1))]
        middle, most = (1000 * rates.quantile(fields.plan_start_error_m[cycle], share) for share in (0.5, 0.95))
        lines.append([cycle, *means, f"{middle:.1f} ({most:.1f})"])
    return study.table(["cycle", "plans on the move a drive", "without a safe one", "late", "turns in place",
                        "image sets", "predicted less real start, mm rms: median (95 %)"], lines)


def map_rows(cells):
    """Of trials by (steering rate, replan fraction)."""
    rows = []
    for (rate, fraction), trials in sorted((tuple(map(float, levels)), trials) for levels, trials in cells.items()):
        fields = fields_of(trials, "trial")
        arrivals = shared_arrivals(fields, MOVING)
        found = {"steer_rate_deg_s": rate, "replan_fraction": fraction, "fields": len(fields), "arrivals": len(arrivals)}
        for column, name in (("sim_time_s", "time"), ("steer_turned_rad", "steering")):
            found |= zip((f"{name}_ratio", f"{name}_low", f"{name}_high"), rates.mean(ratios(arrivals, column, *MOVING)))
        rows.append(found)
    return rows


def map_table(rows):
    fractions = sorted({row["replan_fraction"] for row in rows})
    cell = {(row["steer_rate_deg_s"], row["replan_fraction"]): row for row in rows}

    def ratio(row, name, published):
        return f"{row[f'{name}_ratio']:.2f}{'*' if row[f'{name}_low'] <= published <= row[f'{name}_high'] else ''}"
    return (study.table(["steering rate, deg/s", f"fraction {fractions[0]:g}: time, steering", *(f"{f:g}" for f in fractions[1:])], [
        [f"{rate:g}", *(f"{ratio(cell[rate, f], 'time', 1.0 - GAIN)}, {ratio(cell[rate, f], 'steering', STEERING_RATIO)}"
                        for f in fractions)] for rate in sorted({row["steer_rate_deg_s"] for row in rows})]) +
            f"\n\nMeans of the ratios csad over csod over fields in which both arrive; * where the 95 % interval holds the "
            f"published ratio ({1.0 - GAIN:.3f} of time, {STEERING_RATIO:.3f} of steering).")


def map_panels(rows):
    """Both ratios against the replan fraction, a line for each steering rate."""
    panels = []
    for name, title, published in (("time", "time of CSAD over CSOD", 1.0 - GAIN),
                                   ("steering", "steering of CSAD over CSOD", STEERING_RATIO)):
        series = [(f"{rate:g} deg/s", [(r["replan_fraction"], r[f"{name}_ratio"], r[f"{name}_low"], r[f"{name}_high"])
                                       for r in rows if r["steer_rate_deg_s"] == rate])
                  for rate in sorted({row["steer_rate_deg_s"] for row in rows})]
        fractions = sorted({row["replan_fraction"] for row in rows})
        panels.append((title, [*series, ("published", [(fraction, *[published] * 3) for fraction in fractions])]))
    return panels


TABLES = {"continuous_drives": drives_table, "continuous_paired": paired_table, "continuous_strata": strata_table,
          "continuous_plans": plans_table}


def choice_rows(cells):
    """Each choice against what is assumed: arrivals won and lost, and ratios where both arrive."""
    rows = []
    for (cycle, choice), trials in cells.items():
        both = trials.merge(cells[cycle, AS_ASSUMED], on="trial", how="outer", suffixes=("", "_base"))
        arrived, base = (both[f"outcome{side}"] == ARRIVED for side in ("", "_base"))
        pairs = both[arrived & base]
        found = {"cycle": cycle, "choice": choice, "fields": len(trials), "arrived": int(arrived.sum()),
                 "won": int((arrived & ~base).sum()), "lost": int((base & ~arrived).sum())}
        for column, name in (("sim_time_s", "time"), ("steer_turned_rad", "steering"), ("true_distance_m", "way")):
            found |= zip((name, f"{name}_low", f"{name}_high"), rates.mean(
                (pairs[column] / pairs[f"{column}_base"])[pairs[f"{column}_base"] > 0.0]))
        rows.append(found)
    return rows


def choices_table(rows):
    cell = {(row["cycle"], row["choice"]): row for row in rows}
    names = ("time", "steering", "way")

    def texts(row):
        return [f"{row['arrived']} of {row['fields']} (+{row['won']}, -{row['lost']})",
                *("" if row["choice"] == AS_ASSUMED else study.interval_of(row, name, 2) for name in names)]
    header = [f"{cycle}: {name}" for cycle in MOVING for name in ("arrive (won, lost)", "time", "steering", "true way")]
    return (study.table(["choice", *header], [[choice, *(text for cycle in MOVING for text in texts(cell[cycle, choice]))]
                                              for choice in dict.fromkeys(row["choice"] for row in rows)]) +
            "\n\nRatios to what is assumed, over fields in which both arrive, with 95 % intervals.")


def csv_rows(trials, fidelity):
    ordered = trials.sort_values(["k_per_m2", "trial"], kind="stable")
    return [{"fidelity": fidelity, "k_per_m2": row.k_per_m2, "trial": row.trial, "cycle": row.cycle, "outcome": row.outcome} |
            {name: f"{getattr(row, name):.5g}" for name in SHOWN if name != "speed_cm_s"} for row in ordered.itertuples()]


def swept(args, name):
    """The trials of a sweep beside that of the first table, run or gone on with."""
    return study.counted(ry.Sweep(study.run_sweep(args, SWEEPS / f"{name}.json", args.sweep.with_name(name))))


def count_drives(args, skipped):
    rows = []
    for fidelity, name in (("quasi_static", "continuous"), ("multibody", "continuous_multibody")):
        if fidelity in skipped:
            continue
        trials = swept(args, name)
        fields = fields_of(trials, "k_per_m2", "trial")
        rows += csv_rows(trials, fidelity)
        suffix = "" if fidelity == "quasi_static" else "_multibody"
        study.show(args, {f"{table}{suffix}": make(fields) for table, make in TABLES.items()})
    study.write_csv(args.out / "continuous.csv", rows)


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "continuous")
    parser.add_argument("--skip", default="", help=f"of {', '.join(PARTS)}: what is neither run nor counted")
    args = parser.parse_args()
    skipped = set(args.skip.split(",")) - {""}
    if unknown := skipped - set(PARTS):
        parser.error(f"{', '.join(sorted(unknown))}: there are {', '.join(PARTS)}")
    count_drives(args, skipped)
    if "maps" not in skipped:
        rows = map_rows(study.cells_of(swept(args, "continuous_maps"), MAP_AXES))
        study.write_csv(args.out / "continuous_maps.csv", rows)
        study.write_svg(args.out / "continuous_maps.svg", map_panels(rows), "replan fraction")
        study.show(args, {"continuous_maps": map_table(rows)})
    if "assumptions" not in skipped:
        rows = choice_rows(study.cells_of(swept(args, "continuous_assumptions"), ("cycle", "choice")))
        study.write_csv(args.out / "continuous_assumptions.csv", rows)
        study.show(args, {"continuous_assumptions": choices_table(rows)})


if __name__ == "__main__":
    main()
