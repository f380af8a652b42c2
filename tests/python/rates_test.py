#!/usr/bin/env python3
"""Rates, intervals and exact tests against answers of others (tests/data) and closed forms.

Usage: rates_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import json
import math
import unittest

import package
import rockyard as ry
from package import PROJECT
from rockyard import rates

ORACLES = json.loads((PROJECT / "tests/data/statistics_oracles.json").read_text())
Z95 = 1.959963984540054


def wilson(count, trials, z=Z95):
    """Wilson 1927."""
    middle = (count + z * z / 2) / (trials + z * z)
    half = z / (trials + z * z) * math.sqrt(count * (trials - count) / trials + z * z / 4)
    return middle - half, middle + half


def poisson_below(count, mean):
    return sum(math.exp(-mean) * mean**k / math.factorial(k) for k in range(count + 1))


class Rates(unittest.TestCase):
    def assert_refused(self, call, *given, **more):
        with self.assertRaises(ry.InputError):
            call(*given, **more)

    def test_intervals_are_those_of_others(self):
        for case in ORACLES["clopper_pearson"]:
            made = ry.rate(case["k"], case["n"], 1 - case["alpha"], "clopper_pearson")
            self.assertEqual(made.method, "clopper_pearson")
            self.assertAlmostEqual(made.low, case["ci"][0], 9)
            self.assertAlmostEqual(made.high, case["ci"][1], 9)
        wilsons = [(ry.rate(case["k"], case["n"]), case["ci"]) for case in ORACLES["wilson_95"]]
        wilsons = [(made, ends) for made, ends in wilsons if made.method == "wilson"]
        self.assertTrue(wilsons)
        for made, ends in wilsons:
            self.assertAlmostEqual(made.low, ends[0], 9)
            self.assertAlmostEqual(made.high, ends[1], 9)

    def test_few_of_a_kind_get_the_exact_interval(self):
        self.assertEqual(ry.rate(5, 10).method, "wilson")
        self.assertEqual(ry.rate(4, 40).method, "clopper_pearson")
        self.assertEqual(ry.rate(36, 40).method, "clopper_pearson")
        low, high = wilson(20, 50)
        self.assertAlmostEqual(ry.rate(20, 50).low, low, 12)
        self.assertAlmostEqual(ry.rate(20, 50).high, high, 12)

    def test_a_rate_is_a_number(self):
        made = ry.rate(3, 4)
        self.assertEqual((float(made), made.rate, made.count, made.trials), (0.75, 0.75, 3, 4))
        self.assertEqual(repr(made), f"Rate(3/4, 0.75, {made.low:.2f} .. {made.high:.2f})")
        none = ry.rate(0, 0)
        self.assertTrue(math.isnan(none.rate))
        self.assertEqual((none.low, none.high), (0.0, 1.0))
        self.assertEqual(ry.rate(0, 6).low, 0.0)
        self.assertAlmostEqual(ry.rate(0, 6).high, 1 - 0.025 ** (1 / 6), 12)

    def test_exact_tests_are_those_of_others(self):
        for case in ORACLES["fisher_exact"]:
            if case["alternative"] != "two-sided":
                continue
            (a, b), (c, d) = case["table"]
            self.assertAlmostEqual(rates.fisher(ry.rate(a, a + b), ry.rate(c, c + d)), case["p"], 9)
        for first, second in ((0, 0), (3, 9), (9, 3), (0, 5), (7, 7)):
            tail = sum(math.comb(first + second, k) for k in range(min(first, second) + 1)) / 2 ** (first + second)
            self.assertAlmostEqual(rates.mcnemar(first, second), min(1.0, 2 * tail), 12)

    def test_differences_are_those_of_closed_forms(self):
        first, second = ry.rate(56, 70), ry.rate(48, 80)  # Newcombe 1998, table II (a), with the signs turned
        low, high = rates.difference(first, second)
        self.assertAlmostEqual(low, -0.3339, 4)
        self.assertAlmostEqual(high, -0.0524, 4)
        (l1, u1), (l2, u2) = wilson(56, 70), wilson(48, 80)
        p1, p2 = 0.8, 0.6
        self.assertAlmostEqual(low, p2 - p1 - math.hypot(p2 - l2, u1 - p1), 10)
        self.assertAlmostEqual(high, p2 - p1 + math.hypot(u2 - p2, p1 - l1), 10)
        both, one, other, neither = 20, 12, 3, 5  # Agresti and Min 2005: half a pair is added to each kind
        n, d = both + one + other + neither + 2.0, float(other - one)
        half = Z95 * math.sqrt((one + other + 1.0) - d * d / n) / n
        low, high = rates.paired_difference(both, one, other, neither)
        self.assertAlmostEqual(low, d / n - half, 9)
        self.assertAlmostEqual(high, d / n + half, 9)

    def test_counts_have_the_interval_of_garwood(self):
        for count in (0, 1, 5, 12):
            low, high = rates.poisson_interval(count)
            self.assertAlmostEqual(poisson_below(count, high), 0.025, 9)
            if count:
                self.assertAlmostEqual(1 - poisson_below(count - 1, low), 0.025, 9)
            else:
                self.assertEqual(low, 0.0)

    def test_enough_trials_give_the_half_width(self):
        for half_width, rate in ((0.05, 0.5), (0.02, 0.9)):
            trials = rates.trials_for(half_width, rate)

            def half(count):
                low, high = wilson(round(rate * count), count)  # the nearest count stands for the rate
                return (high - low) / 2
            self.assertLessEqual(half(trials), half_width + 1e-9)
            self.assertGreater(half(trials - 1), half_width)

    def test_impossible_counts_are_refused(self):
        self.assert_refused(ry.rate, 5, 3)
        self.assert_refused(ry.rate, -1, 3)
        self.assert_refused(ry.rate, 1, 3, 1.0)
        self.assert_refused(ry.rate, 1, 3, method="normal")
        self.assert_refused(rates.difference, ry.Rate(5, 3, 0, 0, 0, ""), ry.rate(1, 3))
        self.assert_refused(rates.paired_difference, -1, 0, 0, 0)
        self.assert_refused(rates.mcnemar, -1, 0)
        self.assert_refused(rates.poisson_interval, -1)
        for given in ((0.6,), (0.0,), (-0.1,), (float("nan"),), (0.1, 1.5), (0.1, 0.5, 2.0)):
            self.assert_refused(rates.trials_for, *given)


if __name__ == "__main__":
    package.main()
