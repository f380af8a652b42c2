"""The command lines of studies: what they run, and what they make of what comes back."""

import json
import math
import shutil
import unittest

import context  # noqa: F401  (where studies are)
import study
from fake_scripts import ROOT, ScriptTest
from navigator import navigator
from pathfinder.pathfinder import mean_cells


class RegressionStudy(ScriptTest):
    """With a rockyard whose checks find a change where a setting was changed, and one resampling."""

    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "scenarios/sweeps", self.root / "scenarios/sweeps")
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
case "$*" in
  sweep*--set*) touch "$(dirname "$CALLS")/changed" ;;
  sweep*) rm -f "$(dirname "$CALLS")/changed" ;;
  check*)
    code=0; verdict=equivalent
    if [ -e "$(dirname "$CALLS")/changed" ]; then code=1; verdict=changed; fi
    echo '{"cells": [{"records": {"pairs": 750, "changed": 3}}], "metrics": [{"cell": "cell=nominal",
      "metric": "true_success", "unit": "1", "family": "primary", "difference": -0.25, "margin": 0.1,
      "verdict": "'$verdict'"}]}'
    exit $code ;;
esac
""", encoding="utf-8")
        self.fake("build/release/tests/report/regression_study").write_text("""#!/bin/sh
echo "study $*" >> "$CALLS"
cat << END
study,cell,metric,discordance,campaigns,alarms,alarms_low,alarms_high,found,found_low,found_high,\
primary_alarms,secondary_alarms,inconclusive
unchanged: other seeds,,,0,2000,13,0.0035,0.0111,0,0,0.002,9,4,93
success 0.10 lower,nominal,true_success,0.3,2000,1900,0.94,0.96,1880,0.93,0.95,1890,0,2
END
""".replace("\\\n", ""), encoding="utf-8")

    def test_page_says_what_was_found(self):
        page = self.root / "page.md"
        result = self.run_well("studies/regression/regression.py", "--markdown", page, "--reruns", "2",
                               "--repeats", "1", "--pool", "40")
        study = self.called("study")
        self.assertEqual(len(study), 1)
        self.assertTrue(study[0].startswith("750 2000 1 "), study)
        text = page.read_text(encoding="utf-8")
        self.assertIn("| unchanged | the same | 1 | 1, 0, 0 | 3 of 750 | 0 | 0 |  |", text)
        self.assertIn("| unchanged | others | 2 | 2, 0, 0 |", text)
        self.assertIn("| hazard threshold 5 to 6 cm | the same | 1 | 0, 1, 0 | 3 of 750 | 1 | 0 "
                      "| nominal: true_success -0.25 1 |", text)
        self.assertIn("| other seeds | 2000 | 0.7 (0.4 .. 1.1) | 9 | 4 | 93 |", text)
        self.assertIn("| nominal | true_success | 0.3 | 2000 | 94.0 (93.0 .. 95.0) |", text)
        sweeps = [line for line in self.called("rockyard") if line.startswith("sweep")]
        self.assertEqual(len(sweeps), 3 + 6 * 2)
        self.assertIn("--set perception.hazard.neighbour_threshold_m=0.06", "".join(sweeps))


RATE = {"rate": 0.5, "ci95": [0.25, 0.75]}
SUMMARY = {"declared_success": RATE, "true_success": RATE, "provenance": {"version": "0.1.0", "commit": "abc"}}


class FakeRuns(ScriptTest):
    """With a rockyard that leaves the same trials in every run folder."""

    def fake_runs(self, trials, first="", **summary):
        """`first`: what its script does before that."""
        self.fake("build/release/bin/rockyard").write_text(f"""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
{first}
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
cat > "$out/summary.json" << END
{json.dumps(SUMMARY | summary)}
END
cat > "$out/trials.csv" << END
{trials}END
""", encoding="utf-8")


class Studies(FakeRuns):
    """Three trials, and a fault."""

    def setUp(self):
        super().setUp()
        self.fake_runs("""\
