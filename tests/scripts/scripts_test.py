"""The command lines of the scripts: what they accept, refuse and pass on."""

import contextlib
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent

# Stands for every program that the scripts call: writes down how it was called.
FAKE = """#!/bin/sh
echo "$(basename "$0") $*" >> "$CALLS"
case "$(basename "$0") $1" in
  "rockyard check") exit "${CHECK_CODE:-0}" ;;
  "rockyard report") exit "${REPORT_CODE:-0}" ;;
  "rockyard run") exit "${RUN_CODE:-0}" ;;
esac
"""


class ScriptTest(unittest.TestCase):
    """A copy of the scripts in a folder where nothing real can be called."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.calls = self.root / "calls"
        self.calls.touch()
        shutil.copytree(ROOT / "scripts", self.root / "scripts")
        for name in ("cmake", "ctest"):
            self.fake(f"bin/{name}")
        self.fake("build/release/bin/rockyard")
        self.fake("scripts/install_dependencies.sh")

    def fake(self, name):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(FAKE, encoding="utf-8")
        path.chmod(0o755)
        return path

    def run_script(self, name, *arguments, **environment):
        variables = {**os.environ, "CALLS": str(self.calls), **environment,
                     "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"}
        return subprocess.run([self.root / "scripts" / name, *arguments], env=variables, text=True,
                              capture_output=True, check=False)

    def called(self, program):
        lines = self.calls.read_text(encoding="utf-8").splitlines()
        return [line.removeprefix(f"{program} ") for line in lines if line.startswith(program)]


class Quickstart(ScriptTest):
    def test_runs_every_scenario_of_the_comparison_with_300_trials(self):
        result = self.run_script("quickstart.sh")
        self.assertEqual(result.returncode, 0, result.stderr)
        out = "results/runs/quickstart"
        names = ["obstacles_0.28", "obstacles_0.57", "obstacles_0.85", "nominal",
                 "nominal_perfect_localization", "level_sand"]
        runs = [f"run scenarios/pathfinder/{name}.json --resume --force --out {out}/{name}"
                " --trials 300" for name in names]
        folders = " ".join(f"{out}/{name}" for name in names)
        look = f"{out}/first_look"
        self.assertEqual(self.called("rockyard"), [
            "run scenarios/pathfinder/nominal.json --resume --force"
            f" --out {look} --set rover.fidelity=quasi_static --trials 40",
            f"report {look} --out {look}.html",
            *runs,
            f"check {folders} --against results/reference/matthies1995.json",
            f"report {out}/nominal {out}/nominal_perfect_localization"
            f" --against results/reference/matthies1995.json --out {out}/report.html"])
        self.assertIn(f"{out}/report.html (open it", result.stdout)

    def test_a_page_that_fails_ends_it(self):
        self.assertEqual(self.run_script("quickstart.sh", REPORT_CODE="5").returncode, 5)

    def test_the_first_look_can_be_all(self):
        result = self.run_script("quickstart.sh", "--first")
        self.assertEqual(result.returncode, 0)
        self.assertEqual([line.split()[0] for line in self.called("rockyard")], ["run", "report"])
        self.assertIn("results/runs/quickstart/first_look.html", result.stdout)

    def test_options_pass_through(self):
        self.run_script("quickstart.sh", "--trials", "50", "--seed", "2")
        runs = [line for line in self.called("rockyard") if line.startswith("run")]
        for line in runs:
            self.assertTrue(line.endswith("--trials 50 --seed 2"), line)
            self.assertEqual(line.count("--trials"), 1, line)

    def test_an_option_with_a_space_stays_one_word(self):
        script = self.root / "build/release/bin/rockyard"
        script.write_text('#!/bin/sh\nfor word in "$@"; do echo "[$word]" >> "$CALLS"; done\n',
                          encoding="utf-8")
        self.run_script("quickstart.sh", "--set", "name=two words")
        self.assertIn("[name=two words]", self.calls.read_text(encoding="utf-8"))

    def test_options_that_change_results_get_a_folder_of_their_own(self):
        self.run_script("quickstart.sh", "--threads", "1")
        self.run_script("quickstart.sh", "--seed", "2")
        self.run_script("quickstart.sh", "--seed", "3")
        folders = {line.split("--out ")[1].split()[0].rpartition("/")[0]
                   for line in self.called("rockyard") if "run scenarios/pathfinder/nominal" in line}
        self.assertEqual(len(folders), 3)
        self.assertIn("results/runs/quickstart", folders)

    def test_output_folder_can_be_chosen(self):
        self.run_script("quickstart.sh", "--out", "elsewhere")
        self.assertTrue(any("--out elsewhere/nominal" in line for line in self.called("rockyard")))

    def test_a_verdict_is_no_failure(self):
        for code, expected in ((0, 0), (1, 0), (4, 0), (2, 2)):
            with self.subTest(code=code):
                result = self.run_script("quickstart.sh", CHECK_CODE=str(code))
                self.assertEqual(result.returncode, expected)

    def test_a_failed_run_stops_with_its_code(self):
        self.assertEqual(self.run_script("quickstart.sh", RUN_CODE="3").returncode, 3)
        self.assertEqual(len(self.called("rockyard")), 1)

    def test_help_runs_nothing(self):
        result = self.run_script("quickstart.sh", "--help")
        self.assertIn("Usage", result.stdout)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")


class SameBits(ScriptTest):
    """With programs that say which hash they find."""

    MINE = "build/same_bits/tests/determinism/hash_trials"
    OTHER = "build/test/tests/determinism/hash_trials"

    def program(self, name, hash_of="echo 0123456789abcdef"):
        """`hash_of`: shell words that see $1 scenario, $2 trials, $3 threads, $4 setting."""
        self.fake(name).write_text(
            f'#!/bin/sh\necho "hash_trials $*" >> "$CALLS"\n{hash_of}\n', encoding="utf-8")

    def test_equal_hashes_of_both_builds_threads_and_fidelities(self):
        self.program(self.MINE)
        self.program(self.OTHER)
        result = self.run_script("same_bits.sh", "--trials", "3", "--jobs", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.count("0123456789abcdef  same"), 8)
        runs = self.called("hash_trials")
        expected = [f"scenarios/pathfinder/nominal.json 3 {threads} rover.fidelity={fidelity}"
                    for fidelity in ("multibody", "quasi_static") for threads in (1, 2, 1, 2)]
        self.assertEqual(runs, expected)
        flags = [line for line in self.called("cmake") if line.startswith("-S")]
        self.assertEqual(len(flags), 1)
        self.assertIn('-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG -w', flags[0])

    def test_another_level_or_number_of_threads_that_differs_fails(self):
        for hash_of in ('[ "$4" = rover.fidelity=quasi_static ] && echo 1 || echo 2',
                        'echo "$3"', 'echo $$'):
            with self.subTest(hash_of=hash_of):
                self.program(self.MINE)
                self.program(self.OTHER, hash_of)
                result = self.run_script("same_bits.sh")
                self.assertEqual(result.returncode, 1)
                self.assertIn("DIFFERS", result.stdout)

    def test_fidelities_need_not_agree(self):
        for name in (self.MINE, self.OTHER):
            self.program(name, '[ "$4" = rover.fidelity=quasi_static ] && echo 1 || echo 2')
        self.assertEqual(self.run_script("same_bits.sh").returncode, 0)

    def test_the_other_program_can_be_named_and_must_be_there(self):
        self.program(self.MINE)
        self.assertEqual(self.run_script("same_bits.sh").returncode, 2)
        self.program("elsewhere/hash_trials")
        result = self.run_script("same_bits.sh", "--against", "elsewhere/hash_trials")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_failed_run_ends_with_its_code(self):
        self.program(self.MINE, "exit 3")
        self.program(self.OTHER, "exit 3")
        self.assertEqual(self.run_script("same_bits.sh").returncode, 3)

    def test_a_run_without_a_hash_is_no_agreement(self):
        for name in (self.MINE, self.OTHER):
            self.program(name, "true")
        self.assertEqual(self.run_script("same_bits.sh").returncode, 1)

    def test_unknown_option_runs_nothing(self):
        self.assertEqual(self.run_script("same_bits.sh", "--fast").returncode, 2)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")


class TestScript(ScriptTest):
    def setUp(self):
        super().setUp()
        for folder in ("navigation", "trial"):
            (self.root / "tests" / folder).mkdir(parents=True)

    def last_test(self):
        return (self.root / "build/last_test").read_text(encoding="utf-8").splitlines()

    def test_everything_by_default(self):
        self.assertEqual(self.run_script("test.sh", "--jobs", "2").returncode, 0)
        self.assertEqual(self.called("install_dependencies.sh"), ["build mpi pages test figures"])
        self.assertEqual(self.called("ctest"),
                         ["--preset test -j 2 --no-tests=error --output-on-failure"])

    def test_label_and_lint(self):
        self.run_script("test.sh", "--label", "statistical", "--no-lint")
        self.assertIn("-L ^statistical$ -LE ^lint$", self.called("ctest")[0])

    def test_fast_tests_of_folders_build_only_these(self):
        self.run_script("test.sh", "--fast", "navigation", "trial/", "--jobs", "2")
        builds = [line for line in self.called("cmake") if line.startswith("--build")]
        self.assertEqual([line.split("--target ")[1] for line in builds],
                         ["tests/navigation/all tests/trial/all"])
        self.assertEqual(len(self.called("ctest")), 1)
        self.assertIn("-L ^(tests/navigation|tests/trial)$ -L ^fast$", self.called("ctest")[0])

    def test_last_test_says_what_ran_and_how_it_ended(self):
        self.run_script("test.sh")
        self.assertTrue(self.last_test()[0].startswith("passed: commit "), self.last_test())
        self.assertEqual(self.last_test()[1], "ran: preset test, tier full")
        self.fake("bin/ctest").write_text("#!/bin/sh\nexit 8\n", encoding="utf-8")
        result = self.run_script("test.sh", "--fast", "--label", "unit", "navigation")
        self.assertEqual(result.returncode, 8)
        self.assertTrue(self.last_test()[0].startswith("FAILED: commit "), self.last_test())
        self.assertEqual(self.last_test()[1],
                         "ran: preset test, tier fast, label ^unit$, folders navigation")

    def test_tsan_needs_its_own_packages(self):
        self.run_script("test.sh", "--preset", "tsan")
        self.assertEqual(self.called("install_dependencies.sh"), ["build mpi pages test figures tsan"])

    def test_unknown_words_run_nothing(self):
        for arguments in (["--quick"], ["--label"], ["nowhere"]):
            result = self.run_script("test.sh", *arguments)
            self.assertEqual(result.returncode, 2)
            self.assertEqual(self.calls.read_text(encoding="utf-8"), "")
            self.assertFalse((self.root / "build/last_test").exists())

    def test_continuous_integration_runs_the_same(self):
        shutil.copytree(ROOT / ".ci", self.root / ".ci")
        variables = {**os.environ, "CALLS": str(self.calls),
                     "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"}
        subprocess.run([self.root / ".ci/run"], env=variables, check=True, capture_output=True)
        self.assertEqual(len(self.called("ctest")), 1)


class LongTests(ScriptTest):
    """With two long tests, the second of which fails."""

    def setUp(self):
        super().setUp()
        self.folder = self.root / "tests" / "long"
        self.folder.mkdir(parents=True)
        (self.folder / "tests.json").write_text(
            """[{"name": "good", "what": "passes", "command": "echo good >> $CALLS"},
                {"name": "bad", "what": "fails", "command": "echo bad >> $CALLS; exit 3"}]""",
            encoding="utf-8")

    def results(self):
        lines = (self.folder / "README.md").read_text(encoding="utf-8").splitlines()
        return {line.split(" | ")[0].strip("| "): line.split(" | ")[-1] for line in lines[6:]}

    def test_each_is_noted_with_its_last_result(self):
        self.assertEqual(self.run_script("test.sh", "--long").returncode, 1)
        self.assertTrue(self.results()["good"].startswith("passed, 20"), self.results())
        self.assertTrue(self.results()["bad"].startswith("FAILED with exit code 3"))

    def test_one_by_name_leaves_the_results_of_others(self):
        self.run_script("long_tests.py", "bad")
        self.assertEqual(self.results()["good"], "not run yet |")
        self.assertEqual(self.run_script("long_tests.py", "good").returncode, 0)
        self.assertTrue(self.results()["bad"].startswith("FAILED"))
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "bad\ngood\n")

    def test_list_and_unknown_names_run_nothing(self):
        listed = self.run_script("long_tests.py", "--list")
        self.assertIn("good", listed.stdout)
        self.assertEqual(self.run_script("long_tests.py", "other").returncode, 2)
        self.assertEqual(self.calls.read_text(encoding="utf-8"), "")


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
        result = self.run_script("regression_study.py", "--markdown", page, "--reruns", "2",
                                 "--repeats", "1", "--pool", "40")
        self.assertEqual(result.returncode, 0, result.stderr)
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


class Studies(ScriptTest):
    """With a rockyard that leaves the same three trials in every run folder."""

    def setUp(self):
        super().setUp()
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
rate='{"rate": 0.5, "ci95": [0.25, 0.75]}'
made='"provenance": {"version": "0.1.0", "commit": "abc"}'
echo "{\\"declared_success\\": $rate, \\"true_success\\": $rate, $made}" > "$out/summary.json"
cat > "$out/trials.csv" << END
trial,outcome,detail,true_distance_m,scrapes,hazards_met,hazards_missed,sim_time_s,energy_wh,\
scan_energy_wh,contact_hazards,tilt_hazards,articulation_hazards,current_hazards,\
no_progress_distance_m,no_progress_turn_deg
0,goal_reached,,8,1,4,1,600,10,5,1,0,0,0,3.5,900
1,simulator_fault,,,,,,,,,,,,,,
2,no_path,,6,3,4,1,1200,12,6,0,0,0,2,50.1,400
3,jammed,,4,2,2,0,1800,14,7,0,0,1,0,6.5,100
END
""", encoding="utf-8")

    def lines(self, name):
        return (self.root / "results/runs" / name).read_text(encoding="utf-8").splitlines()

    def test_threshold_study_drives_every_threshold(self):
        result = self.run_script("threshold_study.py", "--trials", "7", "--low", "4", "--high", "6",
                                 "--set", "clock.stop_time_s=0.1")
        self.assertEqual(result.returncode, 0, result.stderr)
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
        result = self.run_script("sensor_suite_study.py", "scenarios/mars/mfex_nominal.json")
        self.assertEqual(result.returncode, 0, result.stderr)
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

    def test_patience_study_tells_every_patience_from_one_run(self):
        result = self.run_script("patience_study.py", "--trials", "7", "--set", "clock.stop_time_s=1",
                                 "scenarios/pathfinder/vl2.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        runs = self.called("rockyard")
        self.assertEqual(len(runs), 1)
        self.assertIn("scenarios/pathfinder/vl2.json --trials 7 --seed 1", runs[0])
        self.assertIn("--set rover.fidelity=quasi_static --set clock.stop_time_s=1 "
                      "--set referee.no_path_distance_m=50 --set referee.no_path_turn_deg=10800",
                      runs[0])
        # One of three arrived, after 3.5 m and 900 deg without progress; one had a simulator fault.
        table = [line.split(" | ")[1:] for line in self.lines("patience/patience.md")[2:13]]
        rates = {(row[0], row[1]): [cell.split()[0] for cell in row[2:]] for row in table}
        arrived, ended = ["33.3", "33.3", "33.3"], ["0.0", "0.0", "100.0"]
        self.assertEqual(rates, {
            ("4 m", "1080 deg"): ["33.3", "33.3", "66.7"], ("2 m", "none"): ["0.0", "0.0", "100.0"],
            ("3 m", "none"): ended, ("4 m", "none"): ["33.3", "33.3", "66.7"],
            ("6 m", "none"): ["33.3", "33.3", "66.7"], ("8 m", "none"): arrived,
            ("10 m", "none"): arrived, ("none", "none"): arrived,
            ("none", "720 deg"): ["0.0", "0.0", "66.7"], ("none", "1080 deg"): arrived,
            ("none", "2160 deg"): arrived})
        self.assertIn("33.3 (6.1..79.2)", "\n".join(self.lines("patience/patience.md")))
        for name in ("distance", "turn"):
            svg = "\n".join(self.lines(f"patience/patience_{name}.svg"))
            self.assertEqual(svg.count("<polyline"), 2)

    def test_runs_that_are_there_are_resumed(self):
        for times in (1, 2):
            self.run_script("threshold_study.py", "--low", "5", "--high", "5")
            resumed = [line for line in self.called("rockyard") if "--resume" in line]
            self.assertEqual(len(resumed), 2 * (times - 1))

    def test_what_makes_no_sense_runs_nothing(self):
        for arguments in (["--low", "0"], ["--low", "9", "--high", "5"]):
            self.assertEqual(self.run_script("threshold_study.py", *arguments).returncode, 2)
        self.assertEqual(self.called("rockyard"), [])

    def test_a_failed_run_says_why(self):
        self.fake("build/release/bin/rockyard")
        result = self.run_script("threshold_study.py", RUN_CODE="2")
        self.assertEqual(result.returncode, 1)
        self.assertIn("exit code 2", result.stderr)

    def test_pairs_of_trials_are_tested(self):
        # Every subset leaves the same trials: no pair differs. With the light stripe the second
        # succeeds too, so one pair is gained: p = 1.
        self.run_script("sensor_suite_study.py", "scenarios/mars/mfex_nominal.json")
        rows = self.lines("sensor_suite/sensor_suite_pairs.csv")
        self.assertEqual(len(rows), 1 + 2 * 31)
        self.assertIn("mfex_nominal,light stripe,none,declared,0,0,1.0,1.0", rows)
        rockyard = self.root / "build/release/bin/rockyard"
        rockyard.write_text(rockyard.read_text(encoding="utf-8").replace(
            "\n2,no_path", "\n2,$(case $out in */contact) echo false_goal;; *) echo no_path;; esac)"),
            encoding="utf-8")
        self.run_script("sensor_suite_study.py", "scenarios/mars/mfex_nominal.json")
        rows = self.lines("sensor_suite/sensor_suite_pairs.csv")
        self.assertIn("mfex_nominal,contact,none,declared,1,0,1.0,1.0", rows)
        self.assertIn("mfex_nominal,contact,none,true,0,0,1.0,1.0", rows)
        self.assertIn("0.1.0 abc", self.lines("sensor_suite/sensor_suite.csv")[1])
        self.assertIn("62 tests by pairs (McNemar, Holm), 0 differ",
                      "\n".join(self.lines("sensor_suite/sensor_suite.md")))


class OdometerSign(ScriptTest):
    """With a rockyard of three trials, one of which reads too little."""

    def setUp(self):
        super().setUp()
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
echo '{"provenance": {"version": "0.1.0", "commit": "abc"}}' > "$out/summary.json"
cat > "$out/trials.csv" << END
trial,outcome,detail,true_distance_m,dead_reckoned_distance_m,heading_error_deg,\
heading_growth_deg2_per_m,distance_error_percent
0,goal_reached,,8,10,3,1.4,4
1,simulator_fault,,,,,,
2,no_path,,4,5,-2,1.4,-1
3,false_goal,,6,7.5,2,1.4,9
END
""", encoding="utf-8")
        self.level_sand = "scenarios/pathfinder/level_sand.json"

    def lines(self, name):
        return (self.root / "results/runs" / name).read_text(encoding="utf-8").splitlines()

    def test_every_cell_meets_the_same_trials(self):
        result = self.run_script("odometer_sign_study.py", "--trials", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        runs = [line for line in self.called("rockyard") if self.level_sand not in line]
        self.assertEqual(len(runs), 27)
        self.assertEqual(len({line.split("--set", 1)[1] for line in runs}), 27)
        for line in runs:
            self.assertIn("scenarios/pathfinder/nominal.json --trials 3 --seed 1", line)
            self.assertIn("--set rover.fidelity=quasi_static", line)
            # 4 m for 5 rolled; the slope of 1.4 deg2/m at a gain of 2, over 0.7.
            self.assertIn("--set perception.dead_reckoning.distance_scale=0.8", line)
            self.assertIn("--set sensors.encoders.level_sand_gain=0.8", line)
            self.assertIn("--set sensors.gyro.level_sand_gain=4.0", line)
        for setting, count in (("wheels=forward", 9), ("wide_arc_radius_m=3.0", 9),
                               ("tight_arc_radius_m=0.5", 9), ("min_diameter_m=0.14", 9)):
            self.assertEqual(sum(setting in line for line in runs), count, setting)

    def test_the_table_says_how_many_read_too_little(self):
        self.run_script("odometer_sign_study.py", "--trials", "3")
        table = self.lines("odometer_sign/odometer_sign.md")
        self.assertEqual(len([line for line in table if line.startswith("| ")]), 29)
        cells = [cell.strip() for cell in table[2].strip("|").split("|")]
        self.assertEqual(cells[:3], ["all", "3, 1", "0.05"])
        self.assertEqual(cells[3], "33.3 (6.1..79.2)")
        self.assertEqual(cells[4], "4.0")
        self.assertTrue(cells[5].startswith("4.0 ("), cells[5])
        self.assertEqual(cells[6], "66.7 (20.8..93.9)")
        self.assertEqual(len(self.lines("odometer_sign/odometer_sign.csv")), 28)


class RevisionStudy(ScriptTest):
    """With a rockyard that gains two of three pairs, whatever is compared."""

    CHANGES = ("terrain.rocks.mirror_line=keep_off", "terrain.rocks.pointedness=0",
               "referee.time_limit_s=14400", "sensors.gyro.level_sand_gain=1")

    def setUp(self):
        super().setUp()
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
if [ "$1" = compare ]; then
  echo "                    B - A +66.7 points (95 % interval +7.7 .. +92.3)"
  echo "                    both 1, only A 0, only B 2, neither 0; McNemar, exact: p = 0.5"
  echo "                    B - A +0.0 points (95 % interval -42.0 .. +42.0)"
  echo "                    both 1, only A 0, only B 0, neither 2; McNemar, exact: p = 1"
  echo trials,column > "$5"
  exit 0
fi
case "$*" in *pointedness=0.0*) seen=0.0945 ;; *) seen=0.0955 ;; esac
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
rate='{"rate": 0.5, "ci95": [0.25, 0.75]}'
made='"provenance": {"version": "0.1.0", "commit": "abc"}'
echo "{\\"declared_success\\": $rate, \\"true_success\\": $rate, $made}" > "$out/summary.json"
cat > "$out/trials.csv" << END
trial,outcome,detail,true_distance_m,hazards_begun,height_m,scenes,detected_double
0,goal_reached,,8,10,0.05,100,0
1,no_path,,2,5,$seen,100,100
END
""", encoding="utf-8")

    def settings_of_runs(self):
        """Which changes each run among rocks undoes."""
        runs = [line for line in self.called("rockyard") if line.startswith("run ")]
        return [tuple(change in line for change in self.CHANGES) for line in runs]

    def test_every_change_stands_alone_and_is_left_out(self):
        result = self.run_script("revision_study.py", "--tables", "revision", "--trials", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
        alone = [tuple(other != change for other in range(4)) for change in range(4)]
        without = [tuple(other == change for other in range(4)) for change in range(4)]
        both = [undone for pair in zip(alone, without) for undone in pair]
        self.assertEqual(self.settings_of_runs(), 2 * [(True,) * 4, (False,) * 4, *both])
        compared = [[Path(word).parent.name for word in line.split()[1:3]]
                    for line in self.called("rockyard") if line.startswith("compare ")]
        self.assertEqual(compared[:2], [["before", "alone_rocks_on_the_mirror_lines"],
                                        ["without_rocks_on_the_mirror_lines", "revised"]])
        self.assertEqual(compared[8], ["before", "revised"])
        self.assertEqual(result.stdout.count("66.7 (7.7..92.3) | 0.0 (-42.0..42.0)"), 18)
        self.assertIn("3 trials each, seed 1; quasi-static; made by rockyard 0.1.0 abc.",
                      result.stdout)

    def test_low_rocks_get_a_profile_of_their_own(self):
        result = self.run_script("revision_study.py", "--tables", "heights")
        self.assertEqual(result.returncode, 0, result.stderr)
        # Half are seen from 7.225 cm on below a pointedness of 0.1, from 7.275 cm on above it.
        low = r"--set terrain.rocks.max_height_ratio=0.9 --set terrain.rocks.pointedness=0.(09|10)"
        runs = [line for line in self.called("rockyard") if "height_factor" not in line]
        self.assertEqual(sum(bool(re.search(low, line)) for line in runs), 8)
        self.assertEqual(sum("perception.hazard.enabled=false" in line for line in runs), 8)
        self.assertIn("| nominal | low | 50.0 (25.0..75.0) |", result.stdout)
        self.assertIn("| 1.50 |", result.stdout)

    def test_unknown_tables_run_nothing(self):
        self.assertEqual(self.run_script("revision_study.py", "--tables", "other").returncode, 2)
        self.assertEqual(self.called("rockyard"), [])


class NavigatorStudy(ScriptTest):
    """With a rockyard whose GESTALT gains two of three pairs, whatever the rocks."""

    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "scenarios/gestalt", self.root / "scenarios/gestalt")
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
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
fi
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
rate='{"rate": 0.5, "ci95": [0.25, 0.75]}'
made='"provenance": {"version": "0.1.0", "commit": "abc"}'
echo "{\\"declared_success\\": $rate, \\"true_success\\": $rate, $made}" > "$out/summary.json"
printf 'trial,outcome,detail\\n0,goal_reached,\\n1,no_path,\\n2,no_path,\\n' > "$out/trials.csv"
""", encoding="utf-8")

    def lines(self, name):
        path = self.root / "results/runs/navigators" / name
        return path.read_text(encoding="utf-8").splitlines()

    def test_both_navigators_meet_the_same_trials(self):
        result = self.run_script("navigator_study.py", "--trials", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
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
        self.run_script("navigator_study.py", "--rovers", "rocky_3_2", "--set", "seed=4")
        runs = [line for line in self.called("rockyard") if line.startswith("run")]
        self.assertEqual(len(runs), 16)
        self.assertIn("held: seed=4", "\n".join(self.lines("navigators.md")))

    def test_scenarios_of_every_arm_are_there(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import navigator_study  # pylint: disable=import-outside-toplevel
        for stem in navigator_study.ROVERS.values():
            for ending, _ in navigator_study.ARMS.values():
                self.assertTrue((ROOT / f"scenarios/gestalt/{stem}{ending}.json").is_file())


class GestaltStudy(ScriptTest):
    """With a rockyard that gains two of three pairs, whatever is compared."""

    # A setting that undoes each choice, in the order of the script.
    UNDONE = ("max_turn_share=2", "max_bogie_deg=30", "backward_arcs=below_threshold",
              "point_turns=below_min_vote", "step_reference=level", "veto_felt=false",
              "distance_scale=0.9465")

    def setUp(self):
        super().setUp()
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
if [ "$1" = compare ]; then
  echo "                    B - A +0.0 points (95 % interval -42.0 .. +42.0)"
  echo "                    both 1, only A 0, only B 0, neither 2; McNemar, exact: p = 1"
  echo "                    B - A +66.7 points (95 % interval +7.7 .. +92.3)"
  echo "                    both 1, only A 0, only B 2, neither 0; McNemar, exact: p = 0.5"
  echo trials,column > "$5"
  exit 0
fi
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
rate='{"rate": 0.5, "ci95": [0.25, 0.75]}'
made='"provenance": {"version": "0.1.0", "commit": "abc"}, "outcomes": {"jammed": 1}'
echo "{\\"declared_success\\": $rate, \\"true_success\\": $rate, $made}" > "$out/summary.json"
cat > "$out/trials.csv" << END
trial,outcome,detail,true_distance_m,dead_reckoned_distance_m,moves,rear_image_sets,reversals,safeguard_stops
0,goal_reached,,8,9,10,2,1,0
1,no_path,,2,2.5,10,4,3,1
2,jammed,,2,9.5,20,0,0,2
END
""", encoding="utf-8")

    def runs(self):
        return [line for line in self.called("rockyard") if line.startswith("run ")]

    def test_every_choice_stands_alone_and_is_left_out(self):
        result = self.run_script("gestalt_study.py", "--tables", "changes", "--trials", "3")
        self.assertEqual(result.returncode, 0, result.stderr)
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
        result = self.run_script("gestalt_study.py", "--tables", "dense", "--seed", "9")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = [("localization.estimator=oracle" in line, "multibody" in line, "veto_felt=false" in line)
                 for line in self.runs()]
        self.assertEqual(found, [(oracle, multibody, printed) for oracle in (False, True)
                                 for multibody in (False, True) for printed in (True, False)])
        self.assertTrue(all("--seed 9" in line for line in self.runs()))
        # 40 moves of 3 trials, 6 rear looks, 4 reversals, 3 stops; 21 m by odometer for 12 m.
        self.assertIn("| jammed 1 | 13 | 2.0 | 10 | 1.0 | +75 |", result.stdout)

    def test_the_odometer_leaves_out_drives_that_got_stuck(self):
        result = self.run_script("gestalt_study.py", "--tables", "odometer")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(all("distance_scale=1" in line for line in self.runs()))
        # 11.5 m for 10 m.
        self.assertEqual(result.stdout.count("| 2 | 1.1500 | 0.8696 |"), 5)

    def test_unknown_tables_run_nothing(self):
        self.assertEqual(self.run_script("gestalt_study.py", "--tables", "other").returncode, 2)
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
        result = self.run_script("readme_tables.py", "--tables", "table_3", "--pages", str(page))
        self.assertEqual(result.returncode, 0, result.stderr)
        return page.read_text(encoding="utf-8"), result.stderr

    def test_stands_beside_what_is_printed(self):
        self.fake("build/release/tests/navigation/gestalt_benchmark").write_text(
            self.BENCHMARK, encoding="utf-8")
        text, _ = self.write()
        self.assertIn("| fit planes | 20 | 0.081 | 140 | 6.50 | 4.76 | 5.31 | 3.01 |", text)
        self.assertIn("| a whole cycle of the map, 16384 points | 50 | 0.500 | - | - |", text)

    def test_without_a_benchmark_the_page_stays(self):
        text, said = self.write()
        self.assertNotIn("|", text)
        self.assertIn("table_3: not run, left as it is", said)


