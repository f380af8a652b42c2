#!/usr/bin/env python3
"""Fits the error model of stereo cameras to images, by texture and light, and holds both side by side.

For each texture of the soil and each light scenarios/stereo_sensing/range.json is run from images: looks
from random places, of each the pixels and rocks of a bin of distances. What is counted gives the
parameters of sensors.stereo's error model:
  disparity_noise_px           root mean square error of matches off by less than 1 px, plain pixels
  noise_window_px              1 - k/w nearest to the correlation of errors k columns apart, k = 1 to 7
  mismatch_probability         0: wrong matches of plain pixels lie in blobs near the truth; single ones anywhere in
                               the searched range, as many, make hazards of most clear cells
  dropout_probability          plain pixels (lit, away from jumps in depth) without a match
  edge_reach_px, edge_mismatch_probability   two levels of wrong matches by columns from a jump in depth
  edge_dropout_probability     pixels within that reach, on both sides, without a match
  shadow_dropout_probability   what pixels in shadow lose beyond plain ones
  margin_px                    half of the window that is matched
They are written as scenarios/sensors/fitted_stereo_<texture>_<light>.json. Then the error model runs with
them at the same places, on the same seed or on another one (--confirm), and a table says what it meets and
what it cannot. Runs that are there already are resumed; after a change of the code delete them.

    scripts/calibrations/fit_stereo_errors.py [--runs 4] [--seed 1] [--confirm 2] [--markdown results/stereo_sensing.md]
"""

import argparse
import json
import math
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1] / "studies")
import study  # noqa: E402
from study import rates  # noqa: E402

SCENARIO = study.ROOT / "scenarios/stereo_sensing/range.json"
FRAGMENTS = study.ROOT / "scenarios/sensors"
# Up to 4 m, where the cameras' range ends; the error model takes that end for a jump in depth.
BINS = [0.5, 1.5, 2.5, 3.5]
TEXTURES = {"drift": 0, "middle": 0.5, "gravel": 1}
LIGHTS = {
    "noon": ("the sun at 60 degrees", {"sensors.sun.elevation_deg": 60}),
    "low_sun": ("the sun at 20 degrees", {"sensors.sun.elevation_deg": 20}),
    # Hardly any direct light is left: exp(-4 / sin 60 deg) is 1 %.
    "overcast": ("the sun at 60 degrees behind dust of optical depth 4",
                 {"sensors.sun.elevation_deg": 60, "sensors.sun.optical_depth": 4}),
}
LAGS, EDGES, WIDEST = 7, 8, 31
HEIGHTS = ("05", "10", "15", "20")


class Cell:
    """Columns of the runs of a cell, added up; `runs` keeps them apart."""

    def __init__(self, runs):
        self.runs = runs

    def __getitem__(self, column):
        return self.runs[column].sum()

    def share(self, part, whole):
        """part / whole with its 95 % interval, runs being what is independent."""
        return rates.share(self.runs[part], self.runs[whole])

    def mean(self, column, base):
        return self[column] / self[base] if self[base] else math.nan

    def rms(self, column, base):
        return math.sqrt(self.mean(column, base))


def cells_by(rows, *factors):
    """Cells by the values of some factors, in the order in which they come."""
    return {key: Cell(runs) for key, runs in study.cells_of(rows, factors).items()}


def correlations(cell):
    """Of errors of plain pixels 1 to 7 columns apart; by the mean square of plain ones."""
    square = cell.mean("plain_error_px", "plain_good")
    return [cell.mean(f"product_px2_{lag}", f"pairs_{lag}") / square for lag in range(1, LAGS + 1)]


def window_of(found):
    """The side w of windows of which 1 - k/w, at least 0, lies nearest to what was found."""
    def misfit(side):
        return sum((max(1 - (i + 1) / side, 0.0) - value) ** 2 for i, value in enumerate(found))
    return min(range(1, WIDEST + 1), key=misfit)


def reach_of(pixels, hit, beyond):
    """Reach and chance of the two-level law nearest to what was found by columns from a jump.

    Of `pixels`, `hit` were; columns beyond the reach have the chance `beyond`.
    """
    found = [part / whole if whole else beyond for part, whole in zip(hit, pixels)]
    best = (0, beyond, math.inf)
    for reach in range(len(pixels) + 1):
        inside = sum(pixels[:reach])
        level = sum(hit[:reach]) / inside if inside else beyond
        misfit = sum(n * (value - (level if i < reach else beyond)) ** 2
                     for i, (n, value) in enumerate(zip(pixels, found)))
        # Further columns have to explain more than rounding does.
        if misfit < best[2] - 1e-9:
            best = (reach, level, misfit)
    return best[0], best[1]


