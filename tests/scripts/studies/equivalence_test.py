"""scripts/studies/equivalence/equivalence.py: its intervals, its verdicts, and which runs it makes, takes and refuses."""

import math
import unittest
from pathlib import Path
from unittest import mock

from context import ROOT, StudyTest, frame, study
from equivalence import equivalence


class Rows(unittest.TestCase):
    def pairs(self, first, second):
        return frame({f"{name}_{side}": value for side, row in ((1, a), (2, b)) for name, value in row.items()}
                     for a, b in zip(first, second, strict=True))

    def test_differences_are_second_less_first(self):
        pairs = self.pairs([{"outcome": "no_path", "d": each} for each in (1.0, 2.0, 6.0)],
                           [{"outcome": "goal_reached", "d": each} for each in (3.0, 4.0, 5.0)])
        rate = equivalence.rate_row(pairs, ("goal_reached",))
        self.assertEqual((rate["difference"], rate["only_first"], rate["only_second"]), (100.0, 0, 3))
        mean = equivalence.mean_row(pairs, "d")
        self.assertAlmostEqual(mean["difference"], 1.0)
        # Differences 2, 2, -1: standard deviation sqrt(3).
        self.assertAlmostEqual(mean["low"], 1.0 - 2.91999, places=4)
        ratio = equivalence.ratio_row(pairs, "d")
        self.assertAlmostEqual(ratio["second"], 100.0 * 4.0 / 3.0)
        self.assertAlmostEqual(ratio["difference"], 100.0 / 3.0)
        # Residuals 5/3, 4/3, -3: variance 61/9, over 3 trials and a mean of 3.
        self.assertAlmostEqual(ratio["high"] - ratio["difference"], 291.999 * math.sqrt(61.0 / 27.0) / 3.0, places=2)

    def test_rates_have_intervals_of_ninety_per_cent(self):
        pairs = self.pairs([{"outcome": "goal_reached"}] * 30 + [{"outcome": "no_path"}] * 970,
                           [{"outcome": "no_path"}] * 30 + [{"outcome": "goal_reached"}] * 50 + [{"outcome": "no_path"}] * 920)
        rate = equivalence.rate_row(pairs, ("goal_reached",))
        low, high = study.rates.paired_difference(0, 30, 50, 920, 0.90, "tango")
        self.assertEqual((rate["low"], rate["high"]), (100.0 * low, 100.0 * high))
        self.assertTrue(0.0 < low < 0.02 < high < 0.04)

    def test_pairs_without_a_number_are_left_out(self):
        pairs = self.pairs([{"d": 1.0}, {"d": math.nan}, {"d": 3.0}], [{"d": 2.0}] * 3)
        self.assertEqual(equivalence.mean_row(pairs, "d")["pairs"], 2)


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


