"""Whether scripts/calibrations/fit_stereo_errors.py finds the errors that there are.

Usage: fit_stereo_test.py ROCKYARD
"""

import argparse
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

import pandas

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts/studies"))

import study  # noqa: E402, F401  (knows where calibrations are)
from calibrations import fit_stereo_errors as fit  # pylint: disable=wrong-import-position
from stereo import stereo  # pylint: disable=wrong-import-position

ROCKYARD = None
SIDE_PX = 7


def perfect_cell():
    """The sums of a cell of 1000 pixels without any error."""
    sums = {name: 1000.0 for name in ("pixels", "matched", "good", "plain_pixels", "plain_good",
                                      "shadow_pixels", "shadow_good")}
    sums |= {name: 0.0 for name in ("wrong", "plain_wrong", "shadow_wrong", "error_px", "bias_px")}
    sums["plain_error_px"] = 10.0
    sums |= {f"pairs_{lag}": 100.0 for lag in range(1, 8)}
    sums |= {f"product_px2_{lag}": 0.0 for lag in range(1, 8)}
    sums |= {f"{side}_{kind}_{i}": 10.0 for i in range(1, 9) for kind in ("pixels", "matched")
             for side in ("front", "behind")}
    sums |= {f"{side}_wrong_{i}": 0.0 for i in range(1, 9) for side in ("front", "behind")}
    return sums


class Fits(unittest.TestCase):
    def test_window_is_the_one_whose_overlap_is_found(self):
        for side in (1, 2, 5, 7, 12):
            found = [max(1 - lag / side, 0.0) for lag in range(1, 8)]
            self.assertEqual(fit.window_of(found), side)
        self.assertEqual(fit.window_of([0.81, 0.62, 0.37, 0.22, 0.0, -0.03, 0.02]), 5)

    def test_edges_reach_as_far_as_matches_go_wrong(self):
        pixels = [100.0] * 8
        self.assertEqual(fit.reach_of(pixels, [60, 60, 60, 10, 10, 10, 10, 10], 0.1), (3, 0.6))
        self.assertEqual(fit.reach_of(pixels, [10.0] * 8, 0.1), (0, 0.1))
        reach, level = fit.reach_of(pixels, [80, 60, 40, 40, 12, 9, 10, 8], 0.1)
        self.assertEqual(reach, 4)
        self.assertAlmostEqual(level, 220 / 400)
        # Where nothing was seen, nothing is fitted.
        self.assertEqual(fit.reach_of([0.0] * 8, [0.0] * 8, 0.1), (0, 0.1))

    def test_each_parameter_comes_from_its_own_counts(self):
        cell = perfect_cell() | {"matched": 900.0, "wrong": 9.0, "plain_good": 700.0,
                                 "plain_wrong": 50.0, "plain_error_px": 7.0, "shadow_good": 600.0,
                                 "behind_wrong_1": 6.0, "front_wrong_1": 5.0, "front_wrong_2": 10.0,
                                 "front_matched_1": 6.0}
        fitted = fit.fit(fit.Cell(pandas.DataFrame([cell])), SIDE_PX)
        self.assertEqual(fitted["disparity_noise_px"], 0.1)
        self.assertEqual(fitted["dropout_probability"], 0.25)
        # 0.6 = 0.75 (1 - q).
        self.assertEqual(fitted["shadow_dropout_probability"], 0.2)
        self.assertEqual(fitted["mismatch_probability"], 0.0)
        self.assertEqual(fitted["noise_window_px"], 1)
        self.assertEqual(fitted["edge_reach_px"], 2)
        self.assertEqual(fitted["edge_mismatch_probability"], round(21 / 36, 4))
        self.assertEqual(fitted["edge_dropout_probability"], 0.1)
        self.assertEqual(fitted["margin_px"], 3)

    def test_no_chance_is_negative(self):
        cell = perfect_cell() | {"plain_good": 900.0}
        fitted = fit.fit(fit.Cell(pandas.DataFrame([cell])), SIDE_PX)
        self.assertEqual(fitted["shadow_dropout_probability"], 0.0)

    def test_fragment_is_a_scenario_of_texture_light_and_errors(self):
        document = fit.fragment(0.5, {"sensors.sun.elevation_deg": 20}, "words", {"disparity_noise_px": 0.1})
        self.assertEqual(document, {"description": "words", "sensors": {
            "look": {"soil_graininess": 0.5}, "sun": {"elevation_deg": 20},
            "stereo": {"fidelity": "error_model", "disparity_noise_px": 0.1}}})


