#!/usr/bin/env python3
"""Behaviour control against GESTALT on the same rocks, over rock abundance.

Matthies 1995 asks for "evaluating both behavior-based and map-based path selection algorithms at
higher rock frequencies". This drives the same trials (same rocks, same noise) with both navigators, each with
its own sensor, on the Athena SDM and on Rocky 3.2, from nominal terrain to beyond Viking Lander 2; and
at two abundances both navigators with the same stereo cameras, with their full view and with that of the
light stripe array: the 2 x 2 that tells the navigator from its sensor. Writes navigators.csv, navigators_pairs.csv, navigators.md and
navigators.svg. Success is tested by pairs of trials (McNemar, exact), all tests one family (Holm).

    scripts/studies/navigator/navigator.py [--trials 200] [--threads 2]
"""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402

SCENARIOS = study.ROOT / "scenarios/gestalt"
ROVERS = {"athena_sdm": "abundance", "rocky_3_2": "abundance_rocky_3_2"}
ABUNDANCE = "terrain.rocks.k_per_m2"
NOMINAL, VL2 = 0.00415, 0.013  # Matthies 1995, section 7
ABUNDANCES = (NOMINAL, 0.007, 0.010, VL2, 0.020)
CROSSED = (NOMINAL, VL2)  # where navigators and fields of view are crossed

# Name: end of the scenario's file, settings. Stereo of the stripe's view is cropped to the ground of
# that rover's light stripe array; the behaviour controller's bins then cover just that.
ARMS = {
    "behaviour, light stripe": ("_behaviour", []),
    "GESTALT, stereo": ("", []),
    "behaviour, stereo": ("_behaviour_stereo", []),
    "behaviour, stereo of the stripe's view": ("_behaviour_stereo_stripe", []),
    "GESTALT, stereo of the stripe's view": ("", ["sensors.stereo.field_of_view=stripe"]),
}
MAIN = ("behaviour, light stripe", "GESTALT, stereo")
# The rovers as they were meant; then the 2 x 2 of navigators and views of the same cameras, its rows
# and columns; then what the cameras themselves change for the behaviour controller.
PAIRS = [MAIN, ("behaviour, stereo", "GESTALT, stereo"),
         ("behaviour, stereo of the stripe's view", "GESTALT, stereo of the stripe's view"),
         ("behaviour, stereo of the stripe's view", "behaviour, stereo"),
         ("GESTALT, stereo of the stripe's view", "GESTALT, stereo"),
         ("behaviour, light stripe", "behaviour, stereo of the stripe's view")]
FEWEST_PAIRS = 5  # for an interval by the bootstrap
# Columns compared in pairs: name, digits, scale. Time and energy up to the verdict on a stuck rover,
# whether or not it runs on (referee.stuck_rover).
MEANS = {"true_distance_m": ("distance (m)", 2, 1.0),
         "active_time_s": ("time (min)", 1, 1.0 / 60.0), "active_energy_wh": ("energy (Wh)", 2, 1.0)}


def arms_at(abundance):
    return list(ARMS) if abundance in CROSSED else list(MAIN)


def drive(args, rover, abundance, arm):
    ending, settings = ARMS[arm]
    scenario = SCENARIOS / f"{ROVERS[rover]}{ending}.json"
    name = "".join(letter if letter.isalnum() else "_" for letter in arm)
    folder = args.out / rover / f"{abundance:g}" / name
    print(f"{rover} k {abundance:g} {arm}", file=sys.stderr)
    summary = study.run_scenario(args, scenario, folder,
                                 [*args.set, *settings, f"{ABUNDANCE}={abundance:g}"])
    return folder, summary


def summary_row(rover, abundance, arm, folder, summary):
    outcomes = study.trial_columns(folder)["outcome"]
    row = {"rover": rover, "k_per_m2": abundance, "arm": arm, "trials": len(outcomes)}
    for kind in ("declared", "true"):
        success = summary[f"{kind}_success"]
        row |= {kind: success["rate"], f"{kind}_low": success["ci95"][0],
                f"{kind}_high": success["ci95"][1]}
    failures = {outcome: outcomes.count(outcome) for outcome in sorted(set(outcomes))
                if outcome not in ("goal_reached", "false_goal")}
    row["failures"] = ", ".join(f"{name} {count}" for name, count in failures.items())
    row["program"] = study.program(summary)
    return row


