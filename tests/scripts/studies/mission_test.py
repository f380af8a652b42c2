"""scripts/studies/mission/mission.py: counting of missions made by hand."""

import unittest

import pandas
from context import study
from mission import mission


def missions(reached, errors_m):
    """Columns of as many missions as there are entries."""
    count = len(reached)
    columns = {"goals_reached": reached, "goals_believed": [10.0] * count, "wrong_beliefs": [10.0 - r for r in reached],
               "goals_given_up": [1.0] * count, "distance_m": [100.0] * count, "longest_sol_m": list(range(count)),
               "battery_left_wh": [5.0] * count, "missions": [1.0] * count, "sols": [20.0] * count}
    for sols in (7, 30):
        columns[f"after_{sols}_position_m"] = errors_m
        columns[f"after_{sols}_heading_deg"] = [3.0] * count
        columns[f"after_{sols}_judged"] = [1.0] * count
        columns[f"after_{sols}_inside_95"] = [1.0] + [0.0] * (count - 1)
        columns[f"after_{sols}_goal_frame_inside_95"] = [1.0] * count
        columns[f"after_{sols}_goal_frame_m"] = [0.5] * count
    for end in mission.SOL_ENDS:
        columns[f"sols_{end}"] = [0.0] * count
    columns["sols_goal"] = [15.0] * count
    columns["sols_time"] = [5.0] * count
    for end in mission.MISSION_ENDS:
        columns[f"end_{end}"] = [0.0] * count
    columns["end_sols_done"] = [1.0] * count
    for part in (*mission.SOURCES, *mission.SINKS, "sun_available"):
        columns[f"{part}_wh"] = [0.0] * count
    columns["sun_wh"] = [80.0] * count
    columns["battery_wh"] = [20.0] * count
    columns["sleep_wh"] = [100.0] * count
    return pandas.DataFrame(columns, dtype=float)


class Counting(unittest.TestCase):
    def setUp(self):
        self.missions = {"none": missions([2.0, 4.0, 6.0], [1.0, 3.0, 8.0]),
                         "lander, evening": missions([5.0, 8.0, 8.0], [0.5, 0.5, 0.5])}
        self.rows = mission.summary_rows(self.missions)

    def test_rows_hold_means_shares_and_quantiles(self):
        row = self.rows[0]
        self.assertEqual((row["goals_reached"], row["missions"]), (4.0, 3))
        self.assertAlmostEqual(row["wrong_beliefs"], 18.0 / 30.0)
        self.assertEqual((row["median_7_m"], row["longest_sol_m"]), (3.0, 2))
        self.assertAlmostEqual(row["p95_30_m"], 3.0 + 0.9 * 5.0)
        self.assertAlmostEqual(row["inside_30"], 1.0 / 3.0)
        self.assertEqual((row["inside_told_30"], row["median_7_told_m"]), (1.0, 0.5))
        self.assertEqual(row["closure"], 0.0)

    def test_energy_that_does_not_close_is_seen(self):
        self.missions["none"].loc[1, "sleep_wh"] = 99.0
        self.assertAlmostEqual(mission.summary_rows(self.missions)[0]["closure"], 1.0 / 99.0)

    def test_pairs_are_of_missions_of_one_number(self):
        text = mission.pairs_table(self.missions)
        self.assertIn("| lander, evening | 3.0 (", text)  # (3 + 4 + 2) / 3
        self.assertIn("-3.5 (", text)  # of errors: (-0.5 - 2.5 - 7.5) / 3
        self.assertNotIn("| none |", text)

    def test_ends_are_shares_of_sols_and_of_missions(self):
        line = mission.ends_table(self.missions).splitlines()[2]
        self.assertTrue(line.startswith("| none | 75.0 | 25.0 | 0.0 |"), line)
        self.assertIn("| 100 | 0 | 0 |", line)

    def test_energy_is_that_of_a_sol(self):
        line = mission.energy_table(self.missions).splitlines()[2]
        self.assertTrue(line.startswith("| none | 0.00 | 4.00 | 1.00 |"), line)

    def test_closed_forms_are_the_published_rates(self):
        text = mission.rows_table({"hour": 7.9, "day": 31.0, "no_stops": 94.0})
        self.assertIn("| 7.9 m | 7.9 m | 7.9 m |", text)
        self.assertIn("| 40 m | 31.7 m | 31.0 m |", text)
        self.assertIn("| 95 m | 96.5 m | 94.0 m |", text)

    def test_quantiles(self):
        self.assertEqual(mission.median([4.0, 1.0, 2.0, 3.0]), 2.5)
        self.assertAlmostEqual(study.rates.quantile([0.0, 1.0, 2.0, 3.0, 4.0], 0.3), 1.2)