trial,outcome,detail,true_distance_m,scrapes,hazards_met,hazards_missed,sim_time_s,energy_wh,\
scan_energy_wh,contact_hazards,tilt_hazards,articulation_hazards,current_hazards,\
no_progress_distance_m,no_progress_turn_deg
0,goal_reached,,8,1,4,1,600,10,5,1,0,0,0,3.5,900
1,simulator_fault,,,,,,,,,,,,,,
2,no_path,,6,3,4,1,1200,12,6,0,0,0,2,50.1,400
3,jammed,,4,2,2,0,1800,14,7,0,0,1,0,6.5,100
""")

    def lines(self, name):
        return (self.root / "results/runs" / name).read_text(encoding="utf-8").splitlines()

    def test_threshold_study_drives_every_threshold(self):
        result = self.run_well("studies/threshold/threshold.py", "--trials", "7", "--low", "4", "--high", "6",
                               "--set", "clock.stop_time_s=0.1")
        runs = self.called("rockyard")
        self.assertEqual(len(runs), 6)
        for index, line in enumerate(runs):
            self.assertIn(("nominal.json", "vl2.json")[index // 3], line)
            self.assertIn(f"neighbour_threshold_m=0.0{4 + index % 3}", line)
            self.assertIn("--trials 7 --seed 1", line)
            self.assertIn("--set rover.fidelity=quasi_static --set clock.stop_time_s=0.1", line)
        table = self.lines("threshold/threshold.md")
        self.assertEqual(len([line for line in table if line.startswith("| ")]), 8)
        # Mean of 8, 6 and 4 m with 1.96 standard errors; two of ten hazards; faults left out.
        self.assertIn("6.00 (3.74..8.26)", table[2])
        self.assertIn("20.00 (", table[2])
        self.assertEqual(len(self.lines("threshold/threshold.csv")), 7)
        self.assertIn("made by rockyard 0.1.0 abc.", table[-1])
        svg = "\n".join(self.lines("threshold/threshold.svg"))
        self.assertEqual(svg.count("<polyline"), 10)

    def test_suite_study_drives_every_subset_once(self):
        result = self.run_well("studies/sensor_suite/sensor_suite.py", "scenarios/mars/mfex_nominal.json")
        runs = self.called("rockyard")
        self.assertEqual(len({line.split("--set", 1)[1] for line in runs}), 32)
        for sensor in ("perception.hazard.enabled", "sensors.vehicle.contact.enabled",
                       "sensors.vehicle.accelerometers.enabled",
                       "sensors.vehicle.articulation.enabled",
                       "sensors.vehicle.motor_current.enabled"):
            self.assertEqual(sum(f"{sensor}=true" in line for line in runs), 16)
            self.assertEqual(sum(f"{sensor}=false" in line for line in runs), 16)
        table = self.lines("sensor_suite/sensor_suite.md")
        self.assertTrue(table[2].startswith("| mfex_nominal | none |"), table[2])
        self.assertTrue(table[2].endswith("| 33 | 33 |"), table[2])  # jammed, no path

    def test_runs_that_are_there_are_resumed(self):
        for times in (1, 2):
            self.run_script("studies/threshold/threshold.py", "--low", "5", "--high", "5")
            resumed = [line for line in self.called("rockyard") if "--resume" in line]
            self.assertEqual(len(resumed), 2 * (times - 1))

    def test_what_makes_no_sense_runs_nothing(self):
        for arguments in (["--low", "0"], ["--low", "9", "--high", "5"]):
            self.assertEqual(self.run_script("studies/threshold/threshold.py", *arguments).returncode, 2)
        self.assertEqual(self.called("rockyard"), [])

    def test_a_failed_run_says_why(self):
        self.fake("build/release/bin/rockyard")
        result = self.run_script("studies/threshold/threshold.py", RUN_CODE="2")
        self.assertEqual(result.returncode, 1)
        self.assertIn("exit code 2", result.stderr)

    def test_pairs_of_trials_are_tested(self):
        # Every subset leaves the same trials: no pair differs. With the light stripe the second
        # succeeds too, so one pair is gained: p = 1.
        self.run_script("studies/sensor_suite/sensor_suite.py", "scenarios/mars/mfex_nominal.json")
        rows = self.lines("sensor_suite/sensor_suite_pairs.csv")
        self.assertEqual(len(rows), 1 + 2 * 31)
        self.assertIn("mfex_nominal,light stripe,none,declared,0,0,1.0,1.0", rows)
        rockyard = self.root / "build/release/bin/rockyard"
        rockyard.write_text(rockyard.read_text(encoding="utf-8").replace(
            "\n2,no_path", "\n2,$(case $out in */contact) echo false_goal;; *) echo no_path;; esac)"),
            encoding="utf-8")
        self.run_script("studies/sensor_suite/sensor_suite.py", "scenarios/mars/mfex_nominal.json")
        rows = self.lines("sensor_suite/sensor_suite_pairs.csv")
        self.assertIn("mfex_nominal,contact,none,declared,1,0,1.0,1.0", rows)
        self.assertIn("mfex_nominal,contact,none,true,0,0,1.0,1.0", rows)
        self.assertIn("0.1.0 abc", self.lines("sensor_suite/sensor_suite.csv")[1])
        self.assertIn("62 tests by pairs (McNemar, Holm), 0 differ",
                      "\n".join(self.lines("sensor_suite/sensor_suite.md")))


class NavigatorStudy(FakeRuns):
    """A rockyard whose GESTALT gains two of three pairs, whatever the rocks."""

    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "scenarios/gestalt", self.root / "scenarios/gestalt")
        self.fake_runs("trial,outcome,detail\n0,goal_reached,\n1,no_path,\n2,no_path,\n", first="""