def pair_row(args, rover, abundance, pair, folders):
    success, means = study.compare(args.rockyard, *(folders[arm] for arm in pair))
    row = {"rover": rover, "k_per_m2": abundance, "first": pair[0], "second": pair[1]}
    for kind in ("declared", "true"):
        points, low, high, p = success[kind]
        row |= {f"{kind}_points": points, f"{kind}_low": low, f"{kind}_high": high, f"{kind}_p": p}
    for trials in ("all", "arrived"):
        for column in MEANS:
            found = means[trials, column]
            for key in ("n", "mean_a", "mean_b", "difference", "ci95_low", "ci95_high"):
                # A mean over no trial is no number.
                row[f"{trials}_{column}_{key}"] = float(found[key]) if found[key] else float("nan")
    return row


def adjust(pairs):
    """Holm over every test of the study."""
    kinds = ("declared", "true")
    adjusted = study.holm([row[f"{kind}_p"] for row in pairs for kind in kinds])
    for index, row in enumerate(pairs):
        for offset, kind in enumerate(kinds):
            row[f"{kind}_holm"] = adjusted[len(kinds) * index + offset]


def rates_table(rows):
    percent = lambda row, kind: study.with_interval(
        [row[kind], row[f"{kind}_low"], row[f"{kind}_high"]], 0, 100.0)
    return study.table(
        ["rover", "k (1/m2)", "navigator, sensor", "declared (%)", "true (%)", "failures"],
        [[row["rover"], f"{row['k_per_m2']:g}", row["arm"], percent(row, "declared"),
          percent(row, "true"), row["failures"]] for row in rows])


def mean_difference(row, trials, column, digits, scale):
    """Difference of means with its interval; '-' where too few pairs are there to resample."""
    if float(row[f"{trials}_{column}_n"]) < FEWEST_PAIRS:
        return "-"
    values = [float(row[f"{trials}_{column}_{key}"])
              for key in ("difference", "ci95_low", "ci95_high")]
    return study.with_interval(values, digits, scale)


def pairs_table(pairs, trials):
    def mean(row, column):
        _, digits, scale = MEANS[column]
        return mean_difference(row, trials, column, digits, scale)
    return study.table(
        ["rover", "k (1/m2)", "first", "second", "true success, second less first (points)", "Holm p",
         "n", *(name for name, *_ in MEANS.values())],
        [[row["rover"], f"{row['k_per_m2']:g}", row["first"], row["second"],
          f"{row['true_points']:+.0f} ({row['true_low']:+.0f}..{row['true_high']:+.0f})",
          f"{row['true_holm']:.2g}", f"{row[f'{trials}_true_distance_m_n']:.0f}",
          *(mean(row, column) for column in MEANS)] for row in pairs])


def panels(rows):
    """Declared and true success over abundance, by rover."""
    found = []
    for rover in dict.fromkeys(row["rover"] for row in rows):
        for kind in ("declared", "true"):
            series = []
            for arm in MAIN:
                of_arm = [row for row in rows if (row["rover"], row["arm"]) == (rover, arm)]
                series.append((arm, [(row["k_per_m2"], *(100.0 * row[key] for key in
                                                         (kind, f"{kind}_low", f"{kind}_high")))
                                     for row in of_arm]))
            found.append((f"{rover}: {kind} success (%)", series))
    return found


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--rovers", nargs="+", choices=list(ROVERS), default=list(ROVERS))
    study.add_run_arguments(parser, trials=200, out="navigators")
    args = parser.parse_args()
    rows, pairs = [], []
    for rover in args.rovers:
        for abundance in ABUNDANCES:
            folders = {}
            for arm in arms_at(abundance):
                folders[arm], summary = drive(args, rover, abundance, arm)
                rows.append(summary_row(rover, abundance, arm, folders[arm], summary))
            pairs += [pair_row(args, rover, abundance, pair, folders) for pair in PAIRS
                      if set(pair) <= set(folders)]
    adjust(pairs)
    study.write_csv(args.out / "navigators.csv", rows)
    study.write_csv(args.out / "navigators_pairs.csv", pairs)
    study.write_svg(args.out / "navigators.svg", panels(rows), "k (1/m2)")
    programs = ", ".join(sorted({row["program"] for row in rows}))
    text = "\n\n".join([
        rates_table(rows), "Pairs; means over all trials:", pairs_table(pairs, "all"),
        "The same; means over pairs in which both arrived:", pairs_table(pairs, "arrived"),
        f"{args.trials} trials a point, seed {args.seed}, 95 % intervals; Holm over "
        f"{2 * len(pairs)} tests; {'held: ' + ', '.join(args.set) + '; ' if args.set else ''}made by "
        f"rockyard {programs}.\n"])
    (args.out / "navigators.md").write_text(text, encoding="utf-8")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
