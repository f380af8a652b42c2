"""Counting of the study of visual odometry, on lines made by hand."""

import unittest

import context  # noqa: F401  (where studies are)
from odometry import odometry


def line(end_percent, gaps=0, steps=100, case="navcam"):
    return {"case": case, "end_percent": str(end_percent), "gaps": str(gaps), "steps": str(steps),
            "distance_m": "100", "normalized_mean": "6"}


class Counting(unittest.TestCase):
    def test_the_interval_of_a_median_is_that_of_the_tables(self):
        # Ranks of 95 % intervals, of any table of the sign test: 1 of 6, 2 of 10, 6 of 20.
        for count, rank in ((6, 1), (10, 2), (20, 6)):
            values = list(range(1, count + 1))
            self.assertEqual(odometry.median_interval(values[::-1]), (rank, count + 1 - rank))
        self.assertIsNone(odometry.median_interval([1, 2, 3, 4, 5]))

    def test_a_case_is_summed_up_over_its_sequences(self):
        rows = [line(0.5, 3), line(1.5), line(1.0, 1, 200), line(9.0, case="hazcam")]
        found = odometry.summary(rows, "navcam")
        self.assertEqual(found[1], "3 of 20")
        self.assertEqual(found[4], "1.00")
        self.assertEqual(found[6], "1.50")
        self.assertEqual(found[7], "4 of 400")
        self.assertTrue(found[8].startswith("1.0 ("))
        self.assertIsNone(odometry.summary(rows, "navcam, VL-2"))