if [ "$1" = compare ]; then
  echo "  declared success  A 1 of 3 (33.3 %)  B 3 of 3 (100.0 %)"
  echo "                    B - A +66.7 points (95 % interval +7.7 .. +92.3)"
  echo "                    both 1, only A 0, only B 2, neither 0; McNemar, exact: p = 0.5"
  echo "  true success      A 1 of 3 (33.3 %)  B 1 of 3 (33.3 %)"
  echo "                    B - A +0.0 points (95 % interval -42.0 .. +42.0)"
  echo "                    both 1, only A 0, only B 0, neither 2; McNemar, exact: p = 1"
  { echo trials,column,unit,n,mean_a,mean_b,difference,ci95_low,ci95_high
    for column in true_distance_m active_time_s active_energy_wh; do
      echo "all,$column,m,30,6,9,3,2.5,3.5"
      echo "arrived,$column,m,0,,,,,"
    done; } > "$5"
  exit 0
fi""")

    def lines(self, name):
        path = self.root / "results/runs/navigators" / name
        return path.read_text(encoding="utf-8").splitlines()

    def test_both_navigators_meet_the_same_trials(self):
        result = self.run_well("studies/navigator/navigator.py", "--trials", "3")
        calls = self.called("rockyard")
        runs = [line for line in calls if line.startswith("run")]
        # Two rovers: five abundances with two arms, and at two of them three more.
        self.assertEqual(len(runs), 2 * (5 * 2 + 2 * 3))
        for rover in ("abundance", "abundance_rocky_3_2"):
            for ending, count in (("", 7), ("_behaviour", 5), ("_behaviour_stereo", 2),
                                  ("_behaviour_stereo_stripe", 2)):
                self.assertEqual(sum(f"gestalt/{rover}{ending}.json" in line for line in runs), count)
        cropped = [line for line in runs if "field_of_view=stripe" in line]
        self.assertEqual(len(cropped), 4)
        self.assertNotIn("_behaviour", "".join(line.split("--out")[0] for line in cropped))
        # No arm takes another sensor by a setting: thresholds belong to the sensor.
        self.assertFalse(any("terrain_sensor=" in line or "navigator=" in line for line in runs))
        self.assertEqual(sum("k_per_m2=0.013" in line for line in runs), 10)
        for line in runs:
            self.assertIn("--trials 3 --seed 1", line)
        pairs = 2 * (5 + 2 * 5)
        self.assertEqual(sum(line.startswith("compare") for line in calls), pairs)
        rows = self.lines("navigators_pairs.csv")
        self.assertEqual(len(rows), 1 + pairs)
        self.assertIn("GESTALT", rows[1])
        self.assertIn(",66.7,7.7,92.3,0.5,", rows[1])
        self.assertTrue(rows[1].endswith(",1.0,1.0"), rows[1])  # Holm: 30 tests of p 0.5, 30 of p 1
        table = "\n".join(self.lines("navigators.md"))
        self.assertIn("| +0 (-42..+42) | 1 | 30 | 3.00 (2.50..3.50) |", table)
        self.assertIn("| +0 (-42..+42) | 1 | 0 | - | - | - |", table)
        self.assertIn("no_path 2", table)
        self.assertEqual("\n".join(self.lines("navigators.svg")).count("<polyline"), 8)

    def test_one_rover_alone(self):
        self.run_script("studies/navigator/navigator.py", "--rovers", "rocky_3_2", "--set", "seed=4")
        runs = [line for line in self.called("rockyard") if line.startswith("run")]
        self.assertEqual(len(runs), 16)
        self.assertIn("held: seed=4", "\n".join(self.lines("navigators.md")))

    def test_scenarios_of_every_arm_are_there(self):
        for stem in navigator.ROVERS.values():
            for ending, _ in navigator.ARMS.values():
                self.assertTrue((ROOT / f"scenarios/gestalt/{stem}{ending}.json").is_file())


class GestaltStudy(FakeRuns):
    """A rockyard that gains two of three pairs, whatever is compared."""

    # A setting that undoes each choice, in the order of the script.
    UNDONE = ("max_turn_share=2", "max_bogie_deg=30", "backward_arcs=below_threshold",
              "point_turns=below_min_vote", "step_reference=level", "veto_felt=false",
              "distance_scale=0.9465")

    def setUp(self):
        super().setUp()
        self.fake_runs("""\
