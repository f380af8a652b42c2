#!/usr/bin/python3
"""scripts/studies/figures/figures.py: what it draws is what the files say, and the same bytes each time.

Usage: figures_test.py ROCKYARD [unittest options]. Needs Debian's matplotlib, as the script does.
"""

import contextlib
import csv
import io
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pandas

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts/studies"))

# pylint: disable=wrong-import-position
import figures
from figures import figures as command
from figures import goldberg2002_figure3 as gestalt
from figures import howard2012
from figures import howard2012_figure6 as figure6
from figures import matthies1995_figure13 as figure13
from figures import matthies1995_figure4 as figure4
from figures import matthies1995_figure15 as figure15
from figures import matthies1995_figure16 as figure16
from figures import three_rock_course
from figures.source import Source
from rockyard import Trace

ROCKYARD = None
QUICK = ["--set", "referee.time_limit_s=1500", "--threads", "2", "--quiet"]


def python_path(first):
    return os.pathsep.join([str(first), os.environ["PYTHONPATH"]])


def drive_of(**parts):
    """A drive that knows these parts only."""
    drive = object.__new__(howard2012.NavigatorDrive)
    drive.__dict__.update(parts)
    return drive


def rows(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


SCRATCH = tempfile.TemporaryDirectory()  # of all tests


def setUpModule():
    """Runs of a few short trials, made once."""
    for name, scenario, trials in (("nominal", "pathfinder/nominal", 4),
                                   ("perfect", "pathfinder/nominal_perfect_localization", 3),
                                   ("gestalt", "gestalt/narrow_course", 1),
                                   ("scan", "hazard_detection/detection", 1),
                                   ("designation", "localization/designation", 12)):
        extra = ["--set", "hazard_detection.scenes_per_run=2"] if name == "scan" else []
        subprocess.run([ROCKYARD, "run", ROOT / f"scenarios/{scenario}.json", "--trials", str(trials),
                        "--out", Path(SCRATCH.name) / name, *QUICK, *extra], check=True)
    sand = Path(SCRATCH.name) / "sand"
    subprocess.run([ROCKYARD, "run", ROOT / "scenarios/pathfinder/level_sand.json", "--trials", "41", "--out", sand,
                    "--set", "rover.fidelity=quasi_static", "--traces", "all", "--quiet"], check=True)
    walks = Path(SCRATCH.name) / "walks"
    subprocess.run([ROCKYARD, "run", ROOT / "scenarios/localization/straight_sand.json", "--trials", "66", "--out",
                    walks, "--set", "dead_reckoning.walks_per_run=50", "--quiet"], check=True)


    steer = Path(SCRATCH.name) / "steer"
    subprocess.run([ROCKYARD, "run", ROOT / "scenarios/gestalt/narrow_course.json", "--trials", "1", "--out", steer,
                    "--set", "name=slow_steering", "--set", "rover.drive.steer_rate_deg_s=10", *QUICK], check=True)


def tearDownModule():
    SCRATCH.cleanup()


class FiguresTest(unittest.TestCase):
    root = Path(SCRATCH.name)

    def draw(self, name, *runs, **options):
        sources = [Source(self.root / run, ROCKYARD) for run in runs]
        return figures.all_figures()[name].draw(
            sources, SimpleNamespace(**{"trial": 0, "step": 0, "fields": 3, **options}))

    def script(self, *words, code=0, rockyard=True):
        """What the command says to these words, which it is given in this process."""
        words = [*words, "--rockyard", ROCKYARD] if rockyard else words
        said = io.StringIO()
        with (contextlib.chdir(self.root), contextlib.redirect_stdout(said), contextlib.redirect_stderr(said),
              mock.patch.object(sys, "argv", ["figures.py", *map(str, words)])):
            self.assertEqual(command.main(), code, said.getvalue())
        return said.getvalue()


class DrawnNumbers(FiguresTest):
    def test_distances_are_those_of_the_file(self):
        drawn = self.draw("matthies1995-17", "nominal", "perfect")
        curves = drawn.figure.axes[0].get_lines()
        for run, line in zip(("nominal", "perfect"), (each for each in curves
                                                      if len(each.get_xdata()) > 2
                                                      and each.get_marker() == "None")):
            table = rows(self.root / run / "distance_cdf.csv")
            distances = [float(row["distance_m"]) for row in table]
            self.assertEqual(list(line.get_xdata())[1:-1], distances)
            self.assertEqual(list(line.get_ydata())[1:-1], [float(row["ecdf"]) for row in table])
            self.assertIn(f"{distances[0]:.2f} m", drawn.caption)
        self.assertIn("not available", drawn.caption)
        marks = [line.get_xdata()[0] for line in curves if len(set(line.get_xdata())) == 1]
        self.assertEqual(marks, [7.0, 7.6, 8.39])

    def test_variances_along_runs_are_those_of_the_courses(self):
        drawn = self.draw("matthies1995-5", "sand")
        ends = []
        for trial in range(20):
            with np.load(self.root / f"sand/traces/trial-{trial:06d}.npz") as trace:
                way = trace["position_m"][:, 0]  # straight along x
                at = np.argmax(way >= 2.0)
                ends.append(trace["believed"][at, 3] - way[at])
            self.assertLess(way[at] - way[at - 1], 0.02)
        mean = sum(ends) / 20
        variance = sum((end - mean) ** 2 for end in ends) / 19
        # At 2 m, to a tick and to what the rover swerves.
        self.assertAlmostEqual(drawn.numbers["distance travelled"]["first"][7] / variance, 1.0, delta=0.1)
        self.assertEqual(len(drawn.numbers["heading"]["sets"]), 2)
        self.assertIn("41 runs", drawn.caption)
        dotted = [line for axes in drawn.figure.axes for line in axes.get_lines() if line.get_linestyle() == ":"]
        self.assertEqual([round(line.get_ydata()[1] / line.get_xdata()[1], 4) for line in dotted], [0.7, 0.0039])

    def test_deviations_are_those_of_the_cells(self):
        drawn = self.draw("matthies1995-6", "walks")
        cells = rows(self.root / "walks/cells.csv")
        for (_, series), variance in zip(drawn.numbers.items(), (0.7, 16.0)):
            for column, name in (("mean_across_deviation_m", "across"), ("mean_along_deviation_m", "along"),
                                 ("mean_heading_deviation_deg", "heading")):
                self.assertEqual(series[name],
                                 [float(cell[column]) for cell in cells
                                  if float(cell["heading_variance_deg2_per_m"]) == variance
                                  and float(cell["distance_m"]) <= 20.0])
        squares = [(line.get_xdata()[0], *line.get_ydata()) for axes in drawn.figure.axes
                   for line in axes.get_lines() if line.get_marker() == "s"]
        self.assertEqual(squares, [(10.0, 0.27, 0.20), (20.0, 0.76, 0.29), (5.0, 0.45, 0.15), (10.0, 1.25, 0.24)])
        self.assertIn("100 walks", drawn.caption)

    def test_paths_end_where_the_trial_did(self):
        drawn = self.draw("matthies1995-16", "nominal", trial=1)
        trial = rows(self.root / "nominal/trials.csv")[1]
        for path, columns in (("true", ("final_x_m", "final_y_m")), ("believed", ("believed_x_m", "believed_y_m"))):
            for value, column in zip(drawn.numbers[path][-1], columns):
                self.assertAlmostEqual(value, float(trial[column]), places=9)
        self.assertEqual(len(drawn.numbers["rocks"]), int(trial["rocks"]))

    def test_obstacles_are_where_scans_found_them(self):
        file = self.root / "trace.csv"
        subprocess.run([ROCKYARD, "trace", self.root / "nominal", "--trial", "1", "--csv", file], check=True,
                       stdout=subprocess.DEVNULL)
        hazards = [row for row in rows(file) if row["row"] == "event" and row["kind"] == "hazard"]
        drawn = self.draw("matthies1995-16", "nominal", trial=1).numbers
        for kind in ("true", "believed"):
            self.assertEqual(drawn[f"hazards_{kind}"], [(float(row[f"{kind}_x_m"]), float(row[f"{kind}_y_m"])) for row in hazards])

    def test_rocks_are_counted_without_their_mirror_images(self):
        drawn = self.draw("matthies1995-15", "nominal", fields=3)
        source = Source(self.root / "nominal", ROCKYARD)
        terrains = [source.terrain(trial) for trial in range(3)]
        placed = sum(terrain["audit"]["placed"] for terrain in terrains)
        self.assertEqual(drawn.numbers["counts"][0], placed)  # from 10 cm, the smallest there are
        self.assertAlmostEqual(drawn.numbers["area_m2"], 3 * 26.4)
        expected = sum(terrain["audit"]["expected_placed"] for terrain in terrains)
        self.assertAlmostEqual(drawn.numbers["made_per_m2"][0] * 3 * 26.4, expected)
        self.assertAlmostEqual(drawn.numbers["made_per_m2"][-1], 0.0, places=9)
        self.assertEqual(min(rock[2] for rock in drawn.numbers["plan"]) >= 0.15, True)

    def test_designation_errors_stand_beside_the_equations(self):
        drawn = self.draw("matthies1995-4", "designation").numbers
        settings = {"pixel_rad": 0.001, "disparity_sd_px": 0.1, "pixel_sd_px": 1.0,
                    "baseline_m": 0.15, "pan_error_deg": 1.0}
        at_20 = figure4.equations(20.0, settings)
        self.assertAlmostEqual(at_20["downrange"], 0.0001 * 400 / 0.15)
        self.assertAlmostEqual(at_20["crossrange"], 0.02)
        self.assertAlmostEqual(at_20["pan"], 20 * math.pi / 180)
        place = drawn["range_m"].index(20.0)
        for name, wanted in at_20.items():  # of 1000 goals, within some 10 %
            self.assertAlmostEqual(drawn[name][place][0], wanted, delta=0.12 * wanted)
            self.assertLess(drawn[name][place][1], 0.1 * wanted)
        with self.assertRaisesRegex(figures.FigureError, "no run of the experiment designation"):
            self.draw("matthies1995-4", "scan")

    def test_moores_law(self):
        self.assertAlmostEqual(figure15.law_per_m2(0.013, 0.23), 0.65, places=2)
        self.assertAlmostEqual(figure15.law_per_m2(0.013, 0.15), 2.0, places=1)

    def test_counts_of_no_rock_have_an_upper_limit(self):
        axes = self.draw("matthies1995-15", "nominal", fields=1).figure.axes[0]
        limits = [line for line in axes.lines if str(line.get_label()).startswith("none seen")]
        self.assertEqual(len(limits), 1)
        for limit in limits[0].get_ydata():
            self.assertAlmostEqual(limit * 26.4, 3.688879, places=4)

    def test_places_that_are_believed_are_named(self):
        legend = self.draw("matthies1995-16", "nominal", trial=1).figure.axes[0].get_legend()
        self.assertIn("obstacle detected here (believed place)", [text.get_text() for text in legend.get_texts()])

    def test_the_straight_arc_has_a_tick(self):
        drawn = self.draw("goldberg2002-3", "gestalt", step=1)
        ticks = [tick.get_text() for axes in drawn.figure.axes for tick in axes.get_xticklabels()]
        self.assertIn("0", ticks)
        self.assertNotIn("-", "".join(ticks))

    def test_votes_are_those_of_the_step(self):
        drawn = self.draw("goldberg2002-3", "gestalt", step=1)
        source = Source(self.root / "gestalt", ROCKYARD)
        table = rows(source.step(0, 1) / "votes.csv")
        meshes = [mesh for axes in drawn.figure.axes for mesh in axes.collections
                  if mesh.get_array() is not None and mesh.get_array().size == 3 * 23]
        self.assertEqual(len(meshes), 2)
        for group, mesh in zip(gestalt.GROUPS, meshes):
            votes = [row for row in table if row["kind"] == group][::-1]  # left turns on the left
            for line, kind in zip(mesh.get_array().reshape(3, 23)[::-1], gestalt.ROWS):
                self.assertEqual(list(line), [float(vote[kind]) for vote in votes])
        chosen = [row for row in table if row["chosen"] == "1" and row["kind"] != "point_turn"]
        self.assertEqual([each[1] for each in drawn.numbers["chosen"]],
                         [float(row["curvature_per_m"]) for row in chosen])

    def test_paths_of_navigators_are_those_of_their_trials(self):
        drawn = self.draw("howard2012-6", "gestalt", "steer")
        self.assertEqual(len(drawn.numbers), 2)
        for run, numbers in zip(("gestalt", "steer"), drawn.numbers.values()):
            trial = rows(self.root / run / "trials.csv")[0]
            for path, columns in (("true", ("final_x_m", "final_y_m")),
                                  ("believed", ("believed_x_m", "believed_y_m"))):
                for value, column in zip(numbers[path][-1], columns):
                    self.assertAlmostEqual(value, float(trial[column]), places=9)
            self.assertIn(f"{float(trial['dead_reckoned_distance_m']):.2f} m by its wheels", drawn.caption)
        solid = [line for line in drawn.figure.axes[0].get_lines() if str(line.get_label()).endswith("as recorded")]
        self.assertEqual(len({(line.get_color(), str(line.get_linestyle())) for line in solid}), 2)

    def test_the_way_is_as_visual_odometry_sees_it_where_there_is_one(self):
        record = {"visual_distance_m": 15.25, "dead_reckoned_distance_m": 18.5}
        drive = drive_of(record=record)
        self.assertEqual(drive.way_as_seen(), "15.25 m by visual odometry")
        record["visual_distance_m"] = math.nan
        self.assertEqual(drive.way_as_seen(), "18.50 m by its wheels")

    def test_rocks_out_of_view_are_left_out(self):
        limits = {"xlim": (0.0, 10.0), "ylim": (-2.0, 2.0)}
        for x, y, seen in ((5.0, 0.0, True), (-0.4, 0.0, True), (10.4, 0.0, True), (5.0, -2.4, True), (5.0, 2.4, True),
                           (-0.6, 0.0, False), (10.6, 0.0, False), (5.0, -2.6, False), (5.0, 2.6, False)):
            self.assertEqual(figure6.is_in_view(limits, (x, y, 0.5)), seen, (x, y))
        axes = self.draw("howard2012-6", "nominal").figure.axes[0]
        rocks = figure16.rocks_of(Source(self.root / "nominal", ROCKYARD).terrain(0))
        view = {"xlim": axes.get_xlim(), "ylim": axes.get_ylim()}
        wanted = sum(figure6.is_in_view(view, rock) for rock in rocks)
        self.assertTrue(0 < wanted < len(rocks), (wanted, len(rocks)))
        self.assertEqual(sum(len(each.get_paths()) for each in axes.collections), wanted)

    def test_distances_to_the_goal_are_by_belief_and_by_truth(self):
        numbers = next(iter(self.draw("howard2012-7", "gestalt").numbers.values()))
        trial = rows(self.root / "gestalt/trials.csv")[0]
        self.assertAlmostEqual(numbers["true_m"][-1], float(trial["true_goal_distance_m"]), places=9)
        self.assertAlmostEqual(numbers["believed_m"][-1], float(trial["believed_goal_distance_m"]), places=9)
        self.assertAlmostEqual(numbers["time_s"][-1], float(trial["sim_time_s"]), places=9)
        within = numbers["within_s"]
        self.assertLess(within, numbers["time_s"][-1])
        for t, distance in zip(numbers["time_s"], numbers["believed_m"]):
            if t < within:
                self.assertGreater(distance, 0.5)

    def test_a_goal_that_is_never_near_has_no_time(self):
        drive = drive_of(time_s=np.array([0.0, 1.0]))
        self.assertEqual(drive.time_within_s(np.array([3.0, 0.5])), 1.0)
        self.assertIsNone(drive.time_within_s(np.array([3.0, 0.6])))
        self.assertEqual(howard2012.seconds(None), "never")

    def test_steering_adds_up_to_what_the_record_says(self):
        drawn = self.draw("howard2012-8", "gestalt", "steer")
        for run, numbers in zip(("gestalt", "steer"), drawn.numbers.values()):
            trial = rows(self.root / run / "trials.csv")[0]
            self.assertEqual(numbers["steered"], ["left front", "left rear", "right front", "right rear"])
            turned = numbers["turned_rad"]
            self.assertGreater(max(turned), 1.0)
            # Athena steers all six, and its middle ones, abreast of the centre, have nothing to steer.
            self.assertAlmostEqual(sum(turned) / 6, float(trial["steer_turned_rad"]), places=9)
            self.assertAlmostEqual(max(turned), float(trial["steer_turned_max_rad"]), places=9)
            self.assertIn(f"{float(trial['steer_turned_rad']):.2f} rad", drawn.caption)
        self.assertEqual([len(axes.get_lines()) for axes in drawn.figure.axes], [4, 4])

    def test_curves_are_drawn_as_often_as_was_recorded(self):
        times = [0.05 * i for i in range(101)]
        ramp = howard2012.curve(times, times)
        self.assertEqual(ramp[0], ramp[1])
        self.assertEqual((ramp[0][0], ramp[0][-1]), (0.0, times[-1]))
        for before, now in zip(ramp[0], ramp[0][1:-1]):
            self.assertAlmostEqual(now - before, 0.2, delta=0.051)
        # A step: its foot and its top stand where they are, and nothing between its ends.
        step = howard2012.curve(times, [0.0] * 51 + [1.0] * 50)
        self.assertEqual(step[1], [0.0, 0.0, 1.0, 1.0])
        self.assertEqual((step[0][0], step[0][-1]), (0.0, times[-1]))
        self.assertAlmostEqual(step[0][1], 2.5, delta=0.2)
        self.assertLess(step[0][2] - step[0][1], 0.21)

    def test_what_operators_turn_is_no_steering(self):
        angles = np.array([[0.0] * 6, [0.2] * 6, [0.0] * 6, [-0.1] * 6])
        drive = drive_of(trace={"steer_rad": angles, "set_back": np.array([False, False, True, False])})
        for turned in drive.turned_rad():
            self.assertAlmostEqual(turned, 0.3)

    def test_navigators_of_one_name_are_told_apart(self):
        self.assertEqual(list(self.draw("howard2012-7", "gestalt", "gestalt").numbers), ["gestalt_narrow_course (gestalt)"])
        self.assertEqual(list(self.draw("howard2012-7", "gestalt", "steer").numbers),
                         ["gestalt_narrow_course", "slow_steering"])

    def test_a_scenario_is_driven_with_its_own_seed(self):
        by_file = self.draw("howard2012-7", ROOT / "scenarios/gestalt/narrow_course.json")
        by_run = self.draw("howard2012-7", "gestalt")
        self.assertEqual(by_file.numbers["gestalt_narrow_course"]["time_s"][1], by_run.numbers["gestalt_narrow_course"]["time_s"][1])

    def test_arcs(self):
        quarter = math.pi / 2 / gestalt.ARC_M  # a quarter of a circle over the drawn length
        forward, left = gestalt.arc_points(quarter, 1)[-1]
        self.assertAlmostEqual(forward, 1.0 / quarter)
        self.assertAlmostEqual(left, 1.0 / quarter)
        self.assertEqual(gestalt.arc_points(0.0, -1)[-1], (-gestalt.ARC_M, 0.0))

    def test_errors_of_table_4(self):
        drawn = self.draw("matthies1995-table4", "nominal")
        table = rows(self.root / "nominal/trials.csv")
        for column in ("distance_error_percent", "heading_error_deg", "position_error_m"):
            self.assertEqual(drawn.numbers[column], [float(row[column]) for row in table])

    def test_stripes_reach_as_far_as_published(self):
        drawn = self.draw("matthies1995-13", "nominal")
        points = drawn.numbers["points"]
        self.assertEqual(len(points), 20)
        self.assertAlmostEqual(points[17][0] - 0.65 / 2, 0.30)  # the middle stripe, ahead of the rover
        self.assertAlmostEqual(points[15][1] - 0.48 / 2, 0.13)  # the left one, beyond its side
        # The light plane from (0.27, 0.14) to (0.625, 0.37), by hand, at 0.425.
        self.assertAlmostEqual(points[0][0], 0.425)
        self.assertAlmostEqual(points[0][1], 0.14 + 0.23 * 0.155 / 0.355)
        for (x, y), (mirror_x, mirror_y) in zip(points[5:10], reversed(points[5:10])):
            self.assertAlmostEqual(x, mirror_x)
            self.assertAlmostEqual(y, -mirror_y)
        marks = {line.get_label(): len(line.get_xdata()) for line in drawn.figure.axes[0].get_lines()}
        self.assertEqual(marks["measured points: place published"], 3)
        self.assertEqual(marks["measured points: place assumed"], 17)

    def test_stripes_are_lit_and_seen_where_they_are_measured(self):
        numbers = self.draw("matthies1995-13", "nominal").numbers
        for i, (x, _) in enumerate(numbers["points"]):
            near, far = numbers["lit"][i % 5]
            self.assertTrue(near < x < far, i)
        # 0.25 m above the ground, 45 deg down, half a view of 0.0066 / 0.0048 / 2 rad: from 84 deg on.
        for outline in numbers["seen"]:
            nearest = 0.27 + 0.25 / math.tan(math.pi / 4 + 0.0066 / 0.0048 / 2)
            self.assertAlmostEqual(min(x for x, _ in outline), nearest)
        self.assertAlmostEqual(max(y for _, y in numbers["seen"][0]), -min(y for _, y in numbers["seen"][1]))

    def test_rays_of_lenses(self):
        for lens in ("equidistant_rows", "equidistant", "pinhole"):
            self.assertEqual(figure13.ray(lens, 0.0, 0.0), (1.0, 0.0, 0.0))
        for got, true in zip(figure13.ray("equidistant_rows", math.pi / 2, 0.3), (0.0, -1.0, 0.0)):
            self.assertAlmostEqual(got, true)
        for got, true in zip(figure13.ray("equidistant", 0.0, math.pi / 2), (0.0, 0.0, -1.0)):
            self.assertAlmostEqual(got, true)

    def test_paths_keep_their_ends(self):
        self.assertEqual(figure16.thinned([(x, 0.0) for x in (0.0, 0.004, 0.02, 0.021)]), [(0.0, 0.0), (0.02, 0.0), (0.021, 0.0)])


class CommandLine(FiguresTest):
    def test_the_course_of_a_run_among_rocks(self):
        time_s, x, true_deg, believed_deg = np.array([
            (0, 0.0, 0, 0), (1, 0.0, 0, 0), (2, 0.5, 0, 1), (2.6, 0.5, 0, 1), (3, 0.6, 179, -177), (4, 1.5, 0, -3), (5, 2.0, 0, 6)]).T
        alarm_s = np.array([2.5, 2.7, 4.5, 4.6])
        arrays = {"time_s": time_s, "position_m": np.transpose([x, 0 * x, 0 * x]), "heading_rad": np.radians(true_deg),
                  "believed": np.transpose([x, 0 * x + 0.1, np.radians(believed_deg), x]), "event_time_s": alarm_s,
                  "activity": np.array(["", "drive", "drive", "scan", "drive", "drive", "drive"]),
                  "event_pose": np.zeros((4, 3)), "event_kind": np.array(["hazard"] * 3 + ["scan"]), "event_detail": np.array([""] * 4)}
        file = self.root / "among_rocks.npz"
        np.savez(file, **arrays)
        course = three_rock_course.Course(Trace(file))
        for got, expected in zip(course.path, (0.0, 0.5, 0.6, 1.5, 2.0)):
            self.assertAlmostEqual(got, expected)
        for got, expected in zip(course.error_deg, (0, 1, 4, -3, 6)):
            self.assertAlmostEqual(got, expected)
        # The second alarm is of the first one's avoidance, at the same place; the last is 1.4 m on.
        self.assertEqual(course.alarms, [2, 4])
        self.assertAlmostEqual(course.error_at(0.55), 4.0)
        self.assertEqual(three_rock_course.side_of(course, {"final_deg": -6.0}), -1.0)
        rows = three_rock_course.band([(course, 1.0), (course, -1.0), (course, 1.0)])
        self.assertAlmostEqual(rows[-1][0], 2.0)
        self.assertAlmostEqual(rows[-1][2], 6.0)

    def test_every_figure_is_listed_with_its_runs(self):
        text = subprocess.run([ROOT / "scripts/studies/figures/figures.py", "--list"], text=True, check=True,
                              capture_output=True).stdout
        for name in ("matthies1995-13", "matthies1995-15", "matthies1995-16", "matthies1995-17", "matthies1995-5",
                     "matthies1995-6", "matthies1995-7", "matthies1995-8", "matthies1995-table4",
                     "goldberg2002-3", "howard2012-6", "howard2012-7", "howard2012-8"):
            self.assertIn(name, text)
        self.assertIn("scenarios/continuous/csad.json", text)

    def test_the_run_that_is_drawn_is_the_first_that_ended_like_the_published_one(self):
        drives = pandas.DataFrame([("goal_reached", 0.9), ("jammed", 1.4), ("false_goal", 1.5), ("goal_reached", 1.4)],
                                  columns=["outcome", "true_goal_distance_m"])
        self.assertEqual(figure16.like_the_published(SimpleNamespace(path="run", drives=lambda: drives)), 2)
        with self.assertRaises(figure16.FigureError):
            figure16.like_the_published(SimpleNamespace(path="run", drives=lambda: drives[:2]))

    def test_the_same_runs_give_the_same_bytes(self):
        drawn = [(name, run, "--trial", "0") for name, run in (
            ("matthies1995-17", "nominal"), ("goldberg2002-3", "gestalt"), ("matthies1995-16", "nominal"),
            ("matthies1995-13", "nominal"), ("howard2012-6", "gestalt"), ("howard2012-7", "gestalt"),
            ("howard2012-8", "gestalt"))]
        for words in drawn:
            self.script(*words, "--out", "first")
        again = ("import sys; from figures import figures as command\n"
                 "for words in map(str.split, sys.stdin):\n"
                 "    sys.argv[1:] = words; assert command.main() == 0")
        lines = "\n".join(" ".join([*words, "--out", "second", "--rockyard", str(ROCKYARD)]) for words in drawn)
        subprocess.run([sys.executable, "-c", again], cwd=self.root, check=True, input=lines, text=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "PYTHONPATH": python_path(ROOT / "scripts/studies")})
        files = sorted(path.name for path in (self.root / "first").iterdir())
        self.assertEqual(len(files), 21)  # SVG, PNG and caption of each
        for name in files:
            first, second = ((self.root / out / name).read_bytes() for out in ("first", "second"))
            self.assertEqual(first, second, name)
            self.assertLess(len(first), 200_000, name)

    def test_names_of_runs_are_text(self):
        run = self.root / "marked"
        subprocess.run([ROCKYARD, "run", ROOT / "scenarios/pathfinder/nominal.json", "--trials", "1",
                        "--out", run, *QUICK, "--set", "name=<script>&$x^2$"], check=True)
        self.script("matthies1995-17", run, "--out", "marked_out")
        svg = (self.root / "marked_out/matthies1995-17.svg").read_text(encoding="utf-8")
        self.assertNotIn("<script", svg)
        self.assertIn("&lt;script&gt;&amp;$x^2$", svg)

    def test_what_is_wrong_is_said_in_a_line(self):
        (self.root / "empty").mkdir(exist_ok=True)
        broken = shutil.copytree(self.root / "nominal", self.root / "broken")
        (broken / "summary.json").write_text('{"scenario": "na', encoding="utf-8")
        subprocess.run([ROCKYARD, "sweep", ROOT / "scenarios/sweeps/abundance.json", "--trials", "1", "--out",
                        self.root / "sweep", "--set", "referee.time_limit_s=10", "--quiet"], check=True)
        for words, reason in ((["matthies1995-17"], "needs 1 to 2 RUN, and 0 were given"),
                              (["matthies1995-99", "nominal"], "is no figure; one of"),
                              ([], "no figure is named"),
                              (["matthies1995-17", "nowhere"], "does not exist"),
                              (["matthies1995-17", "empty"], "name the folder of a run"),
                              (["matthies1995-17", "broken"], "its summary cannot be read"),
                              (["matthies1995-17", "sweep"], "cell"),
                              (["matthies1995-17", "scan"], "no run of drives"),
                              (["matthies1995-16", "nominal", "--trial", "99"], "trial 99"),
                              (["matthies1995-16", "nominal", "--trial", "-1"], "at least 0"),
                              (["goldberg2002-3", "gestalt", "--step", "999"], "step 999"),
                              (["goldberg2002-3", "nominal"], "step"),
                              (["matthies1995-15", "gestalt"], "Moore's model"),
                              (["matthies1995-13", "gestalt"], "looks with stereo"),
                              (["matthies1995-13", "scan"], "no run of drives"),
                              (["howard2012-6", "gestalt", "nominal"], "differs from gestalt in rocks"),
                              (["howard2012-7", "scan"], "rockyard"),
                              (["howard2012-8", *["gestalt"] * 7], "needs 0 to 6 RUN, and 7 were given"),
                              (["matthies1995-5", "nominal"], "keeps no courses"),
                              (["matthies1995-5", "walks"], "no run of drives"),
                              (["matthies1995-6", "nominal"], "no run of the experiment dead_reckoning")):
            with self.subTest(words=words):
                text = self.script(*words, "--out", "none", code=2)
                self.assertIn("error: ", text)
                self.assertIn(reason, text)
                self.assertNotIn("Traceback", text)
        self.assertFalse((self.root / "none").exists())

    def test_a_command_that_is_not_there(self):
        text = self.script("matthies1995-16", "nominal", "--trial", "0", "--rockyard", "/nowhere/rockyard", code=2,
                           rockyard=False)
        self.assertIn("quickstart.sh", text)

    def test_without_matplotlib_it_says_how_to_get_it(self):
        (self.root / "shadow").mkdir(exist_ok=True)
        (self.root / "shadow/matplotlib.py").write_text("raise ImportError('no matplotlib')\n", encoding="utf-8")
        result = subprocess.run([ROOT / "scripts/studies/figures/figures.py", "--list"], text=True,
                                env={"PYTHONPATH": python_path(self.root / "shadow")}, capture_output=True,
                                check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("scripts/install_dependencies.sh figures", result.stderr)


if __name__ == "__main__":
    ROCKYARD = Path(sys.argv.pop(1)).resolve()
    unittest.main()
