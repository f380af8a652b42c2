"""Counts of the drives of scripts/studies/rover_speed/drives.py, on numbers made by hand."""

import csv
import math
import unittest

from context import ROOT, frame
from rover_speed import drives
from rover_speed import model


COLUMNS = ("sim_time_s", "true_distance_m", "move_time_s", "image_sets", "visual_steps", "point_turns", "position_error_m")


def drive(outcome="goal_reached", **values):
    return dict.fromkeys(COLUMNS, 0.0) | values | {"outcome": outcome}


class Counts(unittest.TestCase):
    def test_speed_is_made_good_over_the_course(self):
        found = drives.summary(frame([drive(sim_time_s=1000.0, true_distance_m=16.0, move_time_s=300.0, image_sets=40.0,
                                      position_error_m=0.16),
                                drive("false_goal", sim_time_s=2000.0, true_distance_m=24.0, move_time_s=500.0,
                                      image_sets=60.0, visual_steps=8.0, position_error_m=0.72),
                                drive("jammed", sim_time_s=9.0, true_distance_m=1.0, position_error_m=9.0)]))
        self.assertEqual((found["trials"], found["arrived"]), (3, 2))
        self.assertAlmostEqual(found["m_per_h"], 0.5 * (14.5 * 3.6 + 14.5 * 1.8))
        self.assertAlmostEqual(found["detour"], 20.0 / 14.5)
        self.assertAlmostEqual(found["wheels_s_m"], 800.0 / 40.0)
        self.assertAlmostEqual(found["rest_s_m"], 2200.0 / 40.0)
        self.assertAlmostEqual(found["looks_m"], 2.5)
        self.assertAlmostEqual(found["poses_m"], 0.2)
        self.assertAlmostEqual(found["error_share"], 0.02)
        self.assertAlmostEqual(found["error_share_95"], 0.029)

    def test_nobody_arrives(self):
        found = drives.summary(frame([drive("no_path", sim_time_s=9.0)]))
        self.assertEqual(found["arrived"], 0)
        self.assertTrue(math.isnan(found["m_per_h"]))

    def test_the_closed_form_is_that_of_the_model(self):
        rows = {("mer_rad6000", 256): {"stereo_s": "27", "navigation_s": "6.585", "visual_s": "160"}}
        look_s, pose_s = 8.974 + 27 + 6.585, 8.974 + 160
        self.assertAlmostEqual(drives.closed_form(rows, "stops by vision", "mer_rad6000"),
                               3600 / (1 / 0.07 + (0.7 + look_s) / 0.35 + pose_s / 0.75))
        self.assertAlmostEqual(drives.closed_form(rows, "CSAD", "mer_rad6000"), 3600 * 1.0 / (0.5 / 0.07 + look_s))

    def test_tables_have_a_line_for_each_drive_and_computer(self):
        rows = model.read_times(ROOT / "results/studies/compute_times.csv")
        cells = {("stops by wheels", "athena_2012", k): frame([drive(sim_time_s=1000.0, true_distance_m=16.0)])
                 for k in (0.002, 0.02)}
        cells["stops by vision", "mer_rad6000", 0.002] = frame([drive("jammed")])
        cells["stops by vision", "mer_rad6000", 0.02] = frame([drive("jammed")])
        lines = list(drives.lines_of(cells, rows))
        self.assertEqual(len(drives.drives_speed(lines).splitlines()), 2 + 2)
        self.assertIn("- [0 of 1]", drives.drives_speed(lines))
        self.assertEqual(len(drives.drives_parts(lines).splitlines()), 2 + 2)
        # 52.2 m/h are 156.6 m in three hours, at 7 cm/s: 675 m want 4.31 times as much.
        self.assertIn("| 100 | 157 | 30.2 | 0 (0) | yes |", drives.drives_wish(lines))

    def test_the_page_has_the_tables_of_its_file(self):
        with open(ROOT / "results/studies/rover_speed_drives.csv", encoding="utf-8", newline="") as file:
            lines = [{name: value if name in ("drive", "computer") else float(value) for name, value in row.items()}
                     for row in csv.DictReader(file)]
        for line in lines:
            line["arrived"], line["trials"] = int(line["arrived"]), int(line["trials"])
        page = (ROOT / "results/speed.md").read_text(encoding="utf-8")
        for name, make in drives.TABLES.items():
            self.assertIn(f"<!-- begin {name} -->\n{make(lines)}\n<!-- end {name} -->", page)
