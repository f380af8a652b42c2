#!/usr/bin/env python3
"""The command drives with plugins and processes: the same records however an algorithm comes in, on threads, ranks,
shards and after an interruption; another plugin under the same name is refused, with both hashes.

Usage: navigators_test.py ROCKYARD PROJECT PLUGIN... [unittest's arguments]     (the plugins of CMakeLists.txt here)
"""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROCKYARD, PROJECT = (Path(word).resolve() for word in sys.argv[1:3])
PLUGINS = {Path(word).stem.removeprefix("lib"): Path(word).resolve() for word in sys.argv[3:7]}
NOMINAL = PROJECT / "scenarios/pathfinder/nominal.json"
EXAMPLES = PROJECT / "examples/navigators"
QUICK = ("--set", "rover.fidelity=quasi_static")
TRIALS = 8


class Drives(unittest.TestCase):
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

    def twin(self):
        return ("--plugin", PLUGINS["pathfinder_twin"])

    def test_a_plugin_drives_as_the_same_sources_built_in(self):
        for threads in (1, 2):
            self.assertEqual(self.run_hash(f"twin{threads}", (*self.twin(), "--threads", threads)), self.built_in)

    def test_shards_of_a_plugin_make_the_whole(self):
        shards = [f"shard{i}" for i in (1, 2)]
        for i, shard in enumerate(shards, 1):
            self.command(["run", NOMINAL, "--trials", TRIALS, *QUICK, "--quiet", "--out", shard, *self.twin(),
                          "--shard", f"{i}/2"])
        self.command(["merge", *shards, "--out", "merged"])
        self.assertEqual(self.hash_of("merged"), self.built_in)

    def test_ranks_drive_with_a_plugin(self):
        mpirun = shutil.which("mpirun")
        if mpirun is None or b"libmpi" not in subprocess.run(["ldd", ROCKYARD], capture_output=True, check=True).stdout:
            self.assertIsNone(mpirun, "the program was built without MPI, which is there")
            return
        before = (mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2")
        self.assertEqual(self.run_hash("ranks", self.twin(), before), self.built_in)

    def test_a_killed_campaign_goes_on_to_the_same(self):
        words = ["run", NOMINAL, "--trials", 60, *QUICK, "--quiet", "--out", "killed", *self.twin()]
        started = subprocess.Popen([ROCKYARD, *map(str, words)], cwd=self.folder, start_new_session=True)
        time.sleep(1.0)
        os.killpg(started.pid, signal.SIGKILL)
        started.wait()
        self.command([*words, "--resume"] if (self.folder / "killed/results.sqlite").exists() else words)
        self.command(["run", NOMINAL, "--trials", 60, *QUICK, "--quiet", "--out", "undisturbed"])
        self.assertEqual(self.hash_of("killed"), self.hash_of("undisturbed"))

    def test_cpp_and_python_decide_the_same(self):
        plugin = self.run_hash("in_cpp", ("--plugin", PLUGINS["arc_planner"]), trials=3)
        command = f"python3 {EXAMPLES / 'arc_planner.py'}"
        self.assertEqual(self.run_hash("in_python", ("--navigator-process", command), trials=3), plugin)
        self.assertNotEqual(self.run_hash("three", (), trials=3), plugin)

    def test_another_plugin_is_refused_with_both_hashes(self):
        library = self.folder / "libmine.so"
        run = ["run", NOMINAL, *QUICK, "--quiet", "--plugin", library]
        shutil.copy(PLUGINS["pathfinder_twin"], library)
        self.command([*run, "--trials", 2, "--out", "mine"])
        self.command([*run, "--trials", 4, "--out", "half1", "--shard", "1/2"])
        library.unlink()
        library.write_bytes(PLUGINS["pathfinder_twin"].read_bytes() + b"\0")
        self.command([*run, "--trials", 4, "--out", "half2", "--shard", "2/2"])
        former, now = (self.plugin_hash(name) for name in ("mine", "half2"))
        self.assertNotEqual(former, now)
        resumed = self.command([*run, "--trials", 4, "--out", "mine", "--resume"], ends=2)
        merged = self.command(["merge", "half1", "half2", "--out", "both"], ends=2)
        replayed = self.command(["replay", "mine", "--trial", 0, "--out", "page.html"], ends=2)
        for told in (resumed, merged, replayed):
            self.assertIn(former, told.stderr)
            self.assertIn(now, told.stderr)

    def plugin_hash(self, name):
        scenario = json.loads((self.folder / name / "scenario.resolved.json").read_text())["scenario"]
        return scenario["plugins"][0]["hash"]

    def test_reading_results_runs_no_plugin(self):
        """A library that is gone is not missed by who reads what it drove."""
        library = self.folder / "libgone.so"
        shutil.copy(PLUGINS["pathfinder_twin"], library)
        self.run_hash("gone", ("--plugin", library))
        library.unlink()
        self.command(["compare", "built_in", "gone"])
        self.command(["report", "gone"])
        told = self.command(["replay", "gone", "--trial", 0, "--out", "page.html"], ends=2)
        self.assertIn("libgone.so", told.stderr)

    def test_examples_drive_and_count(self):
        for name in ("arc_planner", "bug2", "potential_field"):
            self.run_hash(name, ("--plugin", PLUGINS[name]))
            with open(self.folder / name / "trials.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            own = [key for key in rows[0] if key.startswith(name + ".")]
            self.assertTrue(own)
            self.assertNotIn("navigator_fault", {row["outcome"] for row in rows})
            self.assertTrue(any(float(row[key]) > 0 for row in rows for key in own), own)

    def test_a_sweep_varies_a_plugins_parameter(self):
        sweep = {"name": "steps", "trials": 2, "set": {"rover.fidelity": "quasi_static"}, "scenario": str(NOMINAL),
                 "axes": [{"path": "navigation.arc_planner.step_m", "values": [0.3, 0.6]}]}
        (self.folder / "sweep.json").write_text(json.dumps(sweep))
        self.command(["sweep", "sweep.json", "--plugin", PLUGINS["arc_planner"], "--quiet", "--out", "swept"])
        self.command(["report", "swept", "--replays", 0])

    def test_a_plugin_of_another_compiler_and_standard_library_decides_the_same(self):
        clang = next(filter(None, map(shutil.which, ("clang++", "clang++-14", "clang++-15", "clang++-16"))), None)
        self.assertIsNotNone(clang, "clang++ is not there: scripts/install_dependencies.sh test")
        library = self.folder / "libother.so"
        headers = [f"-I{PROJECT / 'src'}", "-I/usr/include/eigen3"]
        subprocess.run([clang, "-stdlib=libc++", "-std=c++20", "-O2", "-ffp-contract=off", "-shared", "-fPIC", *headers,
                        EXAMPLES / "arc_planner.cc", "-o", library], check=True)
        self.assertIn(b"libc++", subprocess.run(["ldd", library], capture_output=True, check=True).stdout)
        ours = self.run_hash("by_gcc", ("--plugin", PLUGINS["arc_planner"]), trials=3)
        self.assertEqual(self.run_hash("by_clang", ("--plugin", library), trials=3), ours)

    def test_an_unknown_parameter_is_told_with_its_path(self):
        told = self.command(["run", NOMINAL, *self.twin(), "--set", "navigation.pathfinder_twin.scan_intervall_m=1",
                             "--out", "unknown"], ends=2)
        self.assertIn("navigation.pathfinder_twin.scan_intervall_m", told.stderr)
        self.assertIn("scan_interval_m", told.stderr)
        self.assertFalse((self.folder / "unknown").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[7:]])
