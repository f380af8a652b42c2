"""Counts of the study of slip in closed loop, on numbers made by hand."""

import math
import unittest

from context import frame
from slip_loop import slip_loop


def drive(outcome, onset_m=math.nan, alarm_m=math.nan, **values):
    return (dict.fromkeys((*slip_loop.MEANS, "position_error_m"), 1.0) | {"false_slip_alarms": 0.0} | values |
            {"outcome": outcome, "slip_onset_m": onset_m, "first_slip_alarm_m": alarm_m})


class Counts(unittest.TestCase):
    def test_delays_need_an_onset_and_an_alarm(self):
        rows = [drive("excessive_slip", 2.0, 2.3), drive("goal_reached"), drive("jammed", 3.0),
                drive("excessive_slip", alarm_m=1.0), drive("excessive_slip", 4.0, 3.9)]
        found = slip_loop.summary(frame(rows))
        self.assertEqual(found["onsets_alarmed"], 2)
        self.assertAlmostEqual(found["delay_median_m"], 0.1)
        self.assertAlmostEqual(found["delay_90_m"], 0.26)
        self.assertTrue(math.isnan(slip_loop.summary(frame(rows[1:2]))["delay_median_m"]))

    def test_summary(self):
        rows = [drive("goal_reached", true_distance_m=10.0, false_slip_alarms=1.0),
                drive("excessive_slip", 2.0, 2.3, true_distance_m=3.0), drive("high_centred", 2.0, true_distance_m=3.0),
                drive("excessive_slip", alarm_m=4.0, true_distance_m=4.0, false_slip_alarms=1.0),
                drive("time_limit", true_distance_m=5.0)]
        found = slip_loop.summary(frame(rows))
        self.assertEqual([found[name] for name in ("reached", "stuck", "slip_stop", "no_path")], [0.2, 0.2, 0.4, 0.0])
        self.assertAlmostEqual(found["other"], 0.2)
        self.assertEqual((found["onsets"], found["onsets_alarmed"], found["stopped_in_vain"]), (2, 1, 1))
        self.assertAlmostEqual(found["vain_100_m"], 100 * 2 / 25)
        self.assertLess(found["vain_100_m_low"], 8.0)
        self.assertGreater(found["vain_100_m_high"], 8.0)

    def test_rates_of_equal_drives_are_sure(self):
        found = slip_loop.summary(frame([drive("no_path", false_slip_alarms=1.0, true_distance_m=20.0)] * 2))
        self.assertEqual([found[f"vain_100_m{end}"] for end in ("", "_low", "_high")], [5.0, 5.0, 5.0])

    def test_pairs(self):
        unchecked = frame(map(drive, ("jammed", "goal_reached", "goal_reached", "no_path", "jammed")))
        checked = frame(map(drive, ("excessive_slip", "excessive_slip", "jammed", "goal_reached")))
        self.assertEqual(slip_loop.paired(checked, unchecked),
                         {"freed": 1, "newly_stuck": 1, "arrivals_lost": 2, "arrivals_won": 1})

    def test_tables_have_a_line_for_each_check(self):
        arrives = drive("goal_reached", slip_alarms=0.0)
        trials = frame([drive("excessive_slip", 2.0, 2.3, slip_alarms=1.0), arrives])
        free = frame([drive("jammed", slip_alarms=0.0), arrives])
        cells = {(hollows, "gestalt", check): rows for hollows in ("deep", "traps")
                 for check, rows in ((slip_loop.UNCHECKED, free), ("stop 5 Hz", trials))}
        rows = slip_loop.count(cells)
        endings = slip_loop.endings_table(rows).splitlines()
        self.assertEqual(len(endings), 4)
        self.assertIn("| gestalt, stop 5 Hz | 50, 0, 0, 50, 0 | 50, 0, 0, 50, 0 |", endings[3])
        alarms = slip_loop.alarms_table(rows).splitlines()
        self.assertEqual(len(alarms), 3)
        self.assertIn("| 1 of 1, 1 of 1 | 0.30 (0.30), 0.30 (0.30) | 0 in 4 m | 1, 1 | 0, 0 | 0, 0 |", alarms[2])
