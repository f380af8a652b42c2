"""scripts/studies/equivalence/equivalence.py: its intervals, its verdicts, and which runs it makes, takes and refuses."""

import contextlib
import csv
import io
import json
import math
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from context import ROOT
import study
from equivalence import equivalence


class Intervals(unittest.TestCase):
    def interval(self, values, expected, places):
        for value, wanted in zip(values, expected):
            self.assertAlmostEqual(value, wanted, places=places)

    def test_tangos_example(self):
        # Tango 1998: 44 pairs, 43 of both, one of the first only, margin 0.1: z 1.709.
        self.assertAlmostEqual(equivalence.tango_score(1, 0, 44, -0.1), 1.709, places=3)

    def test_published_interval(self):
        # Airway hyper-responsiveness before and after (Bentur 2009, in Fagerland, Lydersen and Laake
        # 2014): 7 of 21 only after, 1 only before.
        self.interval(equivalence.tango_interval(7, 1, 21, 0.95), (-0.517, -0.026), 3)
        self.interval(equivalence.tango_interval(1, 7, 21, 0.95), (0.026, 0.517), 3)

    def test_no_pair_differs_in_closed_form(self):
        square = 1.959963984540054 ** 2
        end = square / (40.0 + square)
        self.interval(equivalence.tango_interval(0, 0, 40, 0.95), (-end, end), 9)

    def test_ends_at_zero_where_mcnemars_score_is_critical(self):
        confidence = math.erf(10.0 / math.sqrt(16.0) / math.sqrt(2.0))
        self.assertAlmostEqual(equivalence.tango_interval(3, 13, 44, confidence)[0], 0.0, places=9)

    def test_ninety_per_cent_is_what_both_one_sided_tests_do_not_reject(self):
        low, high = equivalence.tango_interval(30, 50, 1000)
        self.assertAlmostEqual(equivalence.tango_score(30, 50, 1000, low), 1.6448536, places=6)
        self.assertAlmostEqual(equivalence.tango_score(30, 50, 1000, high), -1.6448536, places=6)
        self.assertLess(low, 0.02)
        self.assertGreater(high, 0.02)

    def test_extremes(self):
        self.assertEqual(equivalence.tango_interval(0, 0, 0), (-1.0, 1.0))
        self.assertAlmostEqual(equivalence.tango_interval(0, 10, 10)[1], 1.0)
        self.assertAlmostEqual(equivalence.tango_interval(10, 0, 10)[0], -1.0)

    def test_student_against_tables(self):
        for freedom, wanted in ((1, 6.3138), (2, 2.9200), (10, 1.8125), (120, 1.6577)):
            self.assertAlmostEqual(equivalence.student_quantile(0.95, freedom), wanted, places=4)
        # By hand: 1, 2, 3 have a standard deviation of 1.
        self.assertAlmostEqual(equivalence.half_width([1.0, 2.0, 3.0]), 2.91999 / math.sqrt(3.0), places=4)
        self.assertTrue(math.isnan(equivalence.half_width([1.0])))

    def test_differences_are_second_less_first(self):
        first = [{"outcome": "no_path", "d": each} for each in (1.0, 2.0, 6.0)]
        second = [{"outcome": "goal_reached", "d": each} for each in (3.0, 4.0, 5.0)]
        rate = equivalence.rate_row(first, second, ("goal_reached",))
        self.assertEqual((rate["difference"], rate["only_first"], rate["only_second"]), (100.0, 0, 3))
        mean = equivalence.mean_row(first, second, "d")
        self.assertAlmostEqual(mean["difference"], 1.0)
        # Differences 2, 2, -1: standard deviation sqrt(3).
        self.assertAlmostEqual(mean["low"], 1.0 - 2.91999, places=4)
        ratio = equivalence.ratio_row(first, second, "d")
        self.assertAlmostEqual(ratio["second"], 100.0 * 4.0 / 3.0)
        self.assertAlmostEqual(ratio["difference"], 100.0 / 3.0)
        # Residuals 5/3, 4/3, -3: variance 61/9, over 3 trials and a mean of 3.
        self.assertAlmostEqual(ratio["high"] - ratio["difference"], 291.999 * math.sqrt(61.0 / 27.0) / 3.0, places=2)

    def test_pairs_without_a_number_are_left_out(self):
        rows = [{"d": 1.0}, {"d": math.nan}, {"d": 3.0}]
        self.assertEqual(equivalence.mean_row(rows, [{"d": 2.0}] * 3, "d")["pairs"], 2)