class FidelityTable(unittest.TestCase):
    def cells(self, low, high):
        sys.path.insert(0, str(ROOT / "scripts"))
        self.addCleanup(sys.path.remove, str(ROOT / "scripts"))
        from readme_tables import mean_cells  # pylint: disable=import-outside-toplevel
        return mean_cells({"mean_a": "7.61293", "mean_b": "7.6267", "difference": "0.0137649",
                           "ci95_low": low, "ci95_high": high})

    def test_a_difference_stands_with_its_interval(self):
        self.assertEqual(self.cells("-0.0247658", "0.0811931"),
                         ("7.613", "7.627", "0.01376 (-0.02477..0.08119)"))

    def test_a_difference_that_few_trials_decide_has_none(self):
        self.assertEqual(self.cells("", ""), ("7.613", "7.627", "0.01376 (no interval)"))


class CourseStudy(ScriptTest):
    """With a rockyard of whose four trials three truly arrive."""

    def setUp(self):
        super().setUp()
        for folder in ("courses", "gestalt"):
            shutil.copytree(ROOT / "scenarios" / folder, self.root / "scenarios" / folder)
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
while [ $# -gt 1 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out"
rate='{"rate": 0.75, "ci95": [0.3, 0.95]}'
made='"provenance": {"version": "0.1.0", "commit": "abc"}'
echo "{\\"true_success\\": $rate, $made}" > "$out/summary.json"
cat > "$out/trials.csv" << END
trial,outcome,detail,path_ratio,turned_in_place_rad
0,goal_reached,,1.2,0
1,goal_reached,,1.5,6.2831853
2,goal_reached,,1.1,0
3,false_goal,,9.0,3.14159
END
""", encoding="utf-8")
        self.expected = self.root / "scenarios/courses/expected.csv"

    def expect(self, *rows):
        head = "course,navigator,least_arrivals_percent,largest_path_ratio,most_turned_deg"
        self.expected.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    def test_a_course_is_passed_where_all_three_keep_to_what_was_expected(self):
        self.expect("wall_3,gestalt,75,1.5,361", "wall_3,behaviour,76,1.5,361",
                    "wall_6,gestalt,75,1.49,361", "wall_6,behaviour,75,1.5,359")
        result = self.run_script("course_study.py")
        self.assertEqual(result.returncode, 0, result.stderr)
        passed = [line.split("|")[-2].strip() for line in result.stdout.splitlines()
                  if line.startswith("| wall")]
        self.assertEqual(passed, ["yes", "**no**", "**no**", "**no**"])
        self.assertIn("1 of 4 passed", result.stdout)
        self.assertIn("| 75 (30..95) | 75 | 1.50 | 1.5 | 360 | 361 | false_goal 1 | yes |",
                      result.stdout)

    def test_both_navigators_meet_the_same_course(self):
        result = self.run_script("course_study.py", "--courses", "ditch", "gravel")
        self.assertEqual(result.returncode, 0, result.stderr)
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
        ditch = json.loads((self.root / "results/runs/courses/ditch_behaviour.json")
                           .read_text(encoding="utf-8"))
        self.assertEqual(ditch["terrain"]["ground"]["ditches"]["depth_m"], [0.3])
        self.assertEqual(ditch["course"]["goal_x_m"], 6)
        self.assertEqual(ditch["name"], "course_ditch_behaviour")

    def test_every_course_has_an_expectation_for_each_navigator(self):
        rows = self.expected.read_text(encoding="utf-8").splitlines()[1:]
        found = sorted(tuple(row.split(",")[:2]) for row in rows)
        courses = [path.stem for path in (ROOT / "scenarios/courses").glob("*.json")]
        self.assertEqual(found, sorted((course, navigator) for course in courses
                                       for navigator in ("gestalt", "behaviour")))


class HazardImprovements(ScriptTest):
    """With a rockyard that measures as many scenes a cell as it is told runs."""

    def setUp(self):
        super().setUp()
        shutil.copytree(ROOT / "scenarios/hazard_detection", self.root / "scenarios/hazard_detection")
        self.fake("build/release/bin/rockyard").write_text("""#!/bin/sh
echo "rockyard $*" >> "$CALLS"
while [ $# -gt 1 ]; do
  case "$1" in --out) out=$2 ;; --trials) trials=$2 ;; esac
  shift
