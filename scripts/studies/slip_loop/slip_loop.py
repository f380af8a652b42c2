#!/usr/bin/env python3
"""What a check of slip is worth in closed loop: drives up a slope of soft sand with and without it.

Counts the sweep scenarios/sweeps/slip_closed_loop.json, which it runs or goes on with:
  slip_endings    how drives end, and how far what the rover believes lies from the truth then
  slip_alarms     from where slip was first too much to the first alarm; alarms in vain; drives that a check frees of
                  being stuck, and arrivals that it costs or wins, against the same drives without one
Writes slip_closed_loop.csv.

    scripts/studies/slip_loop/slip_loop.py [--sweep FOLDER] [--out FOLDER] [--markdown results/visual_odometry.md]
"""

import math
import sys
from collections import defaultdict
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SWEEP = study.ROOT / "scenarios/sweeps/slip_closed_loop.json"
COLUMNS = ("position_error_m", "true_distance_m", "true_goal_distance_m", "dead_reckoned_distance_m", "sim_time_s",
           "energy_wh", "visual_steps", "slip_alarms", "false_slip_alarms", "first_slip_alarm_m", "slip_onset_m")
STUCK = ("jammed", "high_centred")
AXES = ("hollows", "navigator", "check")
UNCHECKED = "vision unchecked"
# What an ending is counted as; all else is "other".
ENDINGS = {"reached": ("goal_reached",), "false_goal": ("false_goal",), "stuck": STUCK,
           "slip_stop": ("excessive_slip",), "no_path": ("no_path",)}


def read_cells(folder):
    """Trials by (hollows, navigator, check): rows by their number."""
    cells = defaultdict(dict)
    for levels, trial, row in study.stored_trials(folder, COLUMNS):
        cells[tuple(levels[name] for name in AXES)][trial] = row
    return cells


def delays(rows):
    """True way from the onset of slip to the first alarm, of drives that have both: m."""
    return [row["first_slip_alarm_m"] - row["slip_onset_m"] for row in rows
            if not math.isnan(row["first_slip_alarm_m"] + row["slip_onset_m"])]


def per_100_m(counts, ways_m):
    """Events in 100 m, with the 95 % interval by the normal approximation over trials."""
    rate = sum(counts) / sum(ways_m)
    n = len(counts)
    variance = sum((count - rate * way)**2 for count, way in zip(counts, ways_m)) * n / max(n - 1, 1)
    half = study.Z95 * math.sqrt(variance) / sum(ways_m)
    return 100 * rate, 100 * max(rate - half, 0.0), 100 * (rate + half)


def summary(rows):
    count = len(rows)
    found = {"trials": count}
    for name, outcomes in ENDINGS.items():
        found[name] = sum(row["outcome"] in outcomes for row in rows) / count
    found["other"] = 1.0 - sum(found[name] for name in ENDINGS)
    found["reached_low"], found["reached_high"] = study.wilson_interval(round(found["reached"] * count), count)
    found["stuck_low"], found["stuck_high"] = study.wilson_interval(round(found["stuck"] * count), count)
    errors = [row["position_error_m"] for row in rows]
    found |= {"error_median_m": study.quantile(errors, 0.5), "error_95_m": study.quantile(errors, 0.95)}
    for name in ("true_distance_m", "true_goal_distance_m", "sim_time_s", "energy_wh", "visual_steps", "slip_alarms"):
        found[name] = sum(row[name] for row in rows) / count
    ways = delays(rows)
    found["onsets"] = sum(not math.isnan(row["slip_onset_m"]) for row in rows)
    found["onsets_alarmed"] = len(ways)
    found["delay_median_m"], found["delay_90_m"] = (
        (study.quantile(ways, 0.5), study.quantile(ways, 0.9)) if ways else (math.nan, math.nan))
    found["vain_100_m"], found["vain_100_m_low"], found["vain_100_m_high"] = per_100_m(
        [row["false_slip_alarms"] for row in rows], [row["true_distance_m"] for row in rows])
    found["stopped_in_vain"] = sum(row["outcome"] == "excessive_slip" and math.isnan(row["slip_onset_m"])
                                   for row in rows)
    return found


def paired(rows, unchecked):
    """Against the same trials without a check: freed of being stuck, newly stuck, lost and won arrivals."""
    both = [(rows[i], unchecked[i]) for i in rows if i in unchecked]
    pairs = [((a["outcome"] in STUCK, a["outcome"] == "goal_reached"),
              (b["outcome"] in STUCK, b["outcome"] == "goal_reached")) for a, b in both]
    return {"freed": sum(b[0] and not a[0] for a, b in pairs), "newly_stuck": sum(a[0] and not b[0] for a, b in pairs),
            "arrivals_lost": sum(b[1] and not a[1] for a, b in pairs),
            "arrivals_won": sum(a[1] and not b[1] for a, b in pairs)}


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
            [", ".join(f"{100 * row[part]:.0f}" for part in ("reached", "false_goal", "stuck", "slip_stop", "no_path"))
             for row in cells] +
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
    rows = []
    for key, trials in cells.items():
        rows.append(dict(zip(AXES, key)) | summary(list(trials.values())) |
                    paired(trials, cells[(*key[:2], UNCHECKED)]))
    return rows


def main():
    parser = study.argument_parser(__doc__)
    study.add_sweep_arguments(parser, "slip_closed_loop",
                              "write the tables between the marks slip_endings and slip_alarms of this page")
    args = parser.parse_args()
    cells, note = study.counted_sweep(args, SWEEP, read_cells)
    rows = count(cells)
    args.out.mkdir(parents=True, exist_ok=True)
    study.write_csv(args.out / "slip_closed_loop.csv",
                    [{name: round(value, 5) if isinstance(value, float) else value for name, value in row.items()}
                     for row in rows])
    for name, text in {"slip_endings": endings_table(rows), "slip_alarms": alarms_table(rows)}.items():
        study.show(args, name, text + note)


if __name__ == "__main__":
    main()