class Study(StudyTest):
    """With a rockyard that invents its trials."""

    def setUp(self):
        super().setUp()
        self.out, self.made = self.root / "out", {}

    def answer(self, words):
        """Trials all arrive truly, but the first `lost` of those with `changed` in their settings; a run of other settings
        in the folder is refused."""
        options, trials = dict(zip(words, words[1:])), self.trials
        settings = [value for name, value in zip(words, words[1:]) if name == "--set"]
        made, folder, count = " ".join([words[2], options["--seed"], *settings]), options["--out"], int(options["--trials"])
        Path(folder).mkdir(parents=True, exist_ok=True)
        before, rows = self.made.get(folder, (made, []))
        if before != made:
            return 2, ""
        is_changed = trials.get("changed", "nothing") in made
        for trial in range(len(rows), count):
            lost = is_changed and trial < trials.get("lost", 0)
            rows.append({"outcome": trials.get("outcome", "no_path") if lost else "goal_reached",
                         "true_distance_m": 8 + trial % 3 + (trials.get("farther", 0) if is_changed else 0),
                         "distance_error_percent": trial % 2, "position_error_m": 0.5})
        if trials.get("fault") and is_changed:
            rows[0] = dict.fromkeys(rows[0], math.nan) | {"outcome": "simulator_fault"}
        self.made[folder] = made, rows
        return 0, ""

    def rows_of(self, folder):
        return self.made[folder][1]

    def study(self, *words, code=0, **trials):
        self.trials = trials
        return self.script(equivalence, "--out", self.out, "--csv", self.root / "rows.csv", *words, code=code)

    def rows_by_key(self):
        rows = study.read_csv(self.root / "rows.csv")
        found = {(row["study"], row["cell"], row["measure"]): row for row in rows}
        self.assertEqual(len(found), len(rows), "no row twice")
        return found

    def verdict(self, *key):
        return self.rows_by_key()[key]["verdict"]

    def test_every_run_once_by_all_seeds(self):
        self.study("--seed", 40)
        runs = self.commands("run")
        names = ["step/nominal_60", "step/nominal_480", "step/vl2_60", "step/vl2_480"]
        names += [f"fidelity/{cell}_{side}_{seed}" for seed in (40, 41, 42) for side in ("multibody", "quasi_static")
                  for cell in ("nominal", "obstacles_0.85", "k_0.006", "k_0.0085", "vl2", "slope_10")]
        self.assertEqual(set(self.made), {str(self.out / name) for name in names})
        self.assertEqual(len(runs), len(names))
        self.assertTrue(all(f"--seed {folder[-2:]} " in f"{line} " for folder in names[4:] for line in runs
                            if f"{self.out / folder} " in f"{line} "))
        self.assertEqual(sum("--trials 2400" in line for line in runs), 2)
        self.assertEqual(sum("--trials 1000" in line for line in runs), len(names) - 2)
        self.assertEqual(sum("step_s=0.0020833333333333333" in line for line in runs), 2)
        self.assertEqual(sum("fidelity=quasi_static" in line for line in runs), 18)
        for change in ("rocks.k_per_m2=0.006 ", "rocks.k_per_m2=0.0085 ", "ground.slope_deg=10 ",
                       "/obstacles_0.85.json"):
            self.assertEqual(sum(change in f"{line} " for line in runs), 6, change)
        self.assertEqual(len(self.rows_by_key()), 8 * 7)
        self.assertEqual(self.rows_by_key()["fidelity", "nominal", "jams (%)"]["pairs"], "3000")
        judged = [row["verdict"] for row in self.rows_by_key().values() if row["margin"]]
        self.assertEqual(judged, ["equivalent"] * 16)

    def test_runs_that_are_there_are_gone_on_with_and_never_set_aside(self):
        self.study("--studies", "step", "--trials", 10, code=1)
        self.calls.clear()
        self.study("--studies", "step", "--trials", 12, code=1)
        self.assertEqual(len(self.commands("run")), 4)
        self.assertTrue(all("--resume" in line and "--force" not in line for line in self.commands("run")))

    def test_of_longer_runs_the_first_trials_count(self):
        self.study("--studies", "step", "--trials", 60, code=1)
        self.study("--studies", "step", "--trials", 50, code=1)
        self.assertEqual({row["pairs"] for row in self.rows_by_key().values()}, {"50"})

    def test_runs_of_other_settings_are_refused(self):
        self.study("--studies", "step", "--trials", 10, code=1)
        for change in (["--seed", 2], ["--set", "clock.stop_time_s=0.1"]):
            self.assertIn("exit code 2", self.study("--studies", "step", "--trials", 10, *change, code=1).err)

    def test_what_is_beyond_the_margin_is_not_equivalent(self):
        # Of 1000 pairs by three seeds: 40 lie beyond 3 points, the interval of 28 holds them, that of 20 does not.
        for lost, code, wanted in ((40, 1, "different"), (28, 1, "cannot tell"), (20, 0, "equivalent")):
            self.made.clear()
            self.study(changed="quasi_static", lost=lost, code=code)
            for kind in ("declared success (%)", "true success (%)"):
                self.assertEqual(self.verdict("fidelity", "slope_10", kind), wanted)
                self.assertEqual(self.verdict("step", "nominal", kind), "equivalent")
            row = self.rows_by_key()["fidelity", "nominal", "true success (%)"]
            self.assertAlmostEqual(float(row["difference"]), -lost / 10)
            self.assertEqual(row["by_seed"], " ".join([f"{-lost / 10:.1f}"] * 3))
            self.assertEqual((row["only_first"], row["only_second"]), (str(3 * lost), "0"))
            self.assertLess(float(row["low"]), -lost / 10)

    def test_a_false_goal_is_a_declared_success_only(self):
        self.study("--studies", "step", changed="step_s", lost=100, outcome="false_goal", code=1)
        self.assertEqual(self.verdict("step", "nominal", "declared success (%)"), "equivalent")
        self.assertEqual(self.verdict("step", "nominal", "true success (%)"), "different")

    def test_vl2_is_judged_by_jams_and_distance(self):
        # 4 of 100 points are 96 of 2400; 5 % of 9 m are 0.45 m.
        for outcome, lost, farther, jams, distance in (
                ("jammed", 68, 0.44, "equivalent", "equivalent"),
                ("jammed", 92, 0, "cannot tell", "equivalent"),
                ("high_centred", 130, -0.46, "different", "different"),
                ("no_path", 130, 0.46, "equivalent", "different")):
            self.made.clear()
            self.study("--studies", "step", changed="step_s", lost=lost, outcome=outcome, farther=farther, code=1)
            self.assertEqual(self.verdict("step", "vl2", "jams (%)"), jams)
            self.assertEqual(self.verdict("step", "vl2", equivalence.RATIO), distance)
            self.assertEqual(self.verdict("step", "nominal", "jams (%)"), "-")

    def test_pairs_with_a_fault_are_left_out_and_told(self):
        result = self.study("--studies", "step", "--trials", 20, changed="step_s", fault=True, code=1)
        self.assertEqual(self.rows_by_key()["step", "nominal", "jams (%)"]["pairs"], "19")
        self.assertIn("1 of 20 pairs left out", result.err)

    def test_what_is_undefined_leaves_its_pair_out_of_that_mean_only(self):
        self.study("--studies", "step", "--trials", 20, code=1)
        self.made[str(self.out / "step/vl2_480")][1][1]["distance_error_percent"] = math.nan
        self.study("--studies", "step", "--trials", 20, code=1)  # 20 pairs prove nothing
        self.assertEqual(self.rows_by_key()["step", "vl2", "distance error (%)"]["pairs"], "19")
        self.assertEqual(self.rows_by_key()["step", "vl2", "true distance (m)"]["pairs"], "20")

    def test_tables_go_between_the_marks_and_the_rest_stays(self):
        page = self.root / "page.md"
        page.write_text("# Page\n\n<!-- begin step -->\nold\n<!-- end step -->\n\n"
                        "<!-- begin fidelity -->\nkept\n<!-- end fidelity -->\n", encoding="utf-8")
        self.study("--studies", "step", "--markdown", page, "--seed", 7)
        text = page.read_text(encoding="utf-8")
        self.assertNotIn("old", text)
        self.assertIn("kept", text)
        self.assertIn("| nominal | true success (%) | 1000 | 100.0 | 100.0 | 0.0 (-0.3..0.3) | "
                      "5 | equivalent |", text)
        self.assertIn("Seed 7; made by rockyard 0.1.0 abc.", text)

    def test_the_file_of_rows_keeps_the_other_study(self):
        self.study("--studies", "fidelity", "--trials", 20, code=1)
        for trials in (9, 10):
            self.study("--studies", "step", "--trials", trials, code=1)
        self.assertEqual(len(self.rows_by_key()), 8 * 7)
        self.assertEqual(self.rows_by_key()["fidelity", "slope_10", "jams (%)"]["pairs"], "18")

    def test_two_programs_are_named(self):
        runs = iter("abcd")
        program = lambda run: f"0.1.0 {'abc' if next(runs) == 'a' else 'def'}"
        with mock.patch.object(study, "program", program):
            result = self.study("--studies", "step", "--trials", 10, code=1)
        self.assertIn("made by rockyard 0.1.0 abc and 0.1.0 def: not one program.", result.out)

    def test_what_makes_no_sense_runs_nothing(self):
        for words in (["--trials", 1], ["--studies", "other"]):
            self.study(*words, code=2)
        self.assertEqual(self.calls, [])

    def test_the_page_has_the_marks_and_the_scenarios_are_there(self):
        text = (ROOT / "results/studies/equivalence.md").read_text(encoding="utf-8")
        for name, cells in equivalence.CELLS.items():
            self.assertRegex(text, rf"(?s)<!-- begin {name} -->\n.*\n<!-- end {name} -->")
            for scenario, *_ in cells.values():
                self.assertTrue((equivalence.PATHFINDER / f"{scenario}.json").is_file())
