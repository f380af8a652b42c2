"""scripts/studies/dead_reckoning/dead_reckoning.py: slopes, powers and chances against what is known of them."""

import contextlib
import csv
import io
import math
import random
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from context import ROOT, np, run_of, study
from dead_reckoning import dead_reckoning as sand
from dead_reckoning import sand_slopes

ry = study.ry

PAGE = (ROOT / "results/studies/dead_reckoning.md").read_text(encoding="utf-8")


def trace(x, y, heading, believed, odometer):
    """Arrays as rockyard.Trace has them, of lists over moments."""
    none = np.zeros(len(x))
    arrays = {"position_m": np.transpose([x, y, none]), "heading_rad": np.array(heading),
              "believed": np.transpose([x, y, believed, odometer])}
    return arrays | {"heading_error_rad": ry.traces.DERIVED["heading_error_rad"](arrays)}


class Slopes(unittest.TestCase):
    def test_errors_are_interpolated_between_samples(self):
        # 0.1 m, then 0.5 m more: 0.35 m is half of it.
        moments = trace([0.1, 0.1, 0.4], [0.0, 0.0, 0.4], [0.0, 0.0, 3.13], [0.01, 0.01, -3.13], [0.12, 0.12, 0.7])
        course = sand_slopes.course_of(moments, step_m=0.35)
        self.assertEqual(len(course), 1)
        turn = 2.0 * math.pi - 6.26
        self.assertAlmostEqual(course[0][0], math.degrees(0.5 * (0.01 + turn)))
        self.assertAlmostEqual(course[0][1], 0.5 * (0.02 + 0.1))

    def test_variances_are_about_the_mean_where_all_runs_go(self):
        courses = [np.array([(1.0, 5.0), (2.0, 5.0)]), np.array([(3.0, 5.0), (6.0, 5.0), (9.0, 9.0)])]
        self.assertEqual(list(sand_slopes.variances(courses, 0)), [2.0, 8.0])
        self.assertEqual(list(sand_slopes.variances(courses, 1)), [0.0, 0.0])

    def test_slopes_of_known_curves(self):
        x = [sand_slopes.STEP_M * (i + 1) for i in range(28)]
        line = [0.7 * each for each in x]
        self.assertAlmostEqual(sand_slopes.slope_through_origin(line), 0.7)
        self.assertAlmostEqual(sand_slopes.slope_free([1.0 + each for each in line]), 0.7)
        self.assertAlmostEqual(sand_slopes.exponent(line), 1.0)
        square = [each ** 2 for each in x]
        self.assertAlmostEqual(sand_slopes.exponent(square), 2.0)
        self.assertGreater(sand_slopes.slope_free(square), sand_slopes.slope_through_origin(square))

    def test_a_scale_error_has_the_slope_that_is_fitted_to_it(self):
        values = (sand.fitted_scale() * sand_slopes.distances(range(28))) ** 2
        # Of 28 points of 7 m: 3 (n (n + 1) / 2)^2 / (n (n + 1) (2 n + 1) / 6) of the step, in place of 3/4 of the length.
        self.assertAlmostEqual(sand_slopes.slope_through_origin(values) / 0.0039, 29 / 28 * 28 / 28.5, places=9)
        self.assertAlmostEqual((sand.linear_deviation() * 7.0) ** 2, 0.0039 * 7.0)


class Chances(unittest.TestCase):
    def test_tails(self):
        # 1.959964 deviations to the largest error: 2.5 %.
        self.assertAlmostEqual(sand.largest_chances(0.093 / 1.959964)[0], 1.0 - 0.975 ** 20, places=6)
        self.assertAlmostEqual(sand.any_of(0.01, 20), 1.0 - 0.99 ** 20)

    def test_a_heavy_tail_goes_over_into_the_normal_one(self):
        deviation = sand.linear_deviation()
        normal = sand.largest_chances(deviation)[0]
        self.assertAlmostEqual(sand.heavy_tail_chance(deviation, 1e6) / normal, 1.0, places=2)
        self.assertGreater(sand.heavy_tail_chance(deviation, 3), 50.0 * normal)

    def test_largest_of_twenty_by_drawing(self):
        rng = random.Random(1)
        deviation = 0.05  # so that it happens often enough to be counted
        sets = 4000
        found = sum(max(rng.gauss(sand.MODE, deviation) for _ in range(20)) >= 0.095 for _ in range(sets))
        chance = sand.largest_chances(deviation)[0]
        # alpha = 1e-4: 3.9 deviations of a binomial share.
        self.assertLess(abs(found / sets - chance), 3.9 * math.sqrt(chance * (1.0 - chance) / sets))
        lowest = sum(min(rng.gauss(sand.MODE, deviation) for _ in range(20)) <= -0.035 for _ in range(sets))
        chance = sand.largest_chances(deviation)[1]
        self.assertLess(abs(lowest / sets - chance), 3.9 * math.sqrt(chance * (1.0 - chance) / sets) + 1e-3)

    def test_grubbs(self):
        # Grubbs and Beck 1972, table 1: one-sided critical values for twenty.
        self.assertAlmostEqual(sand.grubbs_p(2.557), 0.05, places=3)
        self.assertAlmostEqual(sand.grubbs_p(2.884), 0.01, places=3)
        self.assertEqual(sand.grubbs_p(19.0 / math.sqrt(20.0)), 0.0)

    def test_share_of_the_extremes(self):
        self.assertAlmostEqual(sand.share_of_extremes(sand.linear_deviation()), 0.93, places=2)
        self.assertAlmostEqual(sand.largest_of_footnote(0.0236), 3.82, places=2)