done
mkdir -p "$out"
rate="{\\"rate\\": 0.5, \\"count\\": $trials, \\"trials\\": $trials}"
echo "{\\"provenance\\": {\\"version\\": \\"0.1.0\\", \\"commit\\": \\"abc\\"}, \\"cells\\": [
  {\\"height_m\\": 0.075, \\"detected_double\\": $rate, \\"alarm_single\\": $rate,
   \\"alarm_believed\\": $rate}]}" > "$out/summary.json"
""", encoding="utf-8")

    def test_another_share_or_build_never_reads_the_runs_that_are_there(self):
        rockyard = self.root / "build/release/bin/rockyard"
        out = self.root / "out"
        for share, trials in ((0.2, 240), (0.4, 480)):
            self.calls.write_text("", encoding="utf-8")
            result = self.run_script("hazard_improvements.py", rockyard, out, "--level", "geometric",
                                     "--share", str(share))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(len(self.called("rockyard")), 10)
            self.assertEqual(result.stdout.count(f"1.0000 of {trials} "), 10)
            self.assertIn(f"{share} of the shipped runs, seed 1; made by rockyard 0.1.0 abc.",
                          result.stdout)
        for line in self.called("rockyard"):
            self.assertIn("--resume --force", line)
        self.assertNotIn("of these", result.stdout)


class StudyProgress(unittest.TestCase):
    def test_tells_what_is_done_and_left_twice_a_minute(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import study  # pylint: disable=import-outside-toplevel
        times = iter([100.0, 110.0, 131.0, 140.0, 170.0])
        told = io.StringIO()
        with unittest.mock.patch("time.monotonic", lambda: next(times)), contextlib.redirect_stderr(told):
            progress = study.Progress("kills", 200)
            for done in (10, 31, 40, 50):
                progress.at(done, 1)
        # After 31 s and 31 of 200: 169 more take 169 s; after 70 s and 50 of 200: 150 more take 210 s.
        self.assertEqual(told.getvalue(), "kills: 31 of 200, 1 found, about 3 min left\n"
                                          "kills: 50 of 200, 1 found, about 4 min left\n")


class StudyStatistics(unittest.TestCase):
    """The numbers of scripts/study.py against published or independently computed ones."""

    def setUp(self):
        sys.path.insert(0, str(ROOT / "scripts"))
        import study  # pylint: disable=import-outside-toplevel
        self.study = study

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
        self.interval(self.study.ratio_interval([1, 2, 3], [10, 20, 30]),
                      (0.1, *self.study.exact_interval(6, 60)))

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


class InstallDependencies(unittest.TestCase):
    """The real script with a package system that knows some packages and installs nothing."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        shutil.copytree(ROOT / "scripts", self.root / "scripts")
        (self.root / "scripts/debian_packages.txt").write_text(
            "# list\nhere  build  reason\naway  build  reason\nmore  test  reason\n", encoding="utf-8")
        self.tool("dpkg-query", 'case "$*" in *here*) echo installed;; *) exit 1;; esac')
        self.tool("apt-get", 'echo "$*" >> "$CALLS"')
        self.tool("apt-cache", 'exit "${KNOWN:-0}"')
        self.tool("id", 'echo "${USER_ID:-0}"')

    def tool(self, name, body):
        path = self.root / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        path.chmod(0o755)

    def install(self, *groups, path=None, **environment):
        calls = self.root / "calls"
        calls.write_text("", encoding="utf-8")
        variables = {"CALLS": str(calls), **environment,
                     "PATH": f"{self.root / 'bin'}:{path or os.environ['PATH']}"}
        result = subprocess.run([self.root / "scripts/install_dependencies.sh", *groups], text=True,
                                env=variables, capture_output=True, check=False)
        return result, calls.read_text(encoding="utf-8").splitlines()

    def test_installs_only_what_is_missing(self):
        result, calls = self.install("build", "test")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(calls, ["install -y --no-install-recommends away more"])

    def test_fetches_the_index_only_when_a_package_is_unknown(self):
        _, calls = self.install("build", KNOWN="100")
        self.assertEqual(calls, ["update", "install -y --no-install-recommends away"])

    def test_nothing_to_do(self):
        (self.root / "scripts/debian_packages.txt").write_text("here build reason\n", encoding="utf-8")
        result, calls = self.install()
        self.assertEqual((result.returncode, calls), (0, []))

    def test_without_root_and_sudo_it_says_what_is_missing(self):
        for name in ("env", "dirname", "awk", "sh"):
            (self.root / "bin" / name).symlink_to(shutil.which(name))
        result, calls = self.install("build", path="/nowhere", USER_ID="1000")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertIn("needs root or sudo: away", result.stderr)

    def test_a_command_of_another_package_counts_as_its_own(self):
        (self.root / "scripts/debian_packages.txt").write_text(
            "npm:sh build reason\nnodejs:no-such-command build reason\n", encoding="utf-8")
        result, calls = self.install("build")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(calls, ["install -y --no-install-recommends nodejs"])

    def test_unknown_group(self):
        result, calls = self.install("nonsense")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertIn("nonsense", result.stderr)


class PackageList(unittest.TestCase):
    def test_every_line_has_a_name_a_known_group_and_a_reason(self):
        lines = (ROOT / "scripts/debian_packages.txt").read_text(encoding="utf-8").splitlines()
        packages = [line.split(None, 2) for line in lines if line and not line.startswith("#")]
        for fields in packages:
            self.assertEqual(len(fields), 3, fields)
            self.assertIn(fields[1], ("build", "mpi", "planetary", "pages", "test", "tsan", "figures"))
        names = [fields[0] for fields in packages]
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    sys.exit(unittest.main())
