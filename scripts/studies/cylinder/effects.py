#!/usr/bin/env python3
"""What the assumed pictures do to both finders of the coloured cylinder, and what the finders do for a rover.

    scripts/studies/cylinder/effects.py [--seed 1] [--tables assumptions,drives] [--markdown PAGE]

assumptions: scenarios/cylinder/views.json, each assumption of the cylinder's colours, the camera, the light and the
background alone at the ends of its range, and neighbours together, on the same scenes: what is found, how well, and
how many poses are wrong. drives: 10 m over nominal terrain (scenarios/localization), found by the lander every
2.5 m as each finder would, on the same rocks and noise. --markdown writes them between <!-- begin cylinder_NAME -->
and <!-- end cylinder_NAME --> of a page. Delete the runs after a change of the code.
"""

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])  # what studies share
import study  # noqa: E402
from study import rates  # noqa: E402
from cylinder import cylinder  # noqa: E402

PICTURE = "cylinder_sighting.picture"
# Each towards the other by what a channel may be off.
PINK, ORANGE = "[0.95,0.3,0.5]", "[1.0,0.3,0.2]"
# What is changed, with its values: ends of the ranges that the parameters state (rockyard parameters).
ASSUMPTIONS = {
    "as assumed": {},
    "no crosstalk between channels": {"cameras.crosstalk": 0.0},
    "crosstalk 0.3": {"cameras.crosstalk": 0.3},
    "colours as sharp as brightness": {"cameras.colour_blur_px": 0.0},
    "colours blurred by 2 px": {"cameras.colour_blur_px": 2.0},
    "lens 0.3 px": {"cameras.blur_px": 0.3},
    "lens 0.7 px": {"cameras.blur_px": 0.7},
    "gamma 0.45": {"cameras.gamma": 0.45},
    "exposure 0.2": {"cameras.exposure_level": 0.2},
    "exposure 0.5": {"cameras.exposure_level": 0.5},
    "read noise of 3 counts": {"cameras.read_noise_counts": 3.0},
    "balanced for a sun at 20 deg": {"cameras.balance_elevation_deg": 20.0},
    "balanced for a sun at 70 deg": {"cameras.balance_elevation_deg": 70.0},
    "half of the dust's light from the sky": {"light.diffuse_share": 0.5},
    "white sky": {"light.sky": "[1.0,1.0,1.0]"},
    "darker blue": {"target.blue": "[0.02,0.2,0.75]"},
    "paler blue": {"target.blue": "[0.22,0.4,0.95]"},
    "pink towards orange": {"target.pink": PINK},
    "orange towards pink": {"target.orange": ORANGE},
    "both towards each other": {"target.pink": PINK, "target.orange": ORANGE},
    "both, and crosstalk 0.3": {"target.pink": PINK, "target.orange": ORANGE, "cameras.crosstalk": 0.3},
    "redder ground": {"backdrop.ground": "[0.5,0.25,0.12]"},
    "greyer ground": {"backdrop.ground": "[0.4,0.3,0.22]"},
    "ground of most contrast": {"backdrop.contrast": 0.25, "backdrop.hue_contrast": 0.1},
    "half of the rocks pinkish": {"clutter.red_share": 0.5},
}
FIX = "sensors.aids.lander_fix"
# What finds the rover: a scenario of localization, and settings.
DRIVES = {
    "nothing": ("drive", []),
    "errors of the text": ("drive", [f"{FIX}.enabled=true", f"{FIX}.every_m=2.5"]),
    "the published finder": ("drive_cylinder", []),
    "ours": ("drive_cylinder_ours", []),
}


def run(args, trials, scenario, name, settings):
    """The rows of a run, made or taken as it is, and a note on the program."""
    return cylinder.run(args, study.ROOT / f"scenarios/{scenario}.json", trials,
                        args.out / f"{name.replace(' ', '_')}-{args.seed}", settings)


def assumption_line(name, rows):
    line = [name]
    for finder in cylinder.FINDERS:
        sums = cylinder.Sums(rows, finder)
        found, wrong = (100 * sums[column] / sums.measurements for column in ("found", "wrong"))
        line += [f"{found:.0f}", cylinder.errors(sums, "right_orientation", "_deg", 1.0), f"{wrong:.1f}"]
    return line


def assumptions(args):
    """The table of assumptions, and a note on it."""
    lines, made = [], ""
    for name, values in ASSUMPTIONS.items():
        settings = [f"{PICTURE}.{path}={value}" for path, value in values.items()]
        rows, made = run(args, args.views, "cylinder/views", name, settings)
        lines.append(assumption_line(name, rows))
    heads = [f"{called}: {head}" for called in cylinder.FINDERS.values()
             for head in ("found, %", "orientation error, deg", "wrong, %")]
    return study.table(["views", *heads], lines), f"{args.views} views each, seed {args.seed}{made}."


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def drive_line(name, rows):
    reached = rows.outcome.eq("goal_reached")
    low, high = rates.wilson_interval(reached.sum(), len(rows))
    errors = (rows[column].abs().dropna() for column in ("position_error_m", "heading_error_deg"))
    return [name, f"{100 * reached.mean():.0f} ({100 * low:.0f}..{100 * high:.0f})",
            *(" / ".join(f"{values.quantile(share, 'higher'):.2f}" for share in (0.5, 0.95)) for values in errors),
            f"{rows.aids_used.mean():.1f}", f"{rows.aids_gated_out.mean():.2f}"]


def drives(args):
    """The table of drives, and a note on it."""
    lines, made = [], ""
    for name, (scenario, settings) in DRIVES.items():
        rows, made = run(args, args.drives, f"localization/{scenario}", f"drives {name}",
                         ["rover.fidelity=quasi_static", *settings])
        lines.append(drive_line(name, rows))
    heads = ["found by", "true success, % (95 %)", "position error, m: median / 95 %", "heading error, deg: the same",
             "fixes used", "refused by the filter"]
    return study.table(heads, lines), f"{args.drives} drives each, seed {args.seed}{made}."


TABLES = {"assumptions": assumptions, "drives": drives}


def main():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, None, "cylinder_effects")
    parser.add_argument("--views", type=int, default=324, help="views of each assumption (324)")
    parser.add_argument("--drives", type=int, default=300, help="drives with each finder (300)")
    parser.add_argument("--count-only", action="store_true", help="the runs are there: count them")
    args = study.parse_with_tables(parser, TABLES)
    for name in args.tables.split(","):
        table, note = TABLES[name](args)
        study.show(args, {f"cylinder_{name}": f"{table}\n\n{note}"})


if __name__ == "__main__":
    main()
