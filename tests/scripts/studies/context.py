"""Where tests of studies find them, and runs made by hand.

All: `python3 -m unittest discover -s tests/scripts/studies -p "*_test.py"`, with BUILD/python in PYTHONPATH.
"""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "scripts/studies"), str(ROOT / "scripts"), str(ROOT / "tests/scripts")]

import numpy as np  # noqa: E402
import pandas  # noqa: E402
import study  # noqa: E402
from study import ry  # noqa: E402


def frame(rows):
    """Trials as a study gets them: rows are dictionaries, `trial` is their number where they do not say it."""
    return pandas.DataFrame([{"trial": number} | row for number, row in enumerate(rows)])


def run_of(rows, folder="run", **summary):
    """A run without a store: rows are dictionaries with `outcome` and columns."""
    names = [name for name in rows[0] if name not in ("trial", "outcome")]
    run = object.__new__(ry.runs.Run)
    run.folder, run.cell, run._deciders = Path(folder), "", ()
    run._head = {"name": run.folder.name, "scenario": "", "seed": 1, "columns": [(name, "", "") for name in names]}
    trials = frame(rows)
    records = ry.records.structured(trials.trial, [ry.OUTCOMES.index(each) for each in trials.outcome],
                                    trials[names].to_numpy(float), names)
    run.__dict__.update(_read=ry.records.Told(records, "", ["as planted"], [0] * len(records)), summary=summary)
    return run


class Done(SimpleNamespace):
    """What a script in this process came to: code, out and err."""


class StudyTest(unittest.TestCase):
    """Scripts in this process, whose commands are noted and not given, and leave `rows` in every run folder."""

    rows = [{"outcome": "no_path", "x": 0.0}]
    summary = {"provenance": {"version": "0.1.0", "commit": "abc"}, "causes": {"gave_up": 1}}

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.calls = []

    def rows_of(self, folder):
        """Of a run: overridden where they differ."""
        del folder
        return self.rows

    def answer(self, words):
        """Exit code and output of a command: overridden where they matter."""
        if "--out" in words:
            Path(words[words.index("--out") + 1]).mkdir(parents=True, exist_ok=True)
        return 0, ""

    def called(self, command, codes=(0,)):
        words = [str(word) for word in command]
        self.calls.append(" ".join(words))
        code, out = self.answer(words)
        if code not in codes:
            sys.exit(f"exit code {code}")
        return SimpleNamespace(returncode=code, stdout=out)

    def commands(self, name):
        """The words after the program of the commands of this name."""
        return [line.split(" ", 1)[1] for line in self.calls if line.split()[1] == name]

    def script(self, module, *words, code=0):
        out, err = io.StringIO(), io.StringIO()
        open_run = lambda folder: run_of(self.rows_of(str(folder)), folder, **self.summary)
        with (mock.patch.object(study, "called", self.called), mock.patch.object(ry, "Run", open_run),
              mock.patch.object(sys, "argv", [module.__name__, *map(str, words)]),
              contextlib.redirect_stdout(out), contextlib.redirect_stderr(err)):
            try:
                found = module.main() or 0
            except SystemExit as end:
                found = end.code if isinstance(end.code, int) else 1
                print(end, file=err)
        self.assertEqual(found, code, err.getvalue())
        return Done(out=out.getvalue(), err=err.getvalue())

    def lines(self, name):
        return (self.root / name).read_text(encoding="utf-8").splitlines()


__all__ = ["Done", "ROOT", "StudyTest", "frame", "np", "run_of", "study"]
