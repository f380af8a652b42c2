"""Counting of the study of localization, on cells made by hand."""

import math
import unittest

from context import frame
from localization import localization

COLUMNS = ("position_error_m", "heading_error_deg", "believed_position_sd_m", "aids_used", "aids_gated_out", "aids_in_doubt")


def trial(goal_m, outcome="goal_reached", nees=math.nan):
    inside = math.nan if math.isnan(nees) else float(nees <= 7.815)
    return dict.fromkeys(COLUMNS, 0.0) | {
        "true_goal_distance_m": goal_m, "outcome": outcome, "pose_nees": nees, "inside_95": inside}


def cells():
    place = ("nominal", "10 m")
    return {
        (*place, "dead reckoning"): frame([trial(0.1), trial(0.5), trial(1.0), trial(2.0)]),
        (*place, "all"): frame([trial(0.1, nees=1.0), trial(0.1, nees=9.0), trial(0.5, nees=2.0),
                                trial(0.7, "jammed", nees=50.0)]),
    }


class Counting(unittest.TestCase):
    def test_reach_counts_what_ends_within_the_radius(self):
        rows = localization.by_key(localization.reach_rows(cells()), "aids", "radius_m")
        self.assertEqual([rows["dead reckoning", radius]["within"] for radius in (0.24, 0.6, 1.2)], [1, 2, 3])
        self.assertEqual(rows["all", 0.6]["share"], 0.75)
        self.assertLess(rows["all", 0.6]["low"], 0.75)
        self.assertGreater(rows["all", 0.6]["high"], 0.75)

    def test_pairs_hold_trials_of_one_number_against_each_other(self):
        rows = localization.by_key(localization.pair_rows(cells()), "aids", "radius_m")
        self.assertEqual((rows["all", 0.24]["won"], rows["all", 0.24]["lost"]), (1, 0))
        self.assertEqual(rows["all", 0.24]["points"], 25.0)
        self.assertEqual((rows["all", 1.2]["won"], rows["all", 1.2]["lost"]), (1, 0))
        self.assertEqual(rows["all", 0.24]["p"], 1.0)
        self.assertNotIn(("dead reckoning", 0.24), rows)

    def test_belief_leaves_out_who_keeps_no_account(self):
        rows = localization.by_key(localization.belief_rows(cells()), "aids", "trials")
        self.assertEqual(rows["all", "all"]["inside_95"], 0.5)
        self.assertEqual(rows["all", "arrived"]["count"], 3)
        self.assertAlmostEqual(rows["all", "arrived"]["inside_95"], 2 / 3)
        self.assertNotIn(("dead reckoning", "all"), rows)

    def test_the_longest_distance_ends_where_one_before_fell_short(self):
        near, middle, far = ([trial(0.1)] * 2, [trial(9.0)] * 2, [trial(0.1)] * 2)
        course = {("nominal", distance, "dead reckoning"): frame(rows)
                  for distance, rows in (("3 m", near), ("5 m", middle), ("10 m", far))}
        text = localization.day_table(course, localization.reach_rows(course))
        self.assertIn("| nominal | dead reckoning | 3 m | 3 m |", text)

    def test_cells_have_the_names_of_their_terrain(self):
        self.assertEqual(list(localization.named({(0.013, "5 m", "sun"): frame([trial(0.5)])})), [("Viking Lander 2", "5 m", "sun")])
