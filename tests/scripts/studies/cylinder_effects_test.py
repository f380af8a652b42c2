"""Counting of the study of what assumed pictures and finders of the cylinder do, on rows made by hand."""

import json
import math
import unittest

from context import ROOT
from cylinder import effects


class Counting(unittest.TestCase):
    def test_assumptions_are_counted_by_finder(self):
        rows = [{"measurements": 1.0, "published_found": 1.0, "published_wrong": wrong, "published_right": 1.0 - wrong,
                 "published_right_orientation_bias_deg": error, "published_right_orientation_error_deg": error ** 2,
                 "robust_found": 0.0, "robust_wrong": 0.0, "robust_right": 0.0}
                for wrong, error in ((0.0, 2.0), (0.0, 4.0), (1.0, 0.0), (0.0, 3.0))]
        self.assertEqual(effects.assumption_line("as assumed", rows),
                         ["as assumed", "100", "+3.00 ± 1.00", "25.0", "0", "-", "0.0"])

    def test_drives_are_counted_by_where_they_truly_end(self):
        columns = {"outcome": ["goal_reached"] * 3 + ["false_goal"], "aids_used": [4.0, 4.0, 3.0, 1.0],
                   "aids_gated_out": [0.0, 1.0, 0.0, 1.0], "position_error_m": [0.1, 0.2, math.nan, 0.9],
                   "heading_error_deg": [-8.0, 1.0, 2.0, 3.0]}
        self.assertEqual(effects.drive_line("ours", columns),
                         ["ours", "75 (30..95)", "0.20 / 0.90", "3.00 / 8.00", "3.0", "0.50"])

    def test_every_drive_is_a_scenario_that_is_there(self):
        for scenario, _ in effects.DRIVES.values():
            path = ROOT / f"scenarios/localization/{scenario}.json"
            self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["name"], scenario)