trial,outcome,detail,true_distance_m,dead_reckoned_distance_m,moves,rear_image_sets,reversals,safeguard_stops
0,goal_reached,,8,9,10,2,1,0
1,no_path,,2,2.5,10,4,3,1
2,jammed,,2,9.5,20,0,0,2
""", first="""if [ "$1" = compare ]; then
  echo "                    B - A +0.0 points (95 % interval -42.0 .. +42.0)"
  echo "                    both 1, only A 0, only B 0, neither 2; McNemar, exact: p = 1"
  echo "                    B - A +66.7 points (95 % interval +7.7 .. +92.3)"
  echo "                    both 1, only A 0, only B 2, neither 0; McNemar, exact: p = 0.5"
  echo trials,column > "$5"
  exit 0
fi""", outcomes={"jammed": 1})

    def runs(self):
        return [line for line in self.called("rockyard") if line.startswith("run ")]

    def test_every_choice_stands_alone_and_is_left_out(self):
        result = self.run_well("studies/gestalt/gestalt.py", "--tables", "changes", "--trials", "3")
        count = len(self.UNDONE)
        alone = [tuple(other != choice for other in range(count)) for choice in range(count)]
        without = [tuple(other == choice for other in range(count)) for choice in range(count)]
        both = [undone for pair in zip(alone, without) for undone in pair]
        found = [tuple(setting in line for setting in self.UNDONE) for line in self.runs()]
        self.assertEqual(found, 4 * [(True,) * count, (False,) * count, *both])
        self.assertEqual(sum("localization.estimator=oracle" in line for line in self.runs()), 16)
        self.assertTrue(all("rover.fidelity=quasi_static" in line for line in self.runs()))
        # Of the two differences that are printed the second is that of true success.
        self.assertEqual(result.stdout.count("66.7 (7.7..92.3)"), 4 * (2 * count + 1))
        self.assertNotIn("(-42.0..42.0)", result.stdout)

    def test_dense_drives_both_readings_at_both_fidelities(self):
        result = self.run_well("studies/gestalt/gestalt.py", "--tables", "dense", "--seed", "9")
        found = [("localization.estimator=oracle" in line, "multibody" in line, "veto_felt=false" in line)
                 for line in self.runs()]
        self.assertEqual(found, [(oracle, multibody, printed) for oracle in (False, True)
                                 for multibody in (False, True) for printed in (True, False)])
        self.assertTrue(all("--seed 9" in line for line in self.runs()))
        # 40 moves of 3 trials, 6 rear looks, 4 reversals, 3 stops; 21 m by odometer for 12 m.
        self.assertIn("| jammed 1 | 13 | 2.0 | 10 | 1.0 | +75 |", result.stdout)

    def test_the_odometer_leaves_out_drives_that_got_stuck(self):
        result = self.run_well("studies/gestalt/gestalt.py", "--tables", "odometer")
        self.assertTrue(all("distance_scale=1" in line for line in self.runs()))
        # 11.5 m for 10 m.
        self.assertEqual(result.stdout.count("| 2 | 1.1500 | 0.8696 |"), 5)

    def test_unknown_tables_run_nothing(self):
        self.assertEqual(self.run_script("studies/gestalt/gestalt.py", "--tables", "other").returncode, 2)
        self.assertEqual(self.called("rockyard"), [])


class Table3(ScriptTest):
    """With a benchmark of one step at two sizes of cells."""

    BENCHMARK = """#!/bin/sh
