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
from study import rates  # noqa: E402

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

# Of a mean in the file of pairs, and its member of a comparison.
PARTS = {"n": "n", "mean_a": "first", "mean_b": "second", "difference": "difference", "ci95_low": "low", "ci95_high": "high"}


def arms_at(abundance):
    return list(ARMS) if abundance in CROSSED else list(MAIN)


def drive(args, rover, abundance, arm):
    ending, settings = ARMS[arm]
    name = "".join(letter if letter.isalnum() else "_" for letter in arm)
    print(f"{rover} k {abundance:g} {arm}", file=sys.stderr)
    return study.run_scenario(args, SCENARIOS / f"{ROVERS[rover]}{ending}.json", args.out / rover / f"{abundance:g}" / name,
                              [*args.set, *settings, f"{ABUNDANCE}={abundance:g}"])


def summary_row(rover, abundance, arm, run):
    row = {"rover": rover, "k_per_m2": abundance, "arm": arm, "trials": len(run.counted)}
    for kind, rate in (("declared", run.declared_success), ("true", run.true_success)):
        row |= zip((kind, f"{kind}_low", f"{kind}_high"), rate)
    row["failures"] = study.ends(run, *study.ARRIVED, none="")
    return row | {"program": study.program(run)}


def pair_row(rover, abundance, pair, runs):
    success, means = study.compare(*(runs[arm] for arm in pair))
    row = {"rover": rover, "k_per_m2": abundance, "first": pair[0], "second": pair[1]}
    for kind, values in success.items():
        row |= zip((f"{kind}_points", f"{kind}_low", f"{kind}_high", f"{kind}_p"), values)
    for trials in ("all", "arrived"):
        for column in MEANS:
            found = means.get((trials, column), {"n": 0})
            # A mean over no trial is no number.
            row |= {f"{trials}_{column}_{name}": float("nan" if found.get(key) is None else found[key])
                    for name, key in PARTS.items()}
    return row


def adjust(pairs):
    """Holm over every test of the study."""
    places = [(row, kind) for row in pairs for kind in ("declared", "true")]
    for (row, kind), adjusted in zip(places, rates.holm(row[f"{kind}_p"] for row, kind in places)):
        row[f"{kind}_holm"] = adjusted


def rates_table(rows):
    percent = lambda kind: lambda row: study.interval_of(row, kind, 0, 100.0)
    return study.listed(rows, {"rover": "{rover}", "k (1/m2)": "{k_per_m2:g}", "navigator, sensor": "{arm}",
                               "declared (%)": percent("declared"), "true (%)": percent("true"), "failures": "{failures}"})


def mean_difference(row, trials, column, digits, scale):
    """Difference of means with its interval; '-' where too few pairs are there to resample."""
    if float(row[f"{trials}_{column}_n"]) < FEWEST_PAIRS:
        return "-"
    values = [float(row[f"{trials}_{column}_{key}"]) for key in ("difference", "ci95_low", "ci95_high")]
    return study.with_interval(values, digits, scale)


def pairs_table(pairs, trials):
    mean = lambda column, digits, scale: lambda row: mean_difference(row, trials, column, digits, scale)
    return study.listed(pairs, {
        "rover": "{rover}", "k (1/m2)": "{k_per_m2:g}", "first": "{first}", "second": "{second}",
        "true success, second less first (points)": "{true_points:+.0f} ({true_low:+.0f}..{true_high:+.0f})",
        "Holm p": "{true_holm:.2g}", "n": f"{{{trials}_true_distance_m_n:.0f}}",
        **{name: mean(column, *rest) for column, (name, *rest) in MEANS.items()}})


def panels(rows):
    """Declared and true success over abundance, by rover."""
    def curve(rover, arm, kind):
        return [(row["k_per_m2"], *(100.0 * row[key] for key in (kind, f"{kind}_low", f"{kind}_high")))
                for row in rows if (row["rover"], row["arm"]) == (rover, arm)]
    return [(f"{rover}: {kind} success (%)", [(arm, curve(rover, arm, kind)) for arm in MAIN])
            for rover in dict.fromkeys(row["rover"] for row in rows) for kind in ("declared", "true")]


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--rovers", nargs="+", choices=list(ROVERS), default=list(ROVERS))
    study.add_run_arguments(parser, trials=200, out="navigators")
    args = parser.parse_args()
    rows, pairs = [], []
    for rover in args.rovers:
        for abundance in ABUNDANCES:
            runs = {arm: drive(args, rover, abundance, arm) for arm in arms_at(abundance)}
            rows += [summary_row(rover, abundance, arm, run) for arm, run in runs.items()]
            pairs += [pair_row(rover, abundance, pair, runs) for pair in PAIRS if set(pair) <= set(runs)]
    adjust(pairs)
    study.write_csv(args.out / "navigators.csv", rows)
    study.write_csv(args.out / "navigators_pairs.csv", pairs)
    study.write_svg(args.out / "navigators.svg", panels(rows), "k (1/m2)")
    programs = ", ".join(sorted({row["program"] for row in rows}))
    text = "\n\n".join([
        rates_table(rows), "Pairs; means over all trials:", pairs_table(pairs, "all"),
        "The same; means over pairs in which both arrived:", pairs_table(pairs, "arrived"),
        f"{args.trials} trials a point, seed {args.seed}, 95 % intervals; Holm over "
        f"{2 * len(pairs)} tests; {study.held(args)}made by "
        f"rockyard {programs}.\n"])
    (args.out / "navigators.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
