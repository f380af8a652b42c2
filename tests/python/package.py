"""What the tests of the package share: where things are, short runs, and programs in processes of their own.

Usage of a test: TEST ROCKYARD PLUGINS [unittest's arguments]
PLUGINS: the files of the libraries that tests drive with, with commas between them.
"""

import contextlib
import csv
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

import rockyard as ry
from rockyard.navigator import drive, parameter

PROJECT = Path(__file__).resolve().parents[2]
ROCKYARD, PLUGIN_FILES = sys.argv[1:3] if len(sys.argv) > 2 else ("rockyard", "")  # imported by a program of a test
PLUGINS = {Path(word).stem.removeprefix("lib"): Path(word).resolve() for word in PLUGIN_FILES.split(",")}
NOMINAL = PROJECT / "scenarios/pathfinder/nominal.json"
EXAMPLES = PROJECT / "examples/navigators"
QUICK = {"rover.fidelity": "quasi_static"}
SEED = 7
TOLERANCE = parameter("goal_tolerance_m", "real", 0.3, "arrives within", min=0, max=5)


class PackageTest(unittest.TestCase):
    """Works in a folder of its own, which is the current one meanwhile."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="rockyard-python-"))
        cls.former = os.getcwd()
        os.chdir(cls.folder)

    @classmethod
    def tearDownClass(cls):
        os.chdir(cls.former)
        shutil.rmtree(cls.folder)

    def refusal(self, call, *given, **more):
        """Returns the InputError of a call."""
        with self.assertRaises(ry.InputError) as raised:
            call(*given, **more)
        self.assertTrue(raised.exception.problems)
        return raised.exception


def run(folder, trials=4, scenario=NOMINAL, **more):
    """Runs quick trials into a folder."""
    more["set"] = {**QUICK, **more.get("set", {})}
    return ry.run(scenario, trials, SEED, folder=folder, progress=False, **more)


# How a record tells the cause of a fault (truth/end_cause.h).
CAUSES = {"threw": "reported an error: ", "message": "answered with no right message: ", "nonsense": "decided what cannot be done: "}


def fault(*deciders, scenario=NOMINAL, **more):
    """Returns why the first trial with these deciders ended as a fault, or its outcome."""
    record = ry.Scenario(scenario, set={**QUICK, **more}, deciders=deciders).run_trial(0, SEED)
    return record["detail"] if record["outcome"] == "navigator_fault" else record["outcome"]


def command(*words, ends=0, **more):
    """Runs the command and returns what it did."""
    done = subprocess.run([ROCKYARD, *map(str, words)], capture_output=True, text=True, timeout=240, check=False, **more)
    if done.returncode != ends:
        raise AssertionError(f"{words}: exit code {done.returncode}: {done.stderr}{done.stdout[-500:]}")
    return done


def command_run(folder, *words, trials=4, ends=0):
    return command("run", NOMINAL, "--trials", trials, "--seed", SEED, "--set", "rover.fidelity=quasi_static", "--quiet",
                   "--out", folder, *words, ends=ends)


def python(program, *words, ends=0, timeout=120, before=(), **more):
    """Runs a program in a process of its own and returns what it did; `ends`: its exit code, or None for any."""
    done = subprocess.run([*before, sys.executable, "-c", textwrap.dedent(program), *map(str, words)], capture_output=True,
                          text=True, timeout=timeout, check=False, **more)
    if ends is not None and done.returncode != ends:
        raise AssertionError(f"exit code {done.returncode}: {done.stderr}\n{done.stdout}")
    return done


def tables(folder):
    """Returns all that a store holds, table by table."""
    with contextlib.closing(sqlite3.connect(f"file:{Path(folder) / 'results.sqlite'}?mode=ro", uri=True)) as store:
        names = [name for name, in store.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        return {name: store.execute(f"SELECT * FROM {name} ORDER BY 1, 2").fetchall() for name in names}


def derived(folder):
    """Returns the files that follow from a store, but those that the package keeps for itself."""
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()
            if path.is_file() and not path.name.startswith(("results.", "records", "navigator_times"))}


def rows(folder):
    """Returns the rows of trials.csv."""
    with open(Path(folder) / "trials.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def files(folder):
    """Returns the names of all that is below a folder."""
    return sorted(str(path.relative_to(folder)) for path in Path(folder).rglob("*"))


def navigator(name="mine", base=ry.Navigator, **members):
    """Returns a class of navigators that drives straight ahead, but for what is given."""
    return type("Mine", (base,), {"name": name, "doc": "of a test", "parameters": [TOLERANCE],
                                  "decide": lambda self, seen: drive(until_distance_m=0.5), **members})


def raises(error):
    """Returns a function that raises such an error, another one each time."""
    def function(*_given):
        raise type(error)(*error.args)
    return function


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
