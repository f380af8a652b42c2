"""The command lines of studies: what they run, and what they make of what comes back."""

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from context import ROOT, StudyTest, run_of, study
from course import course
from gestalt import gestalt
from navigator import navigator
from pathfinder import pathfinder
from regression import regression
from sensor_suite import sensor_suite
from threshold import threshold

rates = study.rates


class RegressionStudy(StudyTest):
    """With checks that find a change where a setting was changed, and one resampling."""

    POWER = ("study,cell,metric,discordance,campaigns,alarms,alarms_low,alarms_high,found,found_low,found_high,"
             "primary_alarms,secondary_alarms,inconclusive\n"
             "unchanged: other seeds,,,0,2000,13,0.0035,0.0111,0,0,0.002,9,4,93\n"
             "success 0.10 lower,nominal,true_success,0.3,2000,1900,0.94,0.96,1880,0.93,0.95,1890,0,2\n")

    def answer(self, words):
        if words[0] == "study":
            return 0, self.POWER
        if words[1] == "sweep":
            self.changed = "--set" in words
        if words[1] != "check":
            return 0, ""
        metric = {"cell": "cell=nominal", "metric": "true_success", "unit": "1", "family": "primary", "difference": -0.25,
                  "margin": 0.1, "verdict": "changed" if self.changed else "equivalent"}
        return int(self.changed), json.dumps({"cells": [{"records": {"pairs": 750, "changed": 3}}], "metrics": [metric]})

    def test_page_says_what_was_found(self):
        page = self.root / "page.md"
        self.script(regression, "--markdown", page, "--reruns", 2, "--repeats", 1, "--pool", 40, "--study", "study",
                    "--out", self.root / "runs")
        self.assertEqual([line.split(" /")[0] for line in self.calls if line.startswith("study")], ["study 750 2000 1"])
        text = page.read_text(encoding="utf-8")
        self.assertIn("| unchanged | the same | 1 | 1, 0, 0 | 3 of 750 | 0 | 0 |  |", text)
        self.assertIn("| unchanged | others | 2 | 2, 0, 0 |", text)
        self.assertIn("| hazard threshold 5 to 6 cm | the same | 1 | 0, 1, 0 | 3 of 750 | 1 | 0 "
                      "| nominal: true_success -0.25 1 |", text)
        self.assertIn("| other seeds | 2000 | 0.7 (0.4 .. 1.1) | 9 | 4 | 93 |", text)
        self.assertIn("| nominal | true_success | 0.3 | 2000 | 94.0 (93.0 .. 95.0) |", text)
        sweeps = self.commands("sweep")
        self.assertEqual(len(sweeps), 3 + 6 * 2)
        self.assertIn("--set perception.hazard.neighbour_threshold_m=0.06", "".join(sweeps))
        self.assertEqual(len(self.lines("page.csv")), 1 + len(sweeps))


RATE = {"rate": 0.5, "ci95": [0.25, 0.75], "count": 1, "trials": 2}
SUMMARY = StudyTest.summary | {"declared_success": RATE, "true_success": RATE}
NUMBERS = ("true_distance_m", "scrapes", "hazards_met", "hazards_missed", "sim_time_s", "energy_wh", "scan_energy_wh",
           "contact_hazards", "tilt_hazards", "articulation_hazards", "current_hazards")


def trial(number, outcome, *values, names=NUMBERS):
    return {"trial": number, "outcome": outcome} | dict(zip(names, values or [math.nan] * len(names)))