def fit(cell, window_side_px):
    """The parameters of the error model, by name in sensors.stereo."""
    plain = 1 - (cell["plain_good"] + cell["plain_wrong"]) / cell["plain_pixels"]
    shadow = plain
    if cell["shadow_pixels"]:
        shadow = 1 - (cell["shadow_good"] + cell["shadow_wrong"]) / cell["shadow_pixels"]
    columns = lambda what: [sum(cell[f"{side}_{what}_{i}"] for side in ("front", "behind"))
                            for i in range(1, EDGES + 1)]
    plain_wrong = cell["plain_wrong"] / (cell["plain_good"] + cell["plain_wrong"])
    reach, mixed = reach_of(columns("matched"), columns("wrong"), plain_wrong)
    edge = 1 - sum(columns("matched")[:reach]) / sum(columns("pixels")[:reach]) if reach else plain
    chance = lambda value: round(min(max(value, 0.0), 0.999), 4)
    return {
        "disparity_noise_px": round(cell.rms("plain_error_px", "plain_good"), 4),
        "noise_window_px": window_of(correlations(cell)),
        "mismatch_probability": 0.0,
        "dropout_probability": chance(plain),
        "edge_dropout_probability": chance(edge),
        "edge_mismatch_probability": chance(mixed),
        "edge_reach_px": reach,
        "shadow_dropout_probability": chance((shadow - plain) / (1 - plain) if plain < 1 else 0.0),
        "margin_px": window_side_px // 2,
    }


def percent(cell, part, whole):
    return study.with_interval(cell.share(part, whole), 1, 100.0)


def describe(texture, light, cell, args):
    return (f"Errors of the stereo cameras' error model as counted in images: {texture} soil, {light}. "
            f"Of {cell['pixels']:.0f} pixels that both eyes of the Athena SDM saw in "
            f"{cell['looks']:.0f} looks from random places of Viking Lander 2 terrain (seed {args.seed}), "
            f"{percent(cell, 'matched', 'pixels')} % were matched, of these "
            f"{percent(cell, 'wrong', 'matched')} % off by 1 px or more; the rest has a root mean "
            f"square error of {cell.rms('error_px', 'good'):.3f} px and a mean of "
            f"{cell.mean('bias_px', 'good'):+.3f} px. By scripts/calibrations/fit_stereo_errors.py; texture and light are assumptions.")


def fragment(texture, settings, description, fitted):
    """The scenario that holds texture, light and the fitted errors."""
    return study.nested({"sensors.look.soil_graininess": texture} | settings | {"sensors.stereo.fidelity": "error_model"} | {
        f"sensors.stereo.{name}": value for name, value in fitted.items()}, {"description": description})


def run(args, name, seed, settings):
    """Runs the scenario with settings, or takes the run that is there; its records pooled."""
    own = argparse.Namespace(**vars(args) | {"seed": seed, "trials": args.runs * (len(BINS) - 1)})
    held = {"stereo_sensing.distances_m": json.dumps(BINS)} | settings
    found = study.run_scenario(own, SCENARIO, args.out / f"{name}-{seed}-{args.runs}",
                               [f"{path}={value}" for path, value in held.items()] + args.set)
    args.programs.add(study.program(found))
    return study.counted(found)