class Powers(unittest.TestCase):
    def test_pure_laws(self):
        rng = random.Random(2)
        kept = sand.halves(1.0, rng)
        self.assertAlmostEqual(sand.variance_ratio(kept), 4.0)
        self.assertAlmostEqual(sand.halves_correlation(kept), 1.0)
        noise = sand.halves(0.0, rng, n=20000)
        # Of 20000 runs: both have errors of some 1 %.
        self.assertLess(abs(sand.variance_ratio(noise) - 2.0), 0.1)
        self.assertLess(abs(sand.halves_correlation(noise)), 0.03)

    def test_variance_at_the_end_is_one_whatever_the_share(self):
        for share in (0.0, 0.5, 1.0):
            ends = [end for _, end in sand.halves(share, random.Random(3), n=20000)]
            self.assertLess(abs(sum(end * end for end in ends) / len(ends) - 1.0), 0.04)  # 4 deviations

    def test_the_test_keeps_its_level_and_gains_power(self):
        found = sand.powers(2000, seed=5)
        for name in ("variances", "courses"):
            power = [value for value, *_ in found[name]]
            # Both the limit and the power are of 2000 sets: 5 sqrt(2 x 0.05 x 0.95 / 2000) = 3.4 %.
            self.assertLess(abs(power[0] - 0.05), 0.034)
            self.assertEqual(power, sorted(power))
        self.assertGreater(found["courses"][-1][0], found["variances"][-1][0])


class Study(unittest.TestCase):
    def courses(self, run, heading=0.70, distance=0.0039):
        """Courses that are walks of known variance a metre, as many as the folder says."""
        rng, x = np.random.default_rng(11), 0.1 * np.arange(1, 71)
        walk = lambda variance: np.cumsum(rng.normal(0.0, math.sqrt(0.1 * variance), 70))
        return [sand_slopes.course_of(trace(x, 0.0 * x, 0.0 * x, np.radians(walk(heading)), x + walk(distance)))
                for _ in range(int(run.folder.name))]

    def study(self, out, *runs):
        open_run = lambda folder: run_of([{"outcome": "no_path"}], folder, provenance={"version": "1", "commit": "c"})
        words = ["study", *runs, "--out", str(out), "--replicates", "100"]
        with (mock.patch.object(sys, "argv", words), mock.patch.object(ry, "Run", open_run),
              mock.patch.object(sand_slopes, "read_courses", self.courses)):
            return sand.main()

    def test_it_gives_back_the_slopes_of_known_walks(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            with contextlib.redirect_stdout(io.StringIO()) as out:
                self.study(folder, "205", "20", "20")
            with open(folder / "dead_reckoning.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([row["runs"] for row in rows], ["level"] * 10 + ["up and down"] * 2 + ["up"])
            for column, truth in (("heading_origin", 0.70), ("distance_origin", 0.0039)):
                mean = sum(float(row[column]) for row in rows[:10]) / 10
                # The slope of a set scatters by some 30 %: 4 deviations of ten.
                self.assertLess(abs(mean / truth - 1.0), 0.4, column)
                self.assertGreater(abs(mean / (2.0 * truth) - 1.0), 0.2, column)  # negative control
            self.assertIn("made by", (folder / "dead_reckoning.md").read_text().lower())
            self.assertIn("| level | heading (deg2/m) | through the origin | 10 |", out.getvalue())

    def test_rows_say_where_the_printed_slope_lies(self):
        below, above = [(0.5, 0.5, 1.0), (0.003, 0.003, 1.0)], [(0.9, 0.9, 1.6), (0.005, 0.005, 1.0)]
        rows = sand.slope_rows("level", [below, below, below, above])
        self.assertEqual([row[-1] for row in rows], ["75 %"] * 4)
        self.assertEqual(rows[0][5], "0.5000 .. 0.8700")  # 92.5 % of the way from the third to the last
        self.assertEqual([row[-1] for row in sand.exponent_rows("level", [below, above])], ["50 %", "0 %"])

    def test_too_few_courses_are_refused(self):
        with tempfile.TemporaryDirectory() as name:
            with contextlib.redirect_stderr(io.StringIO()) as err, self.assertRaises(SystemExit):
                self.study(name, "3")
            self.assertIn("fewer than twenty courses", err.getvalue())

    def test_the_page_holds_what_needs_no_runs(self):
        for row in sand.footnote_rows():
            self.assertIn(" | ".join(row), PAGE)

    def test_the_page_is_of_the_file_beside_it(self):
        with open(ROOT / "results/studies/dead_reckoning.csv", encoding="utf-8", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["runs"] == "level"]
        self.assertEqual(len(rows), 100)
        for which, what in enumerate(("heading", "distance")):
            values = [float(row[f"{what}_origin"]) for row in rows]
            below = sum(value < sand.PUBLISHED[which] for value in values)
            self.assertRegex(PAGE, rf"\| level \| {what} .*through the origin \| 100 \|.*\| {below} % \|")
            # Where the printed slopes lie: well inside of what sets of twenty scatter.
            self.assertTrue(10 < below < 90, what)
            self.assertGreater(study.rates.mean(values)[2], sand.PUBLISHED[which])