cat << END
{"benchmarks": [
  {"name": "BM_Step<FitPlanes<false>>/cells:1", "label": "20 cm 01ab", "cpu_time": 0.08125,
   "P3_ms": 140, "growth": 6.5, "P3_growth": 4.76, "Sparc_growth": 5.31, "RAD_growth": 3.01},
  {"name": "BM_Cycle/cells:0", "label": "50 cm 02cd", "cpu_time": 0.5}]}
END
"""

    def write(self):
        page = self.root / "page.md"
        page.write_text("<!-- begin table_3 -->\n\n<!-- end table_3 -->\n", encoding="utf-8")
        result = self.run_well("studies/pathfinder/pathfinder.py", "--tables", "table_3", "--pages", str(page))
        return page.read_text(encoding="utf-8"), result.stderr

    def test_stands_beside_what_is_printed(self):
        self.fake("build/release/tests/navigation/gestalt_benchmark").write_text(self.BENCHMARK, encoding="utf-8")
        text, _ = self.write()
        self.assertIn("| fit planes | 20 | 0.081 | 140 | 6.50 | 4.76 | 5.31 | 3.01 |", text)
        self.assertIn("| a whole cycle of the map, 16384 points | 50 | 0.500 | - | - |", text)

    def test_without_a_benchmark_the_page_stays(self):
        text, said = self.write()
        self.assertNotIn("|", text)
        self.assertIn("table_3: not run, left as it is", said)


class FidelityTable(unittest.TestCase):
    def cells(self, low, high):
        return mean_cells({"mean_a": "7.61293", "mean_b": "7.6267", "difference": "0.0137649",
                           "ci95_low": low, "ci95_high": high})

    def test_a_difference_stands_with_its_interval(self):
        self.assertEqual(self.cells("-0.0247658", "0.0811931"), ("7.613", "7.627", "0.01376 (-0.02477..0.08119)"))

    def test_a_difference_that_few_trials_decide_has_none(self):
        self.assertEqual(self.cells("", ""), ("7.613", "7.627", "0.01376 (no interval)"))


class CourseStudy(FakeRuns):
    """A rockyard of whose four trials three truly arrive."""

    def setUp(self):
        super().setUp()
        for folder in ("courses", "gestalt"):
            shutil.copytree(ROOT / "scenarios" / folder, self.root / "scenarios" / folder)
        self.fake_runs("""\