class Verdicts(unittest.TestCase):
    def test_an_interval_must_lie_between_the_margins(self):
        for values, wanted in (((0.0, -4.9, 4.9), "equivalent"), ((1.0, -3.0, 5.1), "cannot tell"),
                               ((-1.0, -5.1, 3.0), "cannot tell"), ((0.0, -6.0, 6.0), "cannot tell"),
                               ((8.0, 7.0, 9.0), "different"), ((-8.0, -9.0, -7.0), "different"),
                               ((0.0, math.nan, math.nan), "cannot tell")):
            self.assertEqual(equivalence.verdict(values, 5.0), wanted, values)

    def test_without_a_margin_there_is_none(self):
        self.assertEqual(equivalence.verdict((50.0, 40.0, 60.0), None), "-")

    def test_margins_are_those_of_measures_that_are_there(self):
        measures = {*equivalence.RATES, *equivalence.MEANS, equivalence.RATIO}
        for (name, cell), margins in equivalence.MARGINS.items():
            self.assertIn(cell, equivalence.CELLS[name])
            self.assertLessEqual(set(margins), measures)
        self.assertEqual(len(equivalence.MARGINS), sum(map(len, equivalence.CELLS.values())))


class Study(unittest.TestCase):
    """With a rockyard that invents its trials."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.out = self.root / "out"
        self.calls = []

    def rockyard(self, command, changed="nothing", lost=0, outcome="no_path", farther=0.0, fault=False, commit="abc"):
        """Fingerprints follow from scenario, seed and settings; trials all arrive truly, but the first `lost` of those
        with `changed` in their settings."""
        words = list(map(str, command[1:]))
        self.calls.append(" ".join(words))
        pairs = list(zip(words, words[1:]))
        options, settings = dict(pairs), [value for name, value in pairs if name == "--set"]
        seed = options.get("--seed") or next(each for each in settings if each.startswith("seed="))[5:]
        settings = [each for each in settings if not each.startswith("seed=")]
        made = " ".join([Path(words[1]).stem, seed, *settings])
        if words[0] == "validate":
            return f"{words[1]}: valid, fingerprint {made.encode().hex()}"
        folder, trials = Path(options["--out"]), int(options["--trials"])
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "summary.json").write_text(json.dumps({
            "scenario": "nominal", "seed": int(seed), "settings": settings, "fingerprint": made.encode().hex(),
            "trials": {"stored": trials}, "provenance": {"version": "0.1.0", "commit": commit}}), encoding="utf-8")
        is_changed = changed in made
        lines = ["trial,outcome,true_distance_m,distance_error_percent,position_error_m,detail"]
        for trial in range(trials):
            end = outcome if is_changed and trial < lost else "goal_reached"
            lines.append(f"{trial},{end},{8 + trial % 3 + (farther if is_changed else 0)},{trial % 2},0.5,")
        if fault and is_changed:
            lines[1] = "0,simulator_fault,,,,bad"
        (folder / "trials.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        return ""

    def study(self, *arguments, **trials):
        words = ["equivalence.py", "--out", self.out, "--csv", self.root / "rows.csv", *arguments]
        out, err = io.StringIO(), io.StringIO()
        with (mock.patch.object(study, "run", lambda command: self.rockyard(command, **trials)),
              mock.patch.object(sys, "argv", list(map(str, words))),
              contextlib.redirect_stdout(out), contextlib.redirect_stderr(err)):
            try:
                code = equivalence.main()
            except SystemExit as end:
                code = end.code
                if isinstance(code, str):
                    code = 1
                    print(end, file=err)
        return SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=err.getvalue())

    def runs(self):
        return [line for line in self.calls if line.startswith("run ")]

    def rows(self):
        with open(self.root / "rows.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        found = {(row["study"], row["cell"], row["measure"]): row for row in rows}
        self.assertEqual(len(found), len(rows), "no row twice")
        return found

    def verdict(self, *key):
        return self.rows()[key]["verdict"]

    def test_every_run_once_and_the_shared_one_too(self):
        result = self.study()
        self.assertEqual(result.returncode, 0, result.stderr)
        folders = {line.split("--out ")[1] for line in self.runs()}
        names = ["step/nominal_60", "step/nominal_480", "step/vl2_60", "step/vl2_480",
                 "fidelity/nominal_quasi_static"]
        names += [f"fidelity/{cell}_{side}" for cell in ("obstacles_0.85", "k_0.006", "k_0.0085", "slope_10")
                  for side in ("multibody", "quasi_static")]
        self.assertEqual(folders, {str(self.out / name) for name in names})
        self.assertEqual(len(self.runs()), len(names))
        self.assertEqual(sum("--trials 2400" in line for line in self.runs()), 2)
        self.assertEqual(sum("--trials 1000" in line for line in self.runs()), len(names) - 2)
        self.assertEqual(sum("step_s=0.0020833333333333333" in line for line in self.runs()), 2)
        self.assertEqual(sum("fidelity=quasi_static" in line for line in self.runs()), 5)
        for change in ("rocks.k_per_m2=0.006 ", "rocks.k_per_m2=0.0085 ", "ground.slope_deg=10 ",
                       "/obstacles_0.85.json"):
            self.assertEqual(sum(change in line for line in self.runs()), 2, change)
        self.assertEqual(len(self.rows()), 7 * 7)
        judged = [row["verdict"] for row in self.rows().values() if row["margin"]]
        self.assertEqual(judged, ["equivalent"] * 14)
        self.assertEqual(result.stderr.count("1000 trials,"), 12)

    def test_finished_runs_are_taken(self):
        self.study()
        self.calls.clear()
        result = self.study("--trials", "50")
        self.assertEqual((self.runs(), result.stderr.count(": taken (")), ([], 14))
        self.assertEqual({row["pairs"] for row in self.rows().values()}, {"50"})

    def test_the_shared_run_is_taken_from_either_folder(self):
        self.study("--studies", "step", "--trials", "9")
        self.out.joinpath("fidelity").mkdir()
        (self.out / "step/nominal_60").rename(self.out / "fidelity/nominal_multibody")
        self.calls.clear()
        self.study("--studies", "step", "--trials", "9")
        self.assertEqual(self.runs(), [])

    def test_short_runs_are_extended(self):
        self.study("--studies", "step", "--trials", "10")
        self.calls.clear()
        result = self.study("--studies", "step", "--trials", "12")
        self.assertEqual(len(self.runs()), 4)
        self.assertTrue(all("--resume" in line and "--force" not in line for line in self.runs()))
        self.assertEqual(result.stderr.count(": extended ("), 4)

    def test_runs_of_other_settings_are_refused(self):
        self.study("--studies", "step", "--trials", "10")
        self.calls.clear()
        for change in (["--seed", "2"], ["--set", "clock.stop_time_s=0.1"]):
            result = self.study("--studies", "step", "--trials", "10", *change)
            self.assertEqual(result.returncode, 1)
            self.assertIn("holds another run: nominal, seed 1, nothing set", result.stderr)
            self.assertIn("Choose another --out", result.stderr)
        self.assertEqual(self.runs(), [])

    def test_what_is_beyond_the_margin_is_not_equivalent(self):
        # Of 1000 pairs: 70 lie beyond 5 points, the interval of 45 holds them, that of 30 does not.
        for lost, code, wanted in ((70, 1, "different"), (45, 1, "cannot tell"), (30, 0, "equivalent")):
            shutil.rmtree(self.out, ignore_errors=True)
            result = self.study(changed="quasi_static", lost=lost)
            self.assertEqual(result.returncode, code, result.stderr)
            for kind in ("declared success (%)", "true success (%)"):
                self.assertEqual(self.verdict("fidelity", "slope_10", kind), wanted)
                self.assertEqual(self.verdict("step", "nominal", kind), "equivalent")
            row = self.rows()["fidelity", "nominal", "true success (%)"]
            self.assertAlmostEqual(float(row["difference"]), -lost / 10)
            self.assertEqual((row["only_first"], row["only_second"]), (str(lost), "0"))
            self.assertLess(float(row["low"]), -lost / 10)

    def test_a_false_goal_is_a_declared_success_only(self):
        self.study("--studies", "step", changed="step_s", lost=100, outcome="false_goal")
        self.assertEqual(self.verdict("step", "nominal", "declared success (%)"), "equivalent")
        self.assertEqual(self.verdict("step", "nominal", "true success (%)"), "different")

    def test_vl2_is_judged_by_jams_and_distance(self):
        # 4 of 100 points are 96 of 2400; 5 % of 9 m are 0.45 m.
        for outcome, lost, farther, jams, distance in (
                ("jammed", 68, 0.44, "equivalent", "equivalent"),
                ("jammed", 92, 0, "cannot tell", "equivalent"),
                ("high_centred", 130, -0.46, "different", "different"),
                ("no_path", 130, 0.46, "equivalent", "different")):
            shutil.rmtree(self.out, ignore_errors=True)
            self.study("--studies", "step", changed="step_s", lost=lost, outcome=outcome, farther=farther)
            self.assertEqual(self.verdict("step", "vl2", "jams (%)"), jams)
            self.assertEqual(self.verdict("step", "vl2", equivalence.RATIO), distance)
            self.assertEqual(self.verdict("step", "nominal", "jams (%)"), "-")

    def test_pairs_with_a_fault_are_left_out_and_told(self):
        result = self.study("--studies", "step", "--trials", "20", changed="step_s", fault=True)
        self.assertEqual(self.rows()["step", "nominal", "jams (%)"]["pairs"], "19")
        self.assertIn("1 of 20 pairs left out", result.stderr)

    def test_what_is_undefined_leaves_its_pair_out_of_that_mean_only(self):
        self.study("--studies", "step", "--trials", "20")
        path = self.out / "step/vl2_480/trials.csv"
        path.write_text(path.read_text(encoding="utf-8").replace("\n1,goal_reached,9,1,", "\n1,goal_reached,9,,"),
                        encoding="utf-8")
        result = self.study("--studies", "step", "--trials", "20")
        self.assertEqual(result.returncode, 1, result.stderr)  # 20 pairs prove nothing
        self.assertEqual(self.rows()["step", "vl2", "distance error (%)"]["pairs"], "19")
        self.assertEqual(self.rows()["step", "vl2", "true distance (m)"]["pairs"], "20")

    def test_tables_go_between_the_marks_and_the_rest_stays(self):
        page = self.root / "page.md"
        page.write_text("# Page\n\n<!-- begin step -->\nold\n<!-- end step -->\n\n"
                        "<!-- begin fidelity -->\nkept\n<!-- end fidelity -->\n", encoding="utf-8")
        self.study("--studies", "step", "--markdown", page, "--seed", "7")
        text = page.read_text(encoding="utf-8")
        self.assertNotIn("old", text)
        self.assertIn("kept", text)
        self.assertIn("| nominal | true success (%) | 1000 | 100.0 | 100.0 | 0.0 (-0.3..0.3) | "
                      "5 | equivalent |", text)
        self.assertIn("Seed 7; made by rockyard 0.1.0 abc.", text)

    def test_the_file_of_rows_keeps_the_other_study(self):
        self.study("--studies", "fidelity", "--trials", "20")
        for trials in ("9", "10"):
            self.study("--studies", "step", "--trials", trials)
        self.assertEqual(len(self.rows()), 7 * 7)
        self.assertEqual(self.rows()["fidelity", "slope_10", "jams (%)"]["pairs"], "20")

    def test_two_programs_are_named(self):
        self.study("--studies", "step", "--trials", "10")
        shutil.rmtree(self.out / "step/nominal_480")
        result = self.study("--studies", "step", "--trials", "10", commit="def")
        self.assertIn("made by rockyard 0.1.0 abc and 0.1.0 def: not one program.", result.stdout)

    def test_what_makes_no_sense_runs_nothing(self):
        for arguments in (["--trials", "1"], ["--studies", "other"]):
            self.assertEqual(self.study(*arguments).returncode, 2)
        self.assertEqual(self.calls, [])

    def test_the_page_has_the_marks_and_the_scenarios_are_there(self):
        text = (ROOT / "results/studies/equivalence.md").read_text(encoding="utf-8")
        for name, cells in equivalence.CELLS.items():
            self.assertRegex(text, rf"(?s)<!-- begin {name} -->\n.*\n<!-- end {name} -->")
            for scenario, *_ in cells.values():
                self.assertTrue((equivalence.PATHFINDER / f"{scenario}.json").is_file())
