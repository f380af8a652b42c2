"""The studies of stereo: their pages hold what they print of the stored figures, and errors of ranges are
counted as their definition says."""

import contextlib
import csv
import io
import json
import math
import tempfile
import unittest
from pathlib import Path

from context import ROOT, np, study
from stereo_speedup import pyramid
from stereo_speedup import stereo_speedup

PAGE = (ROOT / "results/stereo_speed.md").read_text(encoding="utf-8")
TIMES = ROOT / "results/studies/stereo_speedup.json"


def printed(call, *arguments):
    with contextlib.redirect_stdout(io.StringIO()) as out:
        call(*arguments)
    return out.getvalue().strip()


class PageTest(unittest.TestCase):
    """The tables of the page."""

    def setUp(self):
        self.measured = json.loads(TIMES.read_text(encoding="utf-8"))

    def test_speedups(self):
        sides = stereo_speedup.sides_of(self.measured, "section_3")
        self.assertIn(printed(stereo_speedup.print_speedups, sides), PAGE)

    def test_shares(self):
        sides = stereo_speedup.sides_of(self.measured, "table_2")
        self.assertIn(printed(stereo_speedup.print_shares, sides), PAGE)

    def test_times_of_levels(self):
        self.assertIn(printed(pyramid.print_times, self.measured), PAGE)

    def test_errors_of_levels(self):
        with open(ROOT / "results/studies/pyramid_error.csv", encoding="utf-8", newline="") as file:
            rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        for row in rows:
            row["level"] = int(row["level"])
        self.assertIn(printed(pyramid.print_errors, rows), PAGE)

    def test_other_times_are_another_table(self):
        self.measured["cases"][0]["sides"][2]["pairs_per_s"] *= 1.1
        sides = stereo_speedup.sides_of(self.measured, "section_3")
        self.assertNotIn(printed(stereo_speedup.print_speedups, sides), PAGE)


class SpeedupTest(unittest.TestCase):
    """Ratios and shares of made up times: a second of filter and three of blobs, against a half and one."""

    def test_ratio_and_share(self):
        none = dict.fromkeys(("reduce", "rectify", "prepare_row", "compare", "decide"), 0.0)
        sides = {"slow": {"pairs_per_s": 1 / 4, "share": {**none, "filter": 1 / 4, "blob": 3 / 4}},
                 "fast": {"pairs_per_s": 2 / 3, "share": {**none, "filter": 1 / 3, "blob": 2 / 3}}}
        self.assertAlmostEqual(stereo_speedup.speedup(sides, "slow", "fast", ("filter",)), 2.0)
        self.assertAlmostEqual(stereo_speedup.speedup(sides, "slow", "fast", ("blob",)), 3.0)
        self.assertAlmostEqual(stereo_speedup.share(sides["slow"], ("blob",)), 0.75)


class ErrorTest(unittest.TestCase):
    """Errors of ranges against closed forms."""

    def test_pfm_is_read_from_below(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "image.pfm"
            for scale, kind in ((b"-1", "<f4"), (b"1", ">f4")):
                path.write_bytes(b"Pf\n2 2\n" + scale + b"\n" + np.array([3.0, 4.0, 1.0, 2.0], kind).tobytes())
                self.assertEqual(study.read_portable(path).tolist(), [[1.0, 2.0], [3.0, 4.0]])
            path.write_bytes(b"P5\n3 1\n255\n\x00\x0a\xff")
            self.assertEqual(study.read_portable(path).tolist(), [[0.0, 10.0, 255.0]])

    def test_truth_of_a_level_is_the_mean_in_its_pixels(self):
        reduced = pyramid.truth_at(1, np.array([[4.0, 5.0, 8.0, 20.0], [4.0, 5.0, 8.0, 8.0]]))
        self.assertEqual(reduced[0, 0], 2.25)
        self.assertTrue(math.isnan(reduced[0, 1]))  # two surfaces
        self.assertTrue(math.isnan(pyramid.truth_at(1, np.array([[4.0, math.nan], [4.0, 4.0]]))[0, 0]))

    def test_range_does_not_depend_on_the_level(self):
        focal_px = 256 / math.tan(math.radians(22.5))
        self.assertAlmostEqual(pyramid.range_m(focal_px * 0.2 / 3.0, 0), 3.0)
        self.assertAlmostEqual(pyramid.range_m(focal_px * 0.2 / 3.0 / 4, 2), 3.0)

    def test_one_error_in_pixels_of_the_level_is_twice_the_range_error(self):
        errors = []
        for level in (0, 1):
            true = np.full(2, 60.0 / 2 ** level)
            errors.append(pyramid.row_of(level, (1.5, 2.0), true + [-0.01, 0.01], true)["range_rms_mm"])
        self.assertAlmostEqual(errors[1] / errors[0], 2.0, places=5)

    def test_wrong_and_missing_matches_are_counted_apart(self):
        row = pyramid.row_of(0, (1.5, 2.0), np.array([10.5, 12.0, math.nan, math.inf, -1.0]), np.full(5, 10.0))
        self.assertEqual((row["pixels"], row["matched"], row["wrong"]), (5, 0.4, 0.5))
        self.assertAlmostEqual(row["disparity_rms_px"], 0.5)