trial,outcome,detail,path_ratio,turned_in_place_rad
0,goal_reached,,1.2,0
1,goal_reached,,1.5,6.2831853
2,goal_reached,,1.1,0
3,false_goal,,9.0,3.14159
""", true_success={"rate": 0.75, "ci95": [0.3, 0.95]})
        self.expected = self.root / "scenarios/courses/expected.csv"

    def expect(self, *rows):
        head = "course,navigator,least_arrivals_percent,largest_path_ratio,most_turned_deg"
        self.expected.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    def test_a_course_is_passed_where_all_three_keep_to_what_was_expected(self):
        self.expect("wall_3,gestalt,75,1.5,361", "wall_3,behaviour,76,1.5,361",
                    "wall_6,gestalt,75,1.49,361", "wall_6,behaviour,75,1.5,359")
        result = self.run_well("studies/course/course.py")
        passed = [line.split("|")[-2].strip() for line in result.stdout.splitlines() if line.startswith("| wall")]
        self.assertEqual(passed, ["yes", "**no**", "**no**", "**no**"])
        self.assertIn("1 of 4 passed", result.stdout)
        self.assertIn("| 75 (30..95) | 75 | 1.50 | 1.5 | 360 | 361 | false_goal 1 | yes |", result.stdout)

    def test_both_navigators_meet_the_same_course(self):
        result = self.run_well("studies/course/course.py", "--courses", "ditch", "gravel")
        runs = [line for line in self.called("rockyard") if line.startswith("run ")]
        self.assertEqual(len(runs), 4)
        for course in ("ditch", "gravel"):
            own = self.root / f"scenarios/courses/{course}.json"
            self.assertEqual(sum(f"run {own} " in line for line in runs), 1)
            composed = json.loads((self.root / f"results/runs/courses/{course}_behaviour.json")
                                  .read_text(encoding="utf-8"))
            self.assertTrue(composed["extends"].endswith("abundance_behaviour_stereo.json"))
            self.assertEqual(composed["referee"]["no_path_distance_m"], 12)
        # The ditch stands in a scenario of its own, which the course extends.
        ditch = json.loads((self.root / "results/runs/courses/ditch_behaviour.json") .read_text(encoding="utf-8"))
        self.assertEqual(ditch["terrain"]["ground"]["ditches"]["depth_m"], [0.3])
        self.assertEqual(ditch["course"]["goal_x_m"], 6)
        self.assertEqual(ditch["name"], "course_ditch_behaviour")

    def test_every_course_has_an_expectation_for_each_navigator(self):
        rows = self.expected.read_text(encoding="utf-8").splitlines()[1:]
        found = sorted(tuple(row.split(",")[:2]) for row in rows)
        courses = [path.stem for path in (ROOT / "scenarios/courses").glob("*.json")]
        self.assertEqual(found, sorted((course, navigator) for course in courses
                                       for navigator in ("gestalt", "behaviour")))


class StudyStatistics(unittest.TestCase):
    """The numbers of scripts/studies/study against published or independently computed ones."""

    study = study

    def interval(self, values, expected, places=5):
        for value, wanted in zip(values, expected):
            self.assertAlmostEqual(value, wanted, places=places)

    def test_exact_intervals(self):
        # Closed forms: 0 of n ends at 1 - 0.025^(1/n), n of n begins at 0.025^(1/n), 1 of n begins
        # at 1 - 0.975^(1/n). 50 of 100: the textbooks' 0.3983 to 0.6017.
        exact = self.study.exact_interval
        self.interval(exact(0, 580), (0.0, 1.0 - 0.025 ** (1 / 580)))
        self.interval(exact(5, 5), (0.025 ** 0.2, 1.0))
        self.interval(exact(1, 592), (1.0 - 0.975 ** (1 / 592), 0.0093753))
        self.interval(exact(50, 100), (0.3983, 0.6017), places=4)

    def test_few_events_get_the_exact_interval(self):
        # One hazard missed of 592: 0.94 % (normal approximation: 0.50 %). None: not one-sided 3 / n.
        one = self.study.ratio_interval([1] + [0] * 147, [4] * 148)
        self.interval(one, (1 / 592, 4.2766e-05, 0.0093753), places=4)  # design effect 1.003
        none = self.study.ratio_interval([0] * 145, [4] * 145)
        self.interval(none, (0.0, 0.0, 0.0063400))
        every = self.study.ratio_interval([5], [5])
        self.interval(every, (1.0, 0.025 ** 0.2, 1.0))
        self.assertTrue(math.isnan(self.study.ratio_interval([0], [0])[0]))

    def test_trials_that_all_say_the_same_are_as_sure_as_binomial_ones(self):
        self.interval(self.study.ratio_interval([1, 2, 3], [10, 20, 30]), (0.1, *self.study.exact_interval(6, 60)))

    def test_events_of_one_trial_widen_the_interval(self):
        # 20 of 200 trials miss all of their 10: design effect 10 x 200 / 199, so 20 of 200.
        clustered = self.study.ratio_interval([10] * 20 + [0] * 180, [10] * 200)
        self.interval(clustered, (0.1, *self.study.exact_interval(19.9, 199.0)))
        # Negative control: as binomial trials they would say three times as much.
        low, high = self.study.exact_interval(200, 2000)
        self.assertGreater(clustered[2] - clustered[1], 3.0 * (high - low))

    def test_means(self):
        value, low, high = self.study.mean_interval([-1.0, 1.0])
        self.interval((value, low, high), (0.0, -1.95996, 1.95996), places=4)
        self.assertEqual(self.study.mean_interval([0.0, 0.0, 1.0])[1], 0.0)  # a count

    def test_paired_trials(self):
        self.assertAlmostEqual(self.study.mcnemar(1, 9), 2 * 11 / 1024)
        self.assertEqual(self.study.mcnemar(0, 0), 1.0)
        self.assertEqual(self.study.mcnemar(3, 3), 1.0)
        self.interval(self.study.holm([0.01, 0.04, 0.03]), (0.03, 0.06, 0.06))
