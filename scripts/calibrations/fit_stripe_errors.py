#!/usr/bin/env python3
"""Fits the error model of the geometric light stripe sensor to its image level.

Runs stripe_error_study (target benchmarks) for some conditions of light: both levels look at
the same scenes, flat ground and rocks, and each point that geometry shows is found right (within two
columns), missed or misplaced by the images and the finder of stripes. Writes for each condition
scenarios/sensors/fitted_<light>.json: the light, and the errors as counted, with the counts and 95 %
(Wilson) intervals in the description.

    scripts/calibrations/fit_stripe_errors.py --study build/test/tests/trial/stripe_error_study [--scenes 400]
"""

import json
import sys
from pathlib import Path
from statistics import NormalDist

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from study import rates  # noqa: E402

SCENES = study.ROOT / "scenarios/pathfinder/nominal.json"
RIGHT_PX = 2

# Where the assumptions on which images depend lie at the far ends of their study ranges.
FAINT = {"sensors.sun.elevation_deg": 60, "sensors.sun.distance_au": 1,
         "sensors.sun.optical_depth": 0.3,
         "sensors.light_stripe.laser.optical_efficiency": 0.02,
         "sensors.light_stripe.imager.filter_width_m": 1e-7,
         "sensors.light_stripe.imager.ccd.read_noise_e": 150}
FAINT_NAME = ("Earth, sun at 60 degrees, emitters, filter and imager at the worst ends of their "
              "study ranges, lasers of ")
LIGHTS = {
    "mars_noon": ("Mars, sun at 60 degrees", {"sensors.sun.elevation_deg": 60}),
    "mars_low_sun": ("Mars, sun at 10 degrees", {"sensors.sun.elevation_deg": 10}),
    "earth_faint": (FAINT_NAME + "0.66 W", FAINT),
    "earth_fainter": (FAINT_NAME + "0.3 W",
                      FAINT | {"sensors.light_stripe.laser.input_power_w": 0.3}),
}


def column_noise(offsets):
    """Deviation of a normal variable that, rounded, is 0 as often as the offsets are."""
    total = sum(offsets)
    off = total - offsets[len(offsets) // 2]
    return 0.5 / NormalDist().inv_cdf(1 - 0.5 * off / total) if off else 0.0


def count(program, scenes, settings):
    """Tallies of flat ground and of rocks, summed."""
    told = json.loads(study.run([program, SCENES, scenes, *(f"{path}={value}" for path, value in settings.items())]))
    flat, rocks = told["flat"], told["rocks"]
    total = {key: flat[key] + rocks[key] for key in ("visible", "missed", "misplaced", "hidden", "ghosts")}
    for key in ("visible_at", "missed_at", "offsets"):
        total[key] = [a + b for a, b in zip(flat[key], rocks[key])]
    return total


def describe(name, scenes, tally):
    """What was counted, in words."""
    def share(label, key, trials):
        low, high = rates.wilson_interval(tally[key], trials)
        return (f"{label} {tally[key]} of {trials} ({100 * tally[key] / trials:.2g} %, 95 % interval "
                f"{100 * low:.2g} to {100 * high:.2g} %)")
    return (f"Errors of the geometric light stripe sensor as counted at the image level: {name}. "
            f"Of points that geometry shows on {scenes} scenes of flat ground and {scenes} of nominal "
            f"rocks, {share('missed', 'missed', tally['visible'])}, "
            f"{share(f'found more than {RIGHT_PX} columns off', 'misplaced', tally['visible'])}; "
            f"found where geometry hides them: {tally['ghosts']} of {tally['hidden']}, which the "
            f"model leaves out. By scripts/calibrations/fit_stripe_errors.py; the light is an assumption.")


def fragment(name, settings, scenes, tally):
    """The scenario that holds the light and the fitted errors."""
    fitted = {
        "sensors.light_stripe.wrong_place_probability":
            round(tally["misplaced"] / tally["visible"], 6),
        "sensors.light_stripe.missed_at":
            [round(m / v, 4) for m, v in zip(tally["missed_at"], tally["visible_at"])],
        "sensors.light_stripe.column_noise_px": round(column_noise(tally["offsets"]), 3),
    }
    return study.nested(settings | fitted, {"description": describe(name, scenes, tally)})


def main():
    parser = study.argument_parser(__doc__)
    parser.add_argument("--study", required=True, help="path of stripe_error_study")
    parser.add_argument("--scenes", type=int, default=400, help="of each kind and light")
    parser.add_argument("--out", type=Path, default=study.ROOT / "scenarios/sensors")
    arguments = parser.parse_args()
    for light, (name, settings) in LIGHTS.items():
        tally = count(arguments.study, arguments.scenes, settings)
        document = fragment(name, settings, arguments.scenes, tally)
        path = arguments.out / f"fitted_{light}.json"
        path.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
        print(f"{path.name}: {document['description']}")


if __name__ == "__main__":
    main()
