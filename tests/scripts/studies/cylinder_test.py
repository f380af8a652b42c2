"""Counting of the studies of the coloured cylinder, and of what its assumed pictures and finders do, on rows made by hand."""

import json
import math
import unittest

from context import ROOT, frame
from cylinder import cylinder
from cylinder import effects


def row(distance, orientation, errors_deg, stereo=0.0, wrong=0, measurements=None):
    """A record of the published finder (and of ours, alike) with these errors."""
    values = {"distance_m": distance, "orientation_deg": orientation,
              "measurements": float(measurements or len(errors_deg))}
    for finder in cylinder.FINDERS:
        found = float(len(errors_deg))
        values |= {f"{finder}_found": found, f"{finder}_wrong": float(wrong), f"{finder}_right": found - wrong,
                   f"{finder}_orientation_bias_deg": sum(errors_deg),
                   f"{finder}_orientation_error_deg": sum(e * e for e in errors_deg),
                   f"{finder}_stereo_bias": stereo * found, f"{finder}_stereo_error": stereo * stereo * found,
                   f"{finder}_size_bias": 0.0, f"{finder}_size_error": 0.0}
    return values


def verdicts(rows):
    return {line[1]: line[3] for line in cylinder.verdict_lines(frame(rows))}


class Counting(unittest.TestCase):
    def test_one_pixel_limits_are_those_of_the_text(self):
        for d_m, turn, step in cylinder.PRINTED_LIMITS:
            self.assertAlmostEqual(cylinder.finest_turn_deg(d_m) / turn, 1.0, delta=0.02)
            self.assertAlmostEqual(cylinder.stereo_step(d_m) / step, 1.0, delta=0.01)

    def test_means_and_spreads_are_those_of_the_measurements(self):
        sums = cylinder.Sums(frame([row(1.829, 0, [1.0, 2.0]), row(1.829, 0, [6.0])]), "published")
        self.assertAlmostEqual(sums.mean("orientation", "_deg"), 3.0)
        self.assertAlmostEqual(sums.spread("orientation", "_deg"), math.sqrt(7.0))

    def test_what_the_text_excepts(self):
        self.assertTrue(cylinder.is_excepted(10.058, -130))
        self.assertTrue(cylinder.is_excepted(15.0, 180))
        self.assertFalse(cylinder.is_excepted(10.058, -80))
        self.assertFalse(cylinder.is_excepted(4.572, -130))

    def test_verdicts_follow_the_means(self):
        good = [row(d, t, [1.0, 1.5], -0.01) for d in cylinder.PUBLISHED_M for t in (-130, 0)]
        found = verdicts(good)
        self.assertEqual(found["mean errors of distance within 5 %"], "agrees")
        self.assertEqual(found["distances usually short"], "agrees")
        self.assertEqual(found["at 10 m from -180 to -90 deg errors stand out"], "differs")
        self.assertEqual(found["at 15 m from -180 to -90 deg no consistent result"], "undecided")
        bad = good[:-2] + [row(10.058, -130, [30.0, 31.0]), row(10.058, 0, [1.0, 1.5]), row(15.0, -130, [], 0, 0, 2)]
        found = verdicts(bad)
        self.assertEqual(found["at 10 m from -180 to -90 deg errors stand out"], "agrees")
        self.assertEqual(found["at 15 m from -180 to -90 deg no consistent result"], "agrees")
        long = verdicts([row(0.914, 0, [9.0, 9.0], 0.06)])
        self.assertEqual(long["mean errors of distance within 5 %"], "differs")
        self.assertEqual(long["distances usually short"], "differs")

    def test_shares_have_exact_intervals(self):
        # Clopper and Pearson 1934, none of 10: 1 - 0.025^(1/10) = 30.8 %.
        self.assertEqual(cylinder.share(0, 10), "0 of 10 (0.0..30.8 %)")

    def test_exact_numbers(self):
        verdict_of = {line[1]: line[3] for line in cylinder.exact_lines()}
        self.assertEqual(verdict_of["m = 17: 11.24 m"], "agrees")
        self.assertIn("misprint", verdict_of["about 5.8 %"])


class Effects(unittest.TestCase):
    def test_assumptions_are_counted_by_finder(self):
        rows = [{"measurements": 1.0, "published_found": 1.0, "published_wrong": wrong, "published_right": 1.0 - wrong,
                 "published_right_orientation_bias_deg": error, "published_right_orientation_error_deg": error ** 2,
                 "robust_found": 0.0, "robust_wrong": 0.0, "robust_right": 0.0}
                for wrong, error in ((0.0, 2.0), (0.0, 4.0), (1.0, 0.0), (0.0, 3.0))]
        self.assertEqual(effects.assumption_line("as assumed", frame(rows)),
                         ["as assumed", "100", "+3.00 ± 1.00", "25.0", "0", "-", "0.0"])

    def test_drives_are_counted_by_where_they_truly_end(self):
        names = ("outcome", "aids_used", "aids_gated_out", "position_error_m", "heading_error_deg")
        rows = frame(dict(zip(names, row)) for row in (
            ("goal_reached", 4.0, 0.0, 0.1, -8.0), ("goal_reached", 4.0, 1.0, 0.2, 1.0),
            ("goal_reached", 3.0, 0.0, math.nan, 2.0), ("false_goal", 1.0, 1.0, 0.9, 3.0)))
        self.assertEqual(effects.drive_line("ours", rows),
                         ["ours", "75 (30..95)", "0.20 / 0.90", "3.00 / 8.00", "3.0", "0.50"])

    def test_every_drive_is_a_scenario_that_is_there(self):
        for scenario, _ in effects.DRIVES.values():
            path = ROOT / f"scenarios/localization/{scenario}.json"
            self.assertEqual(json.loads(path.read_text(encoding="utf-8"))["name"], scenario)
