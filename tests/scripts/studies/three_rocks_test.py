"""scripts/studies/figures/three_rocks.py: percentiles and the joint distance against samples that are known."""

import random
import unittest
from unittest import mock

from context import frame, np, run_of, study
from figures import three_rocks


class SharesTest(unittest.TestCase):
    def test_ties_count_half(self):
        self.assertEqual(three_rocks.share_below(np.array([1.0, 2.0, 3.0, 4.0]), 3.0), 0.625)

    def test_weights_are_one_over_the_tries(self):
        rows = frame([{"b_tries": 2.0, "c_tries": 1.0}, {"b_tries": 1.0, "c_tries": 6.0}])
        self.assertEqual(list(three_rocks.weights_of(rows)), [0.5, 1.0 / 6.0])

    def test_effective_size(self):
        self.assertAlmostEqual(three_rocks.effective_size(np.ones(7)), 7.0)
        self.assertAlmostEqual(three_rocks.effective_size(np.array([1.0, 0.0, 0.0])), 1.0)


class JointTest(unittest.TestCase):
    """p-values of a point of the sample's own law are uniform; seed 1, 400 samples of 39."""

    SAMPLES, SIZE = 400, 39

    def share_below_a_tenth(self, shift):
        stream = random.Random(1)
        low = 0
        for _ in range(self.SAMPLES):
            points = [[stream.gauss(0, 1), stream.gauss(0, 5)] for _ in range(self.SIZE)]
            new = [stream.gauss(shift, 1), stream.gauss(0, 5)]
            low += three_rocks.joint_p(points, new) <= 0.1
        return low / self.SAMPLES

    def test_false_alarms_are_as_many_as_promised(self):
        # Binomial of 400 at 0.1: standard deviation 0.015; alpha 1e-4.
        self.assertLess(abs(self.share_below_a_tenth(0.0) - 0.1), 0.06)

    def test_another_law_is_told_apart(self):
        self.assertGreater(self.share_below_a_tenth(4.0), 0.9)


class ReportTest(unittest.TestCase):
    def run_of(self, accepted):
        return run_of([{"outcome": "goal_reached", "accepted": flag, "b_tries": 1, "c_tries": 1}
                       | dict.fromkeys(three_rocks.PUBLISHED, number) for number, flag in enumerate(accepted)])

    def test_only_accepted_runs_count(self):
        rows = three_rocks.accepted(self.run_of([1, 0, 1, 1]))
        self.assertEqual(list(rows.at_c_deg), [0.0, 2.0, 3.0])
        text = "\n".join(three_rocks.report(rows))
        self.assertIn("3 accepted runs", text)
        self.assertIn("position_error_m: published 1.0, ensemble median 2.00", text)

    def test_too_few_runs_are_an_error(self):
        with mock.patch.object(study.ry, "Run", lambda folder: self.run_of([1, 0])):
            self.assertEqual(three_rocks.main(["a folder"]), 2)
        self.assertEqual(three_rocks.main([]), 2)
