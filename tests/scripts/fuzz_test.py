"""The harness of fuzz.py: it finds what is there to find, and makes a case again from its number."""

import contextlib
import io
import shutil
import sys
import tempfile
import textwrap
import unittest
import unittest.mock
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/long"))

import fuzz  # noqa: E402
from fuzzing import harness, lines, scenarios, valid  # noqa: E402
from progress import Progress  # noqa: E402

ROCKYARD = None  # the real command; the first argument


def setUpModule():
    """The command's help is asked for once."""
    known = lines.commands(ROCKYARD)
    unittest.enterModuleContext(unittest.mock.patch.object(lines, "commands", lambda rockyard: known))


def end(code, err="", out=""):
    return harness.End(code, out, err)


class Verdicts(unittest.TestCase):
    def test_ends_that_are_documented(self):
        for code in (0, 1, 3, 4, 130):
            self.assertEqual(harness.problem_of(end(code)), "")
        self.assertEqual(harness.problem_of(end(2, "error: a: is b\n")), "")

    def test_ends_that_are_not(self):
        for wrong, reason in ((end(None), "hangs"), (end(-11), "signal 11"), (end(134), "134"), (end(5), "5"),
                              (end(2), "does not say why"),
                              (end(2, "error: a: [json.exception.type_error.302] type"), "not its own"),
                              (end(0, "terminate called after throwing"), "not its own"),
                              (end(2, "error: rockyard: stod"), "not its own"),
                              (end(2, "error: : is not a known key"), "no place"),
                              (end(2, "error: 7.json: terrain.: is not a known key"), "no place"),
                              (end(2, "error: a\x1b[2J: b"), "terminal"),
                              (end(2, "error: a\u202e: b"), "terminal")):
            self.assertIn(reason, harness.problem_of(wrong))
        quoted = "error: 7.json: line 1: last read: '\"stof?C'; expected string literal"
        self.assertEqual(harness.problem_of(end(2, quoted)), "")
        self.assertIn("not its own", harness.problem_of(end(2, quoted.replace("last read", "stof"))))
        self.assertIn("ends with 1", harness.problem_of(end(1), {0, 2}))


class Cases(unittest.TestCase):
    def test_come_again_from_seed_and_number(self):
        everything = scenarios.sources(ROCKYARD)
        self.assertGreater(len(everything), 50)

        def made(seed):
            return [scenarios.make(everything, harness.generator(seed, "scenarios", index)) for index in range(100)]

        self.assertEqual(made(1), made(1))
        self.assertNotEqual(made(1), made(2))
        self.assertGreater(len(set(made(1))), 90)

    def test_extremes_lie_in_their_bounds(self):
        table = valid.parameters(ROCKYARD, ROOT / "scenarios/pathfinder/nominal.json")
        self.assertGreater(len(table), 300)
        rng = harness.generator(1, "valid", 0)
        for row in table:
            if row["kind"] in ("real", "angle", "integer"):
                for _ in range(20):
                    value = valid._value(row, rng)
                    self.assertGreaterEqual(value, float(row["min"] or "-inf"), row)
                    self.assertLessEqual(value, float(row["max"] or "inf"), row)

    def test_lines_know_every_subcommand_and_its_options(self):
        known = {" ".join(command.words): command for command in lines.commands(ROCKYARD)}
        for name in ("run", "sweep", "merge", "report", "plan claim", "completion"):
            self.assertIn(name, known)
        options = {name: kind for name, kind, _ in known["run"].options}
        self.assertEqual((options["--trials"], options["--json"]), ("INT", ""))
        self.assertEqual(known["compare"].places, ["RUN_A", "RUN_B"])


class Study(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def study(self, *arguments):
        with contextlib.redirect_stdout(io.StringIO()) as told:
            code = fuzz.main([*arguments, "--out", str(self.folder / "kept")])
        return code, told.getvalue()

    def broken(self, body):
        """The real command, with another end where `body` says so."""
        program = self.folder / "broken"
        program.write_text(f"#!/bin/sh\n{textwrap.dedent(body)}\nexec {ROCKYARD} \"$@\"\n", encoding="utf-8")
        program.chmod(0o755)
        return str(program)

    def test_of_each_part_finds_nothing(self):
        code, told = self.study("--rockyard", str(ROCKYARD), "--scenarios", "200", "--valid", "4", "--lines", "40")
        self.assertEqual(code, 0, told)
        self.assertIn("200 files", told)
        self.assertIn("40 lines", told)

    def test_names_the_file_that_crashes_its_batch_and_keeps_it(self):
        crash = 'if [ "$1" = validate ]; then for f in "$@"; do if [ "$f" = 7.json ]; then kill -SEGV $$; fi; done; fi'
        code, told = self.study("--rockyard", self.broken(crash), "--scenarios", "10")
        self.assertEqual(code, 1)
        self.assertIn("1 failures", told)
        self.assertIn("scenarios 7: is ended by signal 11", told)
        kept = self.folder / "kept/scenarios-1-7"
        again = scenarios.make(scenarios.sources(ROCKYARD), harness.generator(1, "scenarios", 7))
        self.assertEqual((kept / "7.json").read_bytes(), again)
        self.assertIn("--scenarios 8 --first 7", (kept / "how.txt").read_text(encoding="utf-8"))

    def test_names_the_file_of_which_nothing_is_said(self):
        silent = 'if [ "$1" = validate ]; then echo "error: 0.json: a" >&2; exit 2; fi'
        code, told = self.study("--rockyard", self.broken(silent), "--scenarios", "2")
        self.assertEqual(code, 1)
        self.assertIn("scenarios 1: is not told of", told)

    def test_names_faults_of_what_is_allowed(self):
        code, told = self.study("--rockyard", self.broken('if [ "$1" = run ]; then exit 3; fi'), "--valid", "4")
        self.assertEqual(code, 1)
        self.assertIn("multibody: ends with 3", told)
        self.assertIn("quasi_static: ends with 3", told)

    def test_counts_slow_trials_and_blames_none(self):
        slow = f'if [ "$1" = run ]; then echo "error: trial 0: {valid.SLOW}" >&2; exit 5; fi'
        code, told = self.study("--rockyard", self.broken(slow), "--valid", "4")
        self.assertEqual(code, 0, told)
        self.assertIn("slower than", told)

    def test_names_lines_that_lose_their_output_in_silence(self):
        # Line 33 writes into a full disk.
        code, told = self.study("--rockyard", self.broken("if [ -c /dev/stdout ]; then exit 5; fi"),
                                "--lines", "34", "--first", "33")
        self.assertEqual(code, 1, told)
        self.assertIn("was not lost", told)


class LongTestProgress(unittest.TestCase):
    def test_tells_what_is_done_and_left_twice_a_minute(self):
        times = iter([100.0, 110.0, 131.0, 140.0, 170.0])
        told = io.StringIO()
        with unittest.mock.patch("time.monotonic", lambda: next(times)), contextlib.redirect_stderr(told):
            progress = Progress("kills", 200)
            for done in (10, 31, 40, 50):
                progress.at(done, 1)
        # After 31 s and 31 of 200: 169 more take 169 s; after 70 s and 50 of 200: 150 more take 210 s.
        self.assertEqual(told.getvalue(), "kills: 31 of 200, 1 found, about 3 min left\n"
                                          "kills: 50 of 200, 1 found, about 4 min left\n")


if __name__ == "__main__":
    ROCKYARD = Path(sys.argv.pop(1)).resolve()
    unittest.main()
