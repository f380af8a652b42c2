"""Fits and counts of the studies of visual odometry, on numbers made by hand."""

import math
import random
import unittest

import context  # noqa: F401  (where studies are)
from calibrations import fit_visual_motion
from visual_odometry import visual_odometry


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
        return [{"outcome": outcome, "position_error_m": float(i), "true_distance_m": 10.0, "sim_time_s": 100.0,
                 "energy_wh": 2.0, "visual_steps": 10.0, "visual_failures": 1.0, "trial": i}
                for i, outcome in enumerate(outcomes)]

    def test_summary(self):
        found = visual_odometry.summary(self.rows(["goal_reached", "false_goal", "goal_reached", "no_path",
                                                         "goal_reached"]))
        self.assertEqual(found["success"], 0.6)
        self.assertEqual(found["error_median_m"], 2.0)
        self.assertEqual(found["error_05_m"], 0.2)
        self.assertEqual(found["failed"], 0.1)

    def test_no_steps_have_no_rate(self):
        rows = [row | {"visual_steps": 0.0, "visual_failures": 0.0} for row in self.rows(["goal_reached"])]
        self.assertTrue(math.isnan(visual_odometry.summary(rows)["failed"]))

    def test_images_by_cell(self):
        self.assertEqual(visual_odometry.parse_images("nominal/vision=a,VL-2/both=b"),
                         {("nominal", "vision"): "a", ("VL-2", "both"): "b"})
        self.assertEqual(visual_odometry.parse_images(None), {})
