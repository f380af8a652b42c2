"""The closed forms of a rover's speed, on numbers made by hand and against a drive that is stepped through."""

import math
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

from context import ROOT
from rover_speed import figure
from rover_speed import model
from rover_speed import rover_speed as study

TIMES = model.Times(images=2.0, stereo=10.0, navigation=4.0, visual=30.0)
ROVER = model.Rover(0.05, 0.5, 0.8, overhead_s=3.0, steering_s=1.5)


class Stopping(unittest.TestCase):
    def test_a_blind_rover_pays_for_moves_alone(self):
        for sensor in ("stereo", "stripe"):
            self.assertAlmostEqual(model.speed(ROVER, TIMES, "blind", sensor), 1 / (20 + 3 / 0.5))

    def test_looks_and_steering_count_for_each_step(self):
        self.assertAlmostEqual(model.speed(ROVER, TIMES, "stop"), 1 / (20 + (3 + 1.5 + 16) / 0.5))

    def test_poses_have_their_own_way_and_images(self):
        self.assertAlmostEqual(model.speed(ROVER, TIMES, "blind", estimator="vision"), 1 / (20 + 3 / 0.5 + 32 / 0.8))
        self.assertAlmostEqual(model.speed(ROVER, TIMES, "stop", estimator="vision"),
                               1 / (20 + 20.5 / 0.5 + 32 / 0.8))

    def test_a_light_stripe_looks_every_wheel_radius(self):
        self.assertAlmostEqual(model.speed(ROVER, TIMES, "stop", "stripe"), 1 / (20 + (4.5 + 24) / 0.065))

    def test_it_is_the_net_rate_of_1995(self):
        stripe = model.speed(study.STRIPE_ROVER, model.Times(0, 0, 0, 0), "stop", "stripe")
        self.assertAlmostEqual(stripe, 0.0022, delta=0.00005)


def stepped(rover, latency_s, steering_s, cycles=50, tick_s=0.001):
    """Speed of a rover that is moved tick by tick: it looks at a fraction of its motion and waits at its end."""
    way_m = motion_m = time_s = 0.0
    looked_s = None
    cycle = 0
    while cycle < cycles:
        if motion_m < rover.step_m:
            way_m += rover.speed_m_s * tick_s
            motion_m += rover.speed_m_s * tick_s
        time_s += tick_s
        if looked_s is None and motion_m >= rover.fraction * rover.step_m:
            looked_s = time_s
        if looked_s is not None and time_s - looked_s >= latency_s:
            time_s += steering_s
            motion_m, looked_s = 0.0, None
            cycle += 1
    return way_m / time_s


class Continuous(unittest.TestCase):
    def test_a_plan_in_time_costs_nothing_but_steering(self):
        rover = model.Rover(0.07, 0.75, 0.75, steering_s=0.7)
        quick = model.Times(0.1, 0.02, 0.07, 0.1)
        self.assertAlmostEqual(model.speed(rover, quick, "csad", estimator="vision"), 0.07)
        way_m = 0.375 + 0.07 * 0.39
        self.assertAlmostEqual(model.speed(rover, quick, "csod", estimator="vision"), way_m / (way_m / 0.07 + 0.7))

    def test_a_late_plan_makes_the_rover_wait(self):
        rover = model.Rover(0.07, 0.75, 0.75)
        self.assertAlmostEqual(model.speed(rover, TIMES, "csad"), 0.75 / (0.375 / 0.07 + 16))

    def test_it_is_what_a_stepped_drive_does(self):
        for fraction in (0.0, 0.25, 0.75, 1.0):
            for latency_s in (0.5, 4.0, 12.0):
                for navigator, steering_s in (("csod", 1.5), ("csad", 0.0)):
                    rover = model.Rover(0.07, 0.6, 0.6, steering_s=1.5, fraction=fraction)
                    times = model.Times(latency_s, 0.0, 0.0, 0.0)
                    found = stepped(rover, latency_s, steering_s)
                    self.assertAlmostEqual(model.speed(rover, times, navigator) / found, 1.0, delta=0.005)

    def test_looking_at_the_end_of_a_motion_is_stopping_to_look(self):
        rover = replace(ROVER, overhead_s=0.0, fraction=1.0)
        self.assertAlmostEqual(model.speed(rover, TIMES, "csod"), model.speed(rover, TIMES, "stop"))

    def test_a_light_stripe_stops_the_rover(self):
        with self.assertRaisesRegex(ValueError, "light stripe"):
            model.speed(ROVER, TIMES, "csad", "stripe")


