"""The study of damaged stores: its verdicts, its damages, and a short run of it."""

import contextlib
import io
import random
import shutil
import sqlite3
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/long"))
import damage as damages  # noqa: E402
from damage import Answer, judge  # noqa: E402

ROCKYARD = Path(sys.argv.pop(1)).resolve()
RIGHT = Answer(0, "success 83 %", "", {"trials.csv": b"1,2"})
NAMED = "error: run/results.sqlite: is damaged: table trials"


class Verdicts(unittest.TestCase):
    def test_the_right_result_is_the_same_bits(self):
        self.assertEqual(judge(RIGHT, Answer(0, "success 83 %", "a note", {"trials.csv": b"1,2"})), "same")

    def test_an_error_that_names_the_store_is_right(self):
        self.assertEqual(judge(RIGHT, Answer(2, "", NAMED)), "refused")

    def test_everything_else_is_a_fault(self):
        for found, fault in (
                (Answer(0, "success 100 %", "", RIGHT.files), "other result"),
                (Answer(0, RIGHT.out, "", {"trials.csv": b"1,3"}), "other result"),
                (Answer(0, RIGHT.out, ""), "other result"),
                (Answer(1, RIGHT.out, "", RIGHT.files), "other result"),
                (Answer(4, RIGHT.out, "", RIGHT.files), "other result"),
                (Answer(2, "", "error: something is wrong"), "file not named"),
                (Answer(2, "success", NAMED), "half a result"),
                (Answer(2, "", NAMED, {"trials.csv": b""}), "half a result"),
                (Answer(5, "", NAMED), "exit code"),
                (Answer(2, "", NAMED + ": map::at"), "raw message"),
                (Answer(-11), "crash"),
                (Answer(134), "crash"),
                (Answer(None), "hang")):
            with self.subTest(found=found):
                self.assertEqual(judge(RIGHT, found), fault)
                self.assertIn(fault, damages.FAULTS)


class Study(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.bases = damages.prepare(ROCKYARD, cls.folder / "whole")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_every_damage_changes_stores(self):
        for name, damage in damages.DAMAGES.items():
            changed = 0
            for seed in range(16):  # most sectors hold the schema, which is that of every store
                copy = self.folder / "copy.sqlite"
                shutil.copy(self.bases[0].folder / damages.STORE, copy)
                before = copy.read_bytes()
                damage(copy, random.Random(seed), self.bases[0])
                changed += copy.read_bytes() != before
            self.assertGreaterEqual(changed, 2, name)  # a foreign page may be the same

    def test_the_same_seed_does_the_same_damage(self):
        contents = []
        for _ in range(2):
            copy = self.folder / "copy.sqlite"
            shutil.copy(self.bases[0].folder / damages.STORE, copy)
            damages.edit_value(copy, random.Random(3), self.bases[0])
            with contextlib.closing(sqlite3.connect(copy)) as data:
                contents.append(list(data.iterdump()))
        self.assertEqual(contents[0], contents[1])

    def test_each_damage_is_refused_or_harmless(self):
        for number, damage in enumerate(damages.DAMAGES):
            base = self.bases[number % len(self.bases)]
            verdicts = damages.attempt(ROCKYARD, base, damage, number, self.folder / f"{number}")
            for command, (verdict, found) in verdicts.items():
                self.assertIn(verdict, ("same", "refused"), f"{base.name}, {damage}, {command}: {found}")

    def test_the_command_prints_both_tables_and_counts_every_answer(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), mock.patch.object(damages, "prepare", lambda *_, **__: self.bases):
            code = damages.main(["--stores", "2", "--rockyard", str(ROCKYARD)])
        self.assertEqual(code, 0, out.getvalue())
        lines = [line.split() for line in out.getvalue().splitlines()]
        totals = [line[1:] for line in lines if line[:1] == ["all"]]
        self.assertEqual(len(totals), 2)
        self.assertEqual(totals[0], totals[1])
        self.assertGreaterEqual(sum(map(int, totals[0])), 2)


if __name__ == "__main__":
    unittest.main()