def side_by_side(name, images, model):
    """Rows of the table of both levels."""
    def row(what, value):
        return [name, what, value(images), value(model)]
    rocks = [row(f"rocks of {int(height) / 50:.1f} to {int(height) / 50 + 0.1:.1f} m found, %"
                 if height != "20" else "rocks of 0.4 m or more found, %",
                 lambda cell, h=height: percent(cell, f"found_{h}", f"rocks_{h}"))
             for height in HEIGHTS]
    return [
        row("pixels matched, %", lambda cell: percent(cell, "matched", "pixels")),
        row("of these off by 1 px or more, %", lambda cell: percent(cell, "wrong", "matched")),
        row("rms error of the others, px", lambda cell: f"{cell.rms('error_px', 'good'):.3f}"),
        row("their mean error, px", lambda cell: f"{cell.mean('bias_px', 'good'):+.3f}"),
        row("rms error of range, cm", lambda cell: f"{100 * cell.rms('range_error_m', 'good'):.2f}"),
        row("right before an edge, %", lambda cell: percent(cell, "front_good", "front_pixels")),
        row("right behind an edge, %", lambda cell: percent(cell, "behind_good", "behind_pixels")),
        row("off by 1 px or more there, %", lambda cell: percent(cell, "behind_wrong", "behind_pixels")),
        row("right in shadow, %", lambda cell: percent(cell, "shadow_good", "shadow_pixels")),
        row("matched in margins, %", lambda cell: percent(cell, "margin_matched", "margin_pixels")),
        row("matched though hidden, %", lambda cell: percent(cell, "hidden_matched", "hidden_pixels")),
        row("correlation 1, 3, 7 columns apart",
            lambda cell: ", ".join(f"{correlations(cell)[lag - 1]:.2f}" for lag in (1, 3, 7))),
        *rocks,
        row("clear cells that are known, %", lambda cell: percent(cell, "clear_known", "clear_cells")),
        row("hazards imagined there, %", lambda cell: percent(cell, "imagined", "clear_known")),
        row("hazard cells found, %", lambda cell: percent(cell, "hazard_found", "hazard_cells")),
    ]


def by_range(name, images, model):
    """Rows of the table of noise by range."""
    rows = []
    for (near, far), cell in cells_by(images, "nearest_m", "farthest_m").items():
        other = cells_by(model, "nearest_m", "farthest_m")[near, far]
        rows.append([name, f"{near:g} to {far:g}",
                     *(f"{one.rms('plain_error_px', 'plain_good'):.3f}" for one in (cell, other)),
                     *(percent(one, "plain_good", "plain_pixels") for one in (cell, other))])
    return rows


def arguments():
    parser = study.argument_parser(__doc__)
    study.add_run_arguments(parser, None, "stereo_fit")
    study.add_page(parser)
    parser.add_argument("--runs", type=int, default=4, help="of some looks each, of each texture, light and bin (4)")
    parser.add_argument("--confirm", type=int, default=2, help="seed of the comparison (2)")
    parser.add_argument("--textures", default=",".join(TEXTURES), help="which, joined by commas")
    parser.add_argument("--lights", default=",".join(LIGHTS), help="which, joined by commas")
    parser.add_argument("--fragments", type=Path, default=FRAGMENTS, help="where they are written")
    args = parser.parse_args()
    for names, known in ((args.textures, TEXTURES), (args.lights, LIGHTS)):
        for name in names.split(","):
            if name not in known:
                parser.error(f"{name} is none of {', '.join(known)}")
    args.programs = set()
    return args


def main():
    args = arguments()
    stereo = "sensors.stereo."
    side = study.ry.Scenario(SCENARIO)["perception.stereo.window_side_px"]
    levels, ranges, parameters = [], [], []
    for texture in args.textures.split(","):
        for light in args.lights.split(","):
            name, (words, settings) = f"{texture}, {light}".replace("_", " "), LIGHTS[light]
            held = {"sensors.look.soil_graininess": TEXTURES[texture]} | settings
            images = run(args, f"image-{texture}-{light}", args.seed, held)
            fitted = fit(Cell(images), side)
            document = fragment(TEXTURES[texture], settings, describe(texture, words, Cell(images), args), fitted)
            path = args.fragments / f"fitted_stereo_{texture}_{light}.json"
            path.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
            parameters.append([name, *(f"{value:g}" for value in fitted.values())])
            unseen = run(args, f"image-{texture}-{light}", args.confirm, held)
            model = run(args, f"model-{texture}-{light}", args.confirm, held | {
                stereo + key: value for key, value in (fitted | {"fidelity": "error_model"}).items()})
            unseen_looks = Cell(unseen)["looks"]
            levels += side_by_side(name, Cell(unseen), Cell(model))
            ranges += by_range(name, unseen, model)
    note = (f"{unseen_looks:.0f} looks each, fitted on seed {args.seed}, compared on seed {args.confirm}; "
            f"made by rockyard {' and '.join(sorted(args.programs))}.")
    study.show(args, {
        "stereo_fit": study.table(["texture, light", *fitted], parameters),
        "stereo_levels": study.table(["texture, light", "what", "images", "error model"], levels),
        "stereo_noise": study.table(
            ["texture, light", "range, m", "rms error, px: images", "error model",
             "plain pixels matched, %: images", "error model"], ranges)}, f"\n\n{note}")


if __name__ == "__main__":
    main()