class Wheels(unittest.TestCase):
    def test_the_speed_needed_gives_the_speed_wanted(self):
        for navigator in ("stop", "csod", "csad"):
            rover = model.Rover(0.05, 0.75, 0.75, steering_s=0.5)
            times = model.Times(0.1, 1.0, 0.5, 2.0)
            needed = model.wheels_for(rover, times, 0.04, navigator)
            self.assertAlmostEqual(model.speed(replace(rover, speed_m_s=needed), times, navigator), 0.04)

    def test_a_slow_computer_has_none(self):
        # 0.5 m in 16 s of looking are 3.1 cm/s at most.
        self.assertTrue(math.isinf(model.wheels_for(ROVER, TIMES, 0.0315, "stop")))
        self.assertLess(model.wheels_for(replace(ROVER, overhead_s=0.0, steering_s=0.0), TIMES, 0.031, "stop"), 10.0)


class Study(unittest.TestCase):
    ROWS = model.read_times(ROOT / "results/studies/compute_times.csv")

    def test_ranges_hold_their_middles(self):
        for line in study.lines_of(self.ROWS):
            self.assertLessEqual(line["low"], line["m_per_h"], line)
            self.assertLessEqual(line["m_per_h"], line["high"], line)

    def test_published_speeds_have_the_verdicts_of_the_page(self):
        verdicts = {what: study.verdict(speed, span)
                    for what, speed, _, span, _ in study.published_speeds(self.ROWS) if speed is not None}
        self.assertEqual([what for what, word in verdicts.items() if word == "differs"], ["Athena 2012, CSAD"])
        self.assertEqual([what for what, word in verdicts.items() if word == "holds"], ["MFEX, light stripe"])

    def test_verdicts(self):
        span = model.Range(10.0, 8.0, 12.0)
        self.assertEqual([study.verdict(speed, span) for speed in (7.9, 8.0, 12.0, 12.1)],
                         ["differs", "in range", "in range", "differs"])
        sure = model.Range(10.0, 10.0, 10.0)
        self.assertEqual([study.verdict(speed, sure) for speed in (10.2, 10.3)], ["holds", "differs"])

    def test_who_meets_the_wish(self):
        self.assertAlmostEqual(100 * study.WISH_M_S, 6.25)
        spans = (model.Range(250, 226, 251), model.Range(226, 100, 251), model.Range(100, 90, 226),
                 model.Range(100, 90, 224))
        self.assertEqual([study.meets(span) for span in spans], ["yes", "by the middle", "where all is fast", "no"])

    def test_the_files_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rover_speed.csv"
            study.study.write_csv(path, list(study.lines_of(self.ROWS)))
            kept = ROOT / "results/studies/rover_speed.csv"
            self.assertEqual(path.read_text(encoding="utf-8"), kept.read_text(encoding="utf-8"))
        kept = ROOT / "results/studies/rover_speed.svg"
        self.assertEqual(study.draw(self.ROWS), kept.read_text(encoding="utf-8"))

    def test_the_page_has_the_tables(self):
        page = (ROOT / "results/speed.md").read_text(encoding="utf-8")
        for name, make in study.TABLES.items():
            self.assertIn(f"<!-- begin {name} -->\n{make(self.ROWS)}\n<!-- end {name} -->", page)


class Figure(unittest.TestCase):
    def test_marks_stand_where_their_speeds_are(self):
        series = [figure.Series("one", "#111"), figure.Series("two", "#222")]
        panel = figure.Panel("title", (("row", (model.Range(20, 10, 40), None)),), ((100, "wish"),))
        root = ElementTree.fromstring(figure.draw([panel], series, ["foot"]))
        dots = [item for item in root.iter() if item.tag.endswith("circle")]
        self.assertEqual([dot.get("fill") for dot in dots], ["#111", "#222", "#111"])
        self.assertAlmostEqual(float(dots[2].get("cx")), figure.x_of(20), delta=0.05)
        bars = [item for item in root.iter() if item.get("stroke-opacity")]
        self.assertEqual([(bar.get("x1"), bar.get("x2")) for bar in bars],
                         [(f"{figure.x_of(10):.1f}", f"{figure.x_of(40):.1f}")])

    def test_the_scale_is_one_of_powers(self):
        self.assertAlmostEqual(figure.x_of(20) - figure.x_of(10), figure.x_of(200) - figure.x_of(100))