class Cells(unittest.TestCase):
    def test_runs_of_a_cell_add_up(self):
        rows = pandas.DataFrame([(1, 2), (3, 4), (1, 5)], columns=["nearest_m", "good"])
        cells = fit.cells_by(rows, "nearest_m")
        self.assertEqual({key: cell["good"] for key, cell in cells.items()}, {(1,): 7, (3,): 4})

    def test_table_predicts_range_errors_from_disparity(self):
        row = {"nearest_m": 1.0, "farthest_m": 2.0, "pixels": 8.0, "matched": 5.0, "good": 4.0, "wrong": 1.0,
               "error_px": 0.04, "bias_px": 0.4, "range_m": 6.0, "range_error_m": 0.0036,
               "range_step_m": 0.16, "axis_step_m": 0.36}
        line = stereo.table_of("range", pandas.DataFrame([row])).splitlines()[-1]
        # 0.1 px; 3 cm beside 0.1 sqrt(0.09) = 3 cm on the axis and 2 cm along the ray.
        for value in ("1 to 2", "0.100", "+0.100", "150", "3.00 | 3.00 | 2.00 | 1.50"):
            self.assertIn(f"| {value} |", line)
        self.assertTrue(line.split("|")[2].startswith(" 62.5 ("))


class Recovery(unittest.TestCase):
    """The error model itself is fitted: its parameters come back."""

    # What the error model is run with.
    TRUE = {"disparity_noise_px": 0.12, "noise_window_px": 4,
            "dropout_probability": 0.15, "edge_dropout_probability": 0.3,
            "edge_mismatch_probability": 0.5, "edge_reach_px": 2,
            "shadow_dropout_probability": 0.3}

    def test_parameters_of_the_error_model_come_back(self):
        settings = {"sensors.stereo.fidelity": "error_model"}
        settings |= {f"sensors.stereo.{name}": value for name, value in self.TRUE.items()}
        with tempfile.TemporaryDirectory() as folder:
            args = argparse.Namespace(rockyard=ROCKYARD, out=Path(folder), runs=4, threads=1, set=[], programs=set())
            cell = fit.Cell(fit.run(args, "model", 1, settings))
        self.assertEqual(cell["looks"], 36)
        fitted = fit.fit(cell, SIDE_PX)
        self.assertEqual(fitted["noise_window_px"], 4)
        self.assertEqual(fitted["edge_reach_px"], 2)
        # 36 looks with some 10^5 plain pixels, 16 of which count as one for the noise.
        plain = cell["plain_pixels"]
        self.assertGreater(plain, 3e4)
        self.assertLess(abs(fitted["disparity_noise_px"] / 0.12 - 1), 3.9 * math.sqrt(2 * 16 / plain))
        for name, base in (("dropout_probability", "plain_pixels"), ("shadow_dropout_probability", "shadow_pixels")):
            share = self.TRUE[name]
            # Alpha = 1e-4, and half as much again for what one is divided by the other.
            limit = 1.5 * 3.9 * math.sqrt(share * (1 - share) / cell[base])
            self.assertLess(abs(fitted[name] - share), limit, name)
            self.assertGreater(abs(fitted[name] - 1.5 * share), limit, name)  # negative control
        # In shadow as well beside a jump: more than 0.3, less than 1 - 0.7^2.
        self.assertGreater(fitted["edge_dropout_probability"], 0.28)
        self.assertLess(fitted["edge_dropout_probability"], 0.51)
        # Where nothing is across a jump, or what is not searched, no match goes wrong.
        self.assertLess(abs(fitted["edge_mismatch_probability"] - 0.5), 0.08)


class Shipped(unittest.TestCase):
    def test_every_texture_and_light_has_its_fragment(self):
        for texture, graininess in fit.TEXTURES.items():
            for light, (_, settings) in fit.LIGHTS.items():
                path = fit.FRAGMENTS / f"fitted_stereo_{texture}_{light}.json"
                sensors = json.loads(path.read_text(encoding="utf-8"))["sensors"]
                self.assertEqual(sensors["look"]["soil_graininess"], graininess)
                self.assertEqual(sensors["sun"]["elevation_deg"], settings["sensors.sun.elevation_deg"])
                self.assertEqual(sensors["stereo"]["fidelity"], "error_model")

    def test_the_page_has_every_table(self):
        page = (ROOT / "results/stereo_sensing.md").read_text(encoding="utf-8")
        for name in (*stereo.FACTORS, "fit", "levels", "noise"):
            begin, end = f"<!-- begin stereo_{name} -->\n", f"\n<!-- end stereo_{name} -->"
            self.assertEqual((page.count(begin), page.count(end)), (1, 1), name)
            table = page.split(begin)[1].split(end)[0]
            self.assertIn("| --- |", table, name)
            self.assertIn("made by rockyard", table, name)


if __name__ == "__main__":
    ROCKYARD = Path(sys.argv.pop(1))
    unittest.main()
