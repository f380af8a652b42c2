"""Counting, times and fits of the studies of visual odometry, on numbers made by hand."""

import math
import random
import unittest

from context import frame
from calibrations import fit_visual_motion
from odometry import odometry
from odometry_speed import odometry_speed as speed
from visual_odometry import visual_odometry


def line(end_percent, gaps=0, steps=100, case="navcam"):
    return {"case": case, "end_percent": str(end_percent), "gaps": str(gaps), "steps": str(steps),
            "distance_m": "100", "normalized_mean": "6"}


class Counting(unittest.TestCase):
    def test_a_case_is_summed_up_over_its_sequences(self):
        rows = [line(0.5, 3), line(1.5), line(1.0, 1, 200), line(9.0, case="hazcam")]
        found = odometry.summary(rows, "navcam")
        self.assertEqual(found[1], "3 of 20")
        self.assertEqual(found[4], "1.00")
        self.assertEqual(found[6], "1.50")
        self.assertEqual(found[7], "4 of 400")
        self.assertTrue(found[8].startswith("1.0 ("))
        self.assertIsNone(odometry.summary(rows, "navcam, VL-2"))


class Speed(unittest.TestCase):
    def test_the_round_with_the_least_median_counts_as_a_whole(self):
        def one(every, match):
            return {"all_median_ms": every, "match_median_ms": match, "detect_median_ms": 0.5, "features": 400.0,
                    "matches": 300.0, "label": "AVX3"}
        found = speed.hundred_pairs([one(2.0, 0.1), one(1.0, 0.4), one(1.5, 0.2)])
        self.assertEqual((found["all_ms"], found["match_ms"], found["pairs"]), (1.0, 0.4, 100))

    def test_times_are_the_least_and_of_one_motion(self):
        def one(time):
            return {"Features/50": {"features": 48.0, "found": 1.0, "mm": 0.5, "deg": 0.01, "cpu_time": time}}
        self.assertEqual(speed.by_features([one(60.0), one(36.0), one(48.0)]),
                         [{"asked": 50, "features": 48.0, "found": 1.0, "mm": 0.5, "deg": 0.01, "ms": 3.0}])

    def test_measured_rows_get_their_inputs_and_others_keep_theirs(self):
        document = {"hundred_pairs": {"all_ms": 1.23456, "match_ms": 0.4, "features": 400.0}, "step_ms": 2.5,
                    "by_features": [{"asked": 50, "mm": 4.0, "deg": 0.1, "ms": 1.0},
                                    {"asked": 100, "mm": 2.0, "deg": 0.3, "ms": 7.0}]}
        text = ('{"id": "time.front", "inputs": [9, 1], "unit": "ms"},\n{"id": "vo.regions", "inputs": [4, 4]},\n'
                '{"id": "quality.deg_100", "inputs": [8, 8]}\n{"id": "cost.ms_100", "inputs": [8, 8]}\n')
        self.assertEqual(
            speed.with_inputs(text, document),
            '{"id": "time.front", "inputs": [1.235, 1], "unit": "ms"},\n{"id": "vo.regions", "inputs": [4, 4]},\n'
            '{"id": "quality.deg_100", "inputs": [0.3, 0.1]}\n{"id": "cost.ms_100", "inputs": [7, 1]}\n')


class Fits(unittest.TestCase):
    def test_variances_come_back(self):
        points = [(way, turn, 24, 1e-4**2 + (0.003 * way)**2 + (0.002 * turn)**2)
                  for way in (0.0, 0.25, 0.5, 1.0) for turn in (0.0, 0.1, 0.3)]
        still, per_m, per_rad = fit_visual_motion.fit_variance(points)
        self.assertAlmostEqual(still, 1e-4, delta=1e-6)
        self.assertAlmostEqual(per_m, 0.003, delta=1e-5)
        self.assertAlmostEqual(per_rad, 0.002, delta=1e-5)

    def test_a_part_that_is_not_there_vanishes(self):
        points = [(way, turn, 24, (0.003 * way)**2 + 1e-12) for way in (0.0, 0.5, 1.0) for turn in (0.0, 0.3)]
        _, per_m, per_rad = fit_visual_motion.fit_variance(points)
        self.assertAlmostEqual(per_m, 0.003, delta=1e-4)
        self.assertLess(per_rad, 3e-5)

    def test_failures_come_back(self):
        # 4,000 motions a cell; seed 7. The bounds are four standard errors, by the information of the fit.
        rng = random.Random(7)
        points = []
        for way in (0.0, 0.25, 0.5, 0.75, 1.0):
            for turn in (0.0, 0.1, 0.2, 0.3):
                p = 1 / (1 + math.exp(-(-4.0 + 3.0 * way + 2.0 * turn)))
                points.append((way, turn, 4000, sum(rng.random() < p for _ in range(4000))))
        intercept, per_m, per_rad = fit_visual_motion.fit_failures(points)
        self.assertAlmostEqual(intercept, -4.0, delta=0.15)
        self.assertAlmostEqual(per_m, 3.0, delta=0.16)
        self.assertAlmostEqual(per_rad, 2.0, delta=0.42)

    def test_no_failures_at_all_are_no_fault(self):
        intercept, _, _ = fit_visual_motion.fit_failures([(way, 0.1, 24, 0) for way in (0.0, 0.5, 1.0)])
        self.assertLess(intercept, -3.0)
        self.assertTrue(math.isfinite(intercept))


class Counts(unittest.TestCase):
    def rows(self, outcomes):
        return frame([{"outcome": outcome, "position_error_m": float(i), "true_distance_m": 10.0, "sim_time_s": 100.0,
                       "energy_wh": 2.0, "visual_steps": 10.0, "visual_failures": 1.0}
                      for i, outcome in enumerate(outcomes)])

    def test_summary(self):
        found = visual_odometry.summary(self.rows(["goal_reached", "false_goal", "goal_reached", "no_path",
                                                         "goal_reached"]))
        self.assertEqual(found["success"], 0.6)
        self.assertEqual(found["error_median_m"], 2.0)
        self.assertEqual(found["error_05_m"], 0.2)
        self.assertEqual(found["failed"], 0.1)

    def test_no_steps_have_no_rate(self):
        rows = self.rows(["goal_reached"]).assign(visual_steps=0.0, visual_failures=0.0)
        self.assertTrue(math.isnan(visual_odometry.summary(rows)["failed"]))

    def test_images_by_cell(self):
        self.assertEqual(visual_odometry.parse_images("nominal/vision=a,VL-2/both=b"),
                         {("nominal", "vision"): "a", ("VL-2", "both"): "b"})
        self.assertEqual(visual_odometry.parse_images(None), {})
