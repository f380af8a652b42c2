"""What the tests of plugins share: the command, the plugins of CMakeLists.txt here, and short runs.

Usage of a test: TEST ROCKYARD PROJECT PLUGIN... [unittest's arguments]
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PLUGIN_COUNT = 10
ROCKYARD, PROJECT = (Path(word).resolve() for word in sys.argv[1:3])
PLUGINS = {Path(word).stem.removeprefix("lib"): Path(word).resolve() for word in sys.argv[3:3 + PLUGIN_COUNT]}
NOMINAL = PROJECT / "scenarios/pathfinder/nominal.json"
QUICK = ("--set", "rover.fidelity=quasi_static")
TRIALS = 8


class PluginTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.built_in = cls.run_hash("built_in", ())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def command(cls, words, before=(), ends=0):
        done = subprocess.run([*before, ROCKYARD, *map(str, words)], cwd=cls.folder, capture_output=True, text=True,
                              timeout=240, check=False)
        if done.returncode != ends:
            raise AssertionError(f"{words}: exit code {done.returncode}: {done.stderr}{done.stdout[-500:]}")
        return done

    @classmethod
    def run_hash(cls, name, more, before=(), trials=TRIALS):
        cls.command(["run", NOMINAL, "--trials", trials, *QUICK, "--quiet", "--out", name, *more], before)
        return cls.hash_of(name)

    @classmethod
    def hash_of(cls, name):
        return json.loads((cls.folder / name / "summary.json").read_text())["trial_hash"]

    def plugin_hash(self, name):
        scenario = json.loads((self.folder / name / "scenario.resolved.json").read_text())["scenario"]
        return scenario["plugins"][0]["hash"]


def main():
    unittest.main(argv=[sys.argv[0], *sys.argv[3 + PLUGIN_COUNT:]])
