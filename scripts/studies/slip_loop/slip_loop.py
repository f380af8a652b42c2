#!/usr/bin/env python3
"""What a check of slip is worth in closed loop: drives up a slope of soft sand with and without it.

Counts the sweep scenarios/sweeps/slip_closed_loop.json, which it runs or goes on with:
  slip_endings    how drives end, and how far what the rover believes lies from the truth then
  slip_alarms     from where slip was first too much to the first alarm; alarms in vain; drives that a check frees of
                  being stuck, and arrivals that it costs or wins, against the same drives without one
Writes slip_closed_loop.csv.

    scripts/studies/slip_loop/slip_loop.py [--sweep FOLDER] [--out FOLDER] [--markdown results/visual_odometry.md]
"""

import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/slip_closed_loop.json"
MEANS = ("true_distance_m", "true_goal_distance_m", "sim_time_s", "energy_wh", "visual_steps", "slip_alarms")
STUCK = ("jammed", "high_centred")
AXES = ("hollows", "navigator", "check")
UNCHECKED = "vision unchecked"
# What an ending is counted as; all else is "other".
ENDINGS = {"reached": ("goal_reached",), "false_goal": ("false_goal",), "stuck": STUCK,
           "slip_stop": ("excessive_slip",), "no_path": ("no_path",)}


def summary(trials):
    """Of a frame; delays are the true way from the onset of slip to the first alarm, of drives that have both."""
    count = len(trials)
    ends = {name: int(trials.outcome.isin(outcomes).sum()) for name, outcomes in ENDINGS.items()}
    found = {"trials": count} | {name: ended / count for name, ended in ends.items()}
    found["other"] = 1.0 - sum(found[name] for name in ENDINGS)
    for name in ("reached", "stuck"):
        found[f"{name}_low"], found[f"{name}_high"] = rates.wilson_interval(ends[name], count)
    errors, delays = trials.position_error_m, (trials.first_slip_alarm_m - trials.slip_onset_m).dropna()
    found |= {"error_median_m": rates.quantile(errors, 0.5), "error_95_m": rates.quantile(errors, 0.95)}
    found |= {name: sum(trials[name]) / count for name in MEANS}
    found |= {"onsets": int(trials.slip_onset_m.notna().sum()), "onsets_alarmed": len(delays),
              "delay_median_m": rates.quantile(delays, 0.5), "delay_90_m": rates.quantile(delays, 0.9)}
    vain, low, high = rates.ratio_of_sums(trials.false_slip_alarms, trials.true_distance_m)
    found |= {"vain_100_m": 100 * vain, "vain_100_m_low": 100 * max(low, 0.0), "vain_100_m_high": 100 * high}
    found["stopped_in_vain"] = int((trials.outcome.eq("excessive_slip") & trials.slip_onset_m.isna()).sum())
    return found


def paired(trials, unchecked):
    """Against the same trials without a check: freed of being stuck, newly stuck, lost and won arrivals."""
    both = trials.merge(unchecked, on="trial", suffixes=("", "_unchecked"))
    stuck, before = both.outcome.isin(STUCK), both.outcome_unchecked.isin(STUCK)
    reached, once = both.outcome.eq("goal_reached"), both.outcome_unchecked.eq("goal_reached")
    return {name: int(pairs.sum()) for name, pairs in (
        ("freed", before & ~stuck), ("newly_stuck", stuck & ~before), ("arrivals_lost", once & ~reached),
        ("arrivals_won", reached & ~once))}


def grouped(rows):
    """Rows by (navigator, check), each by its hollows."""
    groups = defaultdict(dict)
    for row in rows:
        groups[row["navigator"], row["check"]][row["hollows"]] = row
    return groups


def endings_table(rows):
    """A line for each navigator and check, a column for each depth of the hollows."""
    hollows = list(dict.fromkeys(row["hollows"] for row in rows))
    lines = []
    for (navigator, check), by_hollow in grouped(rows).items():
        cells = [by_hollow[name] for name in hollows]
        lines.append(
            [f"{navigator}, {check}"] +
            [", ".join(f"{100 * row[part]:.0f}" for part in ENDINGS) for row in cells] +
            [", ".join(f"{row['error_median_m']:.2f} ({row['error_95_m']:.2f})" for row in cells),
             ", ".join(f"{row['true_goal_distance_m']:.1f}" for row in cells)])
    ends = "reached, believed only, stuck, stopped for slip, no way on, %"
    header = [f"{hollows[0]}: {ends}", *hollows[1:], "position error at the end, m: median (95 %)",
              "mean way left to the goal, m"]
    return study.table(["navigator, check", *header], lines)


def alarms_table(rows):
    """The same for cells with a check."""
    lines = []
    for (navigator, check), by_hollow in grouped(row for row in rows if row["slip_alarms"] > 0).items():
        cells = list(by_hollow.values())
        way_100_m = sum(row["trials"] * row["true_distance_m"] for row in cells) / 100
        vain = sum(row["vain_100_m"] * row["trials"] * row["true_distance_m"] / 100 for row in cells)
        lines.append([
            f"{navigator}, {check}", ", ".join(f"{row['onsets_alarmed']} of {row['onsets']}" for row in cells),
            ", ".join(f"{row['delay_median_m']:.2f} ({row['delay_90_m']:.2f})" for row in cells),
            f"{vain:.0f} in {100 * way_100_m:.0f} m"] +
            [", ".join(str(row[name]) for row in cells) for name in ("freed", "arrivals_lost", "arrivals_won")])
    hollows = ", ".join(dict.fromkeys(row["hollows"] for row in rows))
    return study.table(
        [f"navigator, check: {hollows}", "drives with an alarm, of those in which slip was too much",
         "true way from there to the first alarm, m: median (90 %)", "alarms in vain", "freed of being stuck",
         "arrivals lost", "arrivals won"], lines)


def count(cells):
    return [dict(zip(AXES, key)) | summary(trials) | paired(trials, cells[*key[:2], UNCHECKED])
            for key, trials in cells.items()]


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "slip_closed_loop")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, AXES)
    rows = count(cells)
    study.write_csv(args.out / "slip_closed_loop.csv",
                    [{name: round(value, 5) if isinstance(value, float) else value for name, value in row.items()}
                     for row in rows])
    study.show(args, {"slip_endings": endings_table(rows), "slip_alarms": alarms_table(rows)}, note)


if __name__ == "__main__":
    main()