class Studies(StudyTest):
    """Three trials, and a fault."""

    summary = SUMMARY
    rows = [trial(0, "goal_reached", 8, 1, 4, 1, 600, 10, 5, 1, 0, 0, 0), trial(1, "simulator_fault"),
            trial(2, "no_path", 6, 3, 4, 1, 1200, 12, 6, 0, 0, 0, 2), trial(3, "jammed", 4, 2, 2, 0, 1800, 14, 7, 0, 0, 1, 0)]

    def rows_of(self, folder):
        if folder.endswith("/contact") and self.gains:
            return [row | {"outcome": "false_goal"} if row["trial"] == 2 else row for row in self.rows]
        return self.rows

    def setUp(self):
        super().setUp()
        self.gains = False

    def threshold(self, *words, **code):
        return self.script(threshold, "--out", self.root, *words, **code)

    def suite(self):
        return self.script(sensor_suite, ROOT / "scenarios/mars/mfex_nominal.json", "--out", self.root)

    def test_threshold_study_drives_every_threshold(self):
        self.threshold("--trials", 7, "--low", 4, "--high", 6, "--set", "clock.stop_time_s=0.1")
        runs = self.commands("run")
        self.assertEqual(len(runs), 6)
        for index, line in enumerate(runs):
            self.assertIn(("nominal.json", "vl2.json")[index // 3], line)
            self.assertIn(f"neighbour_threshold_m=0.0{4 + index % 3}", line)
            self.assertIn("--trials 7 --seed 1", line)
            self.assertIn("--set rover.fidelity=quasi_static --set clock.stop_time_s=0.1", line)
        table = self.lines("threshold.md")
        self.assertEqual(len([line for line in table if line.startswith("| ")]), 8)
        # Mean of 8, 6 and 4 m with 1.96 standard errors; two of ten hazards; faults left out.
        self.assertIn("6.00 (3.74..8.26)", table[2])
        self.assertIn("20.00 (", table[2])
        self.assertEqual(len(self.lines("threshold.csv")), 7)
        self.assertIn("made by rockyard 0.1.0 abc.", table[-1])
        self.assertEqual("\n".join(self.lines("threshold.svg")).count("<polyline"), 10)

    def test_suite_study_drives_every_subset_once(self):
        self.suite()
        runs = self.commands("run")
        self.assertEqual(len({line.split("--set", 1)[1] for line in runs}), 32)
        for sensor in sensor_suite.SENSORS.values():
            self.assertEqual(sum(f"{sensor}=true" in line for line in runs), 16)
            self.assertEqual(sum(f"{sensor}=false" in line for line in runs), 16)
        table = self.lines("sensor_suite.md")
        self.assertTrue(table[2].startswith("| mfex_nominal | none |"), table[2])
        self.assertTrue(table[2].endswith("| 33 | 33 |"), table[2])  # jammed, no path

    def test_runs_that_are_there_are_resumed(self):
        for times in (1, 2):
            self.threshold("--low", 5, "--high", 5)
            resumed = [line for line in self.commands("run") if "--resume" in line]
            self.assertEqual(len(resumed), 2 * (times - 1))

    def test_what_makes_no_sense_runs_nothing(self):
        for words in (["--low", 0], ["--low", 9, "--high", 5]):
            self.threshold(*words, code=2)
        self.assertEqual(self.calls, [])

    def test_a_failed_run_says_why(self):
        self.answer = lambda words: (2, "")
        self.assertIn("exit code 2", self.threshold(code=1).err)

    def test_pairs_of_trials_are_tested(self):
        # Every subset leaves the same trials: no pair differs. With the light stripe the second
        # succeeds too, so one pair is gained: p = 1.
        self.suite()
        rows = self.lines("sensor_suite_pairs.csv")
        self.assertEqual(len(rows), 1 + 2 * 31)
        self.assertIn("mfex_nominal,light stripe,none,declared,0,0,1.0,1.0", rows)
        self.gains = True
        self.suite()
        rows = self.lines("sensor_suite_pairs.csv")
        self.assertIn("mfex_nominal,contact,none,declared,1,0,1.0,1.0", rows)
        self.assertIn("mfex_nominal,contact,none,true,0,0,1.0,1.0", rows)
        self.assertIn("0.1.0 abc", self.lines("sensor_suite.csv")[1])
        self.assertIn("62 tests by pairs (McNemar, Holm), 0 differ", "\n".join(self.lines("sensor_suite.md")))


class NavigatorStudy(StudyTest):
    """A GESTALT that gains two of three pairs, whatever the rocks."""

    summary = SUMMARY
    rows = [{"outcome": outcome, "true_distance_m": 1.0} for outcome in ("goal_reached", "no_path", "no_path")]
    MEAN = {"n": 30, "first": 6.0, "second": 9.0, "difference": 3.0, "low": 2.5, "high": 3.5}
    NONE = dict.fromkeys(("first", "second", "difference", "low", "high")) | {"n": 0}

    def compare(self, first, second):
        del first, second
        means = {("all", column): self.MEAN for column in navigator.MEANS} | {
            ("arrived", column): self.NONE for column in navigator.MEANS}
        return {"declared": (66.7, 7.7, 92.3, 0.5), "true": (0.0, -42.0, 42.0, 1.0)}, means

    def navigators(self, *words):
        with mock.patch.object(study, "compare", self.compare):
            return self.script(navigator, "--out", self.root, *words)

    def test_both_navigators_meet_the_same_trials(self):
        self.navigators("--trials", 3)
        runs = self.commands("run")
        # Two rovers: five abundances with two arms, and at two of them three more.
        self.assertEqual(len(runs), 2 * (5 * 2 + 2 * 3))
        for rover in ("abundance", "abundance_rocky_3_2"):
            for ending, count in (("", 7), ("_behaviour", 5), ("_behaviour_stereo", 2),
                                  ("_behaviour_stereo_stripe", 2)):
                self.assertEqual(sum(f"gestalt/{rover}{ending}.json" in line for line in runs), count)
        cropped = [line for line in runs if "field_of_view=stripe" in line]
        self.assertEqual(len(cropped), 4)
        self.assertNotIn("_behaviour", "".join(line.split("--quiet")[0] for line in cropped))
        # No arm takes another sensor by a setting: thresholds belong to the sensor.
        self.assertFalse(any("terrain_sensor=" in line or "navigator=" in line for line in runs))
        self.assertEqual(sum("k_per_m2=0.013" in line for line in runs), 10)
        for line in runs:
            self.assertIn("--trials 3 --seed 1", line)
        rows = self.lines("navigators_pairs.csv")
        self.assertEqual(len(rows), 1 + 2 * (5 + 2 * 5))
        self.assertIn("GESTALT", rows[1])
        self.assertIn(",66.7,7.7,92.3,0.5,", rows[1])
        self.assertTrue(rows[1].endswith(",1.0,1.0"), rows[1])  # Holm: 30 tests of p 0.5, 30 of p 1
        table = "\n".join(self.lines("navigators.md"))
        self.assertIn("| +0 (-42..+42) | 1 | 30 | 3.00 (2.50..3.50) |", table)
        self.assertIn("| +0 (-42..+42) | 1 | 0 | - | - | - |", table)
        self.assertIn("| no_path (gave_up) 1 |", table)
        self.assertEqual("\n".join(self.lines("navigators.svg")).count("<polyline"), 8)

    def test_one_rover_alone(self):
        self.navigators("--rovers", "rocky_3_2", "--set", "seed=4")
        self.assertEqual(len(self.commands("run")), 16)
        self.assertIn("held: seed=4", "\n".join(self.lines("navigators.md")))

    def test_scenarios_of_every_arm_are_there(self):
        for stem in navigator.ROVERS.values():
            for ending, _ in navigator.ARMS.values():
                self.assertTrue((ROOT / f"scenarios/gestalt/{stem}{ending}.json").is_file())


class GestaltStudy(StudyTest):
    """Comparisons that gain two of three pairs, whatever is compared."""

    # A setting that undoes each choice, in the order of the script.
    UNDONE = ("max_turn_share=2", "max_bogie_deg=30", "backward_arcs=below_threshold",
              "point_turns=below_min_vote", "step_reference=level", "veto_felt=false",
              "distance_scale=0.995")
    NAMES = ("true_distance_m", "dead_reckoned_distance_m", "moves", "rear_image_sets", "reversals", "safeguard_stops")
    summary = SUMMARY | {"outcomes": {"jammed": 1}}
    rows = [trial(0, "goal_reached", 8, 9, 10, 2, 1, 0, names=NAMES), trial(1, "no_path", 2, 2.5, 10, 4, 3, 1, names=NAMES),
            trial(2, "jammed", 2, 9.5, 20, 0, 0, 2, names=NAMES)]

    def gestalt(self, *words, code=0):
        success = {"declared": (0.0, -42.0, 42.0, 1.0), "true": (66.7, 7.7, 92.3, 0.5)}
        with mock.patch.object(study, "compare", lambda first, second: (success, {})):
            return self.script(gestalt, "--out", self.root, *words, code=code).out

    def test_every_choice_stands_alone_and_is_left_out(self):
        out = self.gestalt("--tables", "changes", "--trials", 3)
        count, runs = len(self.UNDONE), self.commands("run")
        alone = [tuple(other != choice for other in range(count)) for choice in range(count)]
        without = [tuple(other == choice for other in range(count)) for choice in range(count)]
        both = [undone for pair in zip(alone, without) for undone in pair]
        found = [tuple(setting in line for setting in self.UNDONE) for line in runs]
        self.assertEqual(found, 4 * [(True,) * count, (False,) * count, *both])
        self.assertEqual(sum("localization.estimator=oracle" in line for line in runs), 16)
        self.assertTrue(all("rover.fidelity=quasi_static" in line for line in runs))
        # The difference that is shown is that of true success.
        self.assertEqual(out.count("66.7 (7.7..92.3)"), 4 * (2 * count + 1))
        self.assertNotIn("(-42.0..42.0)", out)

    def test_dense_drives_both_readings_at_both_fidelities(self):
        out = self.gestalt("--tables", "dense", "--seed", 9)
        runs = self.commands("run")
        found = [("localization.estimator=oracle" in line, "multibody" in line, "veto_felt=false" in line) for line in runs]
        self.assertEqual(found, [(oracle, multibody, printed) for oracle in (False, True)
                                 for multibody in (False, True) for printed in (True, False)])
        self.assertTrue(all("--seed 9" in line for line in runs))
        # 40 moves of 3 trials, 6 rear looks, 4 reversals, 3 stops; 21 m by odometer for 12 m.
        self.assertIn("| jammed 1, no_path (gave_up) 1 | 13 | 2.0 | 10 | 1.0 | +75 |", out)

    def test_the_odometer_leaves_out_drives_that_got_stuck(self):
        out = self.gestalt("--tables", "odometer")
        self.assertTrue(all("distance_scale=1" in line for line in self.commands("run")))
        # 11.5 m for 10 m.
        self.assertEqual(out.count("| 2 | 1.1500 | 0.8696 |"), 5)

    def test_unknown_tables_run_nothing(self):
        self.gestalt("--tables", "other", code=2)
        self.assertEqual(self.calls, [])


class Table3(StudyTest):
    """With a benchmark of one step at two sizes of cells."""

    def answer(self, words):
        return 0, json.dumps({"benchmarks": [
            {"name": "BM_Step<FitPlanes<false>>/cells:1", "label": "20 cm 01ab", "cpu_time": 0.08125,
             "P3_ms": 140, "growth": 6.5, "P3_growth": 4.76, "Sparc_growth": 5.31, "RAD_growth": 3.01},
            {"name": "BM_Cycle/cells:0", "label": "50 cm 02cd", "cpu_time": 0.5}]})

    def write(self):
        page = self.root / "page.md"
        page.write_text("<!-- begin table_3 -->\n\n<!-- end table_3 -->\n", encoding="utf-8")
        done = self.script(pathfinder, "--tables", "table_3", "--pages", page, "--benchmark", self.root / "benchmark")
        return page.read_text(encoding="utf-8"), done.err

    def test_stands_beside_what_is_printed(self):
        (self.root / "benchmark").touch()
        text, _ = self.write()
        self.assertIn("| fit planes | 20 | 0.081 | 140 | 6.50 | 4.76 | 5.31 | 3.01 |", text)
        self.assertIn("| a whole cycle of the map, 16384 points | 50 | 0.500 | - | - |", text)

    def test_without_a_benchmark_the_page_stays(self):
        text, said = self.write()
        self.assertNotIn("|", text)
        self.assertIn("table_3: not run, left as it is", said)


class FidelityTable(unittest.TestCase):
    def cells(self, low, high):
        return pathfinder.mean_cells({"first": 7.61293, "second": 7.6267, "difference": 0.0137649, "low": low, "high": high})

    def test_a_difference_stands_with_its_interval(self):
        self.assertEqual(self.cells(-0.0247658, 0.0811931), ("7.613", "7.627", "0.01376 (-0.02477..0.08119)"))

    def test_a_difference_that_few_trials_decide_has_none(self):
        self.assertEqual(self.cells(None, None), ("7.613", "7.627", "0.01376 (no interval)"))


class CourseStudy(StudyTest):
    """Of four trials three truly arrive."""

    summary = SUMMARY | {"true_success": RATE | {"rate": 0.75, "ci95": [0.3, 0.95]}}
    rows = [{"outcome": outcome, "path_ratio": ratio, "turned_in_place_rad": turned} for outcome, ratio, turned in (
        ("goal_reached", 1.2, 0), ("goal_reached", 1.5, 6.2831853), ("goal_reached", 1.1, 0), ("false_goal", 9.0, 3.14159))]

    def courses(self, *words, expected=None):
        with mock.patch.object(course, "expectations", (lambda: expected) if expected else course.expectations):
            return self.script(course, "--out", self.root, *words).out

    def test_a_course_is_passed_where_all_three_keep_to_what_was_expected(self):
        head = ("course", "navigator", "least_arrivals_percent", "largest_path_ratio", "most_turned_deg")
        out = self.courses(expected=[dict(zip(head, row.split(","))) for row in (
            "wall_3,gestalt,75,1.5,361", "wall_3,behaviour,76,1.5,361",
            "wall_6,gestalt,75,1.49,361", "wall_6,behaviour,75,1.5,359")])
        passed = [line.split("|")[-2].strip() for line in out.splitlines() if line.startswith("| wall")]
        self.assertEqual(passed, ["yes", "**no**", "**no**", "**no**"])
        self.assertIn("1 of 4 passed", out)
        self.assertIn("| 75 (30..95) | 75 | 1.50 | 1.5 | 360 | 361 | false_goal 1 | yes |", out)

    def test_both_navigators_meet_the_same_course(self):
        self.courses("--courses", "ditch", "gravel")
        runs = self.commands("run")
        self.assertEqual(len(runs), 4)
        for name in ("ditch", "gravel"):
            self.assertEqual(sum(f"run {ROOT}/scenarios/courses/{name}.json " in line for line in runs), 1)
            composed = json.loads((self.root / f"{name}_behaviour.json").read_text(encoding="utf-8"))
            self.assertTrue(composed["extends"].endswith("abundance_behaviour_stereo.json"))
            self.assertEqual(composed["referee"]["no_path_distance_m"], 12)
        # The ditch stands in a scenario of its own, which the course extends.
        ditch = json.loads((self.root / "ditch_behaviour.json").read_text(encoding="utf-8"))
        self.assertEqual(ditch["terrain"]["ground"]["ditches"]["depth_m"], [0.3])
        self.assertEqual(ditch["course"]["goal_x_m"], 6)
        self.assertEqual(ditch["name"], "course_ditch_behaviour")

    def test_every_course_has_an_expectation_for_each_navigator(self):
        found = sorted((row["course"], row["navigator"]) for row in course.expectations())
        courses = [path.stem for path in (ROOT / "scenarios/courses").glob("*.json")]
        self.assertEqual(found, sorted((name, navigator_) for name in courses for navigator_ in ("gestalt", "behaviour")))


class Package(unittest.TestCase):
    """Where studies find the package."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()

    def built(self, name):
        folder = self.root / name / "python/rockyard"
        folder.mkdir(parents=True)
        (folder / "_core.cpython-3.so").touch()
        return str(folder.parent)

    def test_the_build_of_the_program_comes_first(self):
        mine, test = self.built("mine"), self.built("build/test")
        (self.root / "build/release/python/rockyard").mkdir(parents=True)  # without its compiled part
        with mock.patch.object(study.package, "ROOT", self.root):
            self.assertEqual(study.package.places(["--rockyard", f"{self.root}/mine/bin/rockyard"]), [mine, test])
            self.assertEqual(study.package.places(["--out", "x"]), [test])

    def test_where_there_is_none_it_says_how_to_make_it(self):
        shutil.copytree(ROOT / "scripts/studies/study", self.root / "scripts/studies/study")
        done = subprocess.run([sys.executable, "-c", "import study"], cwd=self.root / "scripts/studies", text=True,
                              env={**os.environ, "PYTHONPATH": ""}, capture_output=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("--target rockyard_python_module", done.stderr)


class Shared(StudyTest):
    """What all studies go by."""

    def test_a_comparison_is_rounded_as_it_is_printed(self):
        rows = [{"what": f"{kind} success", "difference": 0.10549, "low": -0.0004, "high": 0.2, "p": 0.00050812}
                for kind in ("declared", "true")]
        told = mock.Mock(json={"comparison": {"successes": rows, "columns": [{"trials": "all", "name": "scrapes", "n": 4}]}})
        with mock.patch.object(study.ry, "compare", lambda first, second: told):
            success, means = study.compare("a", "b")
        self.assertEqual(success["true"], (10.5, -0.0, 20.0, 0.000508))
        self.assertEqual(means["all", "scrapes"]["n"], 4)

    def test_runs_without_a_number_of_threads_name_none(self):
        with mock.patch.object(study, "called", self.called), mock.patch.object(study.ry, "Run", str):
            args = mock.Mock(spec=["rockyard", "trials", "seed"], rockyard="rockyard", trials=3, seed=2)
            study.run_scenario(args, "a.json", self.root / "run", ["x=1"])
        self.assertEqual(self.calls, [f"rockyard run a.json --quiet --trials 3 --seed 2 --out {self.root / 'run'} --set x=1"])

    def test_programs_are_named_once(self):
        runs = [run_of([{"outcome": "no_path", "x": 1}], provenance={"version": "1", "commit": commit}) for commit in "bab"]
        self.assertEqual(study.made_by(runs), "made by rockyard 1 a and 1 b")

    def test_an_interval_without_a_number_is_none(self):
        self.assertEqual(study.with_interval((1.0, math.nan, 2.0), 1), "-")
        self.assertEqual(study.with_interval((1.0, -math.inf, math.inf), 1), "-")
        self.assertEqual(study.with_interval((-0.0001, -0.2, 0.3), 1), "0.0 (-0.2..0.3)")


class Rates(unittest.TestCase):
    """The functions of rockyard.rates that studies take, against published or independently computed numbers."""

    def interval(self, values, expected, places=5):
        for value, wanted in zip(values, expected, strict=True):
            self.assertAlmostEqual(value, wanted, places=places)

    def test_exact_intervals(self):
        # Closed forms: 0 of n ends at 1 - 0.025^(1/n), n of n begins at 0.025^(1/n), 1 of n begins
        # at 1 - 0.975^(1/n). 50 of 100: the textbooks' 0.3983 to 0.6017.
        self.interval(rates.exact_interval(0, 580), (0.0, 1.0 - 0.025 ** (1 / 580)))
        self.interval(rates.exact_interval(5, 5), (0.025 ** 0.2, 1.0))
        self.interval(rates.exact_interval(1, 592), (1.0 - 0.975 ** (1 / 592), 0.0093753))
        self.interval(rates.exact_interval(50, 100), (0.3983, 0.6017), places=4)
        self.interval(rates.exact_interval(0.0, 7.5), (0.0, 1.0 - 0.025 ** (1 / 7.5)))

    def test_wilsons_interval_is_the_same_of_rare_events(self):
        # 1 of 29, Newcombe 1998: 0.0061 to 0.1718.
        self.interval(rates.wilson_interval(1, 29), (0.0061, 0.1718), places=4)
        self.assertEqual(rates.rate(1, 29).method, "clopper_pearson")

    def test_few_events_get_the_exact_interval(self):
        # One hazard missed of 592: 0.94 % (normal approximation: 0.50 %). None: not one-sided 3 / n.
        one = rates.share([1] + [0] * 147, [4] * 148)
        self.interval(one, (1 / 592, 4.2766e-05, 0.0093753), places=4)  # design effect 1.003
        self.interval(rates.share([0] * 145, [4] * 145), (0.0, 0.0, 0.0063400))
        self.interval(rates.share([5], [5]), (1.0, 0.025 ** 0.2, 1.0))
        self.assertTrue(math.isnan(rates.share([0], [0])[0]))

    def test_trials_that_all_say_the_same_are_as_sure_as_binomial_ones(self):
        self.interval(rates.share([1, 2, 3], [10, 20, 30]), (0.1, *rates.exact_interval(6, 60)))

    def test_events_of_one_trial_widen_the_interval(self):
        # 20 of 200 trials miss all of their 10: design effect 10 x 200 / 199, so 20 of 200.
        clustered = rates.share([10] * 20 + [0] * 180, [10] * 200)
        self.interval(clustered, (0.1, *rates.exact_interval(19.9, 199.0)))
        # Negative control: as binomial trials they would say three times as much.
        low, high = rates.exact_interval(200, 2000)
        self.assertGreater(clustered[2] - clustered[1], 3.0 * (high - low))

    def test_means(self):
        self.interval(rates.mean([-1.0, 1.0]), (0.0, -1.95996, 1.95996), places=4)
        self.assertEqual(rates.mean([0.0, 0.0, 1.0], least=0.0)[1], 0.0)  # a count
        # 1, 2, 3 have a standard deviation of 1; tables of Student's t: 2.91999.
        self.interval(rates.mean([1.0, 2.0, 3.0], 0.90, "student"), (2.0, 2.0 - 2.91999 / 3 ** 0.5, 2.0 + 2.91999 / 3 ** 0.5))
        self.assertTrue(math.isnan(rates.mean([1.0])[1]))

    def test_ratios_of_sums(self):
        self.assertEqual(rates.ratio_of_sums([1.0, 1.0], [20.0, 20.0]), (0.05, 0.05, 0.05))
        # Residuals 5/3, 4/3, -3: variance 61/9, over 3 trials and a mean of 3.
        ratio, _, high = rates.ratio_of_sums([3.0, 4.0, 5.0], [1.0, 2.0, 6.0], 0.90, "student")
        self.assertAlmostEqual(ratio, 4.0 / 3.0)
        self.assertAlmostEqual(high - ratio, 2.91999 * math.sqrt(61.0 / 27.0) / 3.0, places=4)

    def test_quantiles(self):
        self.assertAlmostEqual(rates.quantile([4.0, 0.0, 1.0, 3.0, 2.0], 0.3), 1.2)
        self.assertEqual(rates.quantile([5.0, math.nan, 1.0], 1.0), 5.0)
        self.assertTrue(math.isnan(rates.quantile([], 0.5)))
        # Ranks of 95 % intervals, of any table of the sign test: 1 of 6, 2 of 10, 6 of 20.
        for count, rank in ((6, 1), (10, 2), (20, 6)):
            self.assertEqual(rates.median_interval(range(count, 0, -1)), (rank, count + 1 - rank))
        self.assertTrue(math.isnan(rates.median_interval([1, 2, 3, 4, 5])[0]))

    def test_students_tail(self):
        # Tables of Student's t: 5 % one-sided.
        for freedom, t in ((1, 6.3138), (3, 2.353363), (18, 1.734064), (120, 1.6577)):
            self.assertAlmostEqual(rates.student_tail(t, freedom), 0.05, places=5)

    def test_paired_trials(self):
        self.assertAlmostEqual(rates.mcnemar(1, 9), 2 * 11 / 1024)
        self.assertEqual(rates.mcnemar(0, 0), 1.0)
        self.assertEqual(rates.mcnemar(3, 3), 1.0)
        self.interval(rates.holm([0.01, 0.04, 0.03]), (0.03, 0.06, 0.06))

    def test_tangos_interval(self):
        def interval(only_first, only_second, pairs, confidence=0.95):
            both = pairs - only_first - only_second
            return rates.paired_difference(both, only_first, only_second, 0, confidence, "tango")
        # Airway hyper-responsiveness before and after (Bentur 2009, in Fagerland, Lydersen and Laake
        # 2014): 7 of 21 only after, 1 only before.
        self.interval(interval(7, 1, 21), (-0.517, -0.026), 3)
        self.interval(interval(1, 7, 21), (0.026, 0.517), 3)
        end = (square := 1.959963984540054 ** 2) / (40.0 + square)
        self.interval(interval(0, 0, 40), (-end, end), 9)
        # Ends at 0 where McNemar's score is critical.
        self.assertAlmostEqual(interval(3, 13, 44, math.erf(10.0 / math.sqrt(16.0) / math.sqrt(2.0)))[0], 0.0, places=7)
        self.assertEqual(interval(0, 0, 0), (-1.0, 1.0))

    def test_what_makes_no_sense_is_refused(self):
        for call in (lambda: rates.exact_interval(3, 2), lambda: rates.quantile([1.0], 1.5), lambda: rates.student_tail(-1, 3),
                     lambda: rates.paired_difference(1, 1, 1, 1, method="wald"), lambda: rates.wilson_interval(1, 2, 1.0)):
            with self.assertRaises(study.ry.InputError):
                call()
