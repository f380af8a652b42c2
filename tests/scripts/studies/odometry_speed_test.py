"""Counting of the study of visual odometry's speed, on numbers made by hand."""

import unittest

import context  # noqa: F401  (where studies are)
from odometry_speed import odometry_speed as speed


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
