#!/usr/bin/env python3
"""Runs, sweeps, shards and merges in Python are those of the command: stores, hashes and files; each goes on with
what the other began; what is refused leaves the disk as it is.

Usage: campaigns_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import json
import os
import resource
import unittest
import warnings
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, command, command_run, derived, files, navigator, raises, run, tables

import numpy as np

DESIGN = {"name": "abundance", "trials": 2, "seed": SEED, "scenario": str(NOMINAL), "set": QUICK,
          "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.006]}]}


class Twins(package.PackageTest):
    """Each way to start a run gives the same one."""

    def assert_same(self, one, other):
        self.assertEqual(tables(one), tables(other))
        self.assertEqual(derived(one), derived(other))

    def test_a_run_is_that_of_the_command(self):
        ours = run("ours")
        command_run("theirs")
        self.assert_same("ours", "theirs")
        self.assertEqual(ours.hash, json.loads(Path("theirs/summary.json").read_text())["trial_hash"])
        self.assertEqual(ours.hash, ry.load("theirs").hash)
        for threads in (1, 2):
            self.assertEqual(run(f"on{threads}", threads=threads).hash, ours.hash)
        self.assertNotEqual(run("others", set={"terrain.rocks.k_per_m2": 0.02}).hash, ours.hash)

    def test_each_way_to_name_a_scenario_gives_the_same(self):
        whole = run("by_file")
        held = ry.Scenario(NOMINAL, set=QUICK)
        folder = ry.run("nominal", 4, SEED, set=QUICK, folder="by_name", progress=False)
        for other in (folder, ry.run(held, 4, SEED, folder="by_scenario", progress=False),
                      ry.run(whole.folder, folder="by_folder", progress=False)):
            self.assertEqual(other.hash, whole.hash)
        np.testing.assert_equal(held.run_trial(2, SEED), {**whole.trial(2).record, "detail": whole.trial(2).detail})

    def test_each_goes_on_with_what_the_other_began(self):
        whole = run("whole", 6)
        command_run("of_command", trials=3)
        self.assertEqual(run("of_command", 6, resume=True).hash, whole.hash)
        run("of_python", 3)
        command_run("of_python", "--resume", trials=6)
        for name in ("of_command", "of_python"):
            self.assertEqual(tables(name)["trials"], tables("whole")["trials"])
            self.assertEqual(derived(name), derived("whole"))
        self.assertEqual(ry.load("of_python").hash, whole.hash)

    def test_a_scenario_object_goes_on_too(self):
        held = ry.Scenario(NOMINAL, set=QUICK)
        ry.run(held, 2, SEED, folder="held", progress=False)
        self.assertEqual(ry.run(held.copy(), 4, SEED, folder="held", resume=True, progress=False).hash, run("plain").hash)

    def test_a_sweep_is_that_of_the_command(self):
        Path("sweep.json").write_text(json.dumps(DESIGN))
        command("sweep", "sweep.json", "--quiet", "--out", "sweep_theirs")
        for name, design in (("sweep_by_file", "sweep.json"), ("sweep_by_dict", DESIGN)):
            sweep = ry.sweep(design, folder=name, progress=False)
            self.assert_same(name, "sweep_theirs")
        self.assertEqual(sweep.axes, ["k_per_m2"])
        self.assertEqual([len(cell) for cell in sweep], [2, 2])
        self.assertEqual(sweep[1].hash, sweep[sweep.names[1]].hash)
        self.assertNotEqual(sweep[0].hash, sweep[1].hash)
        self.assertEqual(list(sweep.cells.k_per_m2), [0.001, 0.006])
        self.assertEqual(list(sweep.trials.k_per_m2), [0.001, 0.001, 0.006, 0.006])
        self.assertEqual(list(sweep.trials.trial), [0, 1, 0, 1])
        alone = ry.run(NOMINAL, 2, sweep[1].seed, set={**QUICK, "terrain.rocks.k_per_m2": 0.006}, folder="cell")
        self.assertEqual(sweep[1].hash, alone.hash)
        grown = ry.sweep(DESIGN, 3, folder="sweep_by_dict", resume=True, progress=False)
        self.assertEqual([len(cell) for cell in grown], [3, 3])

    def test_shards_make_the_whole(self):
        whole = run("undivided", 5)
        run("half1", 5, shard="1/2")
        command_run("half2", "--shard", "2/2", trials=5)
        merged = ry.merge([ry.load("half1"), "half2"], "merged")
        self.assertEqual(merged.hash, whole.hash)
        self.assertEqual(derived("merged"), derived("undivided"))
        refused = self.refusal(ry.merge, ["half1"], "one_alone")
        self.assertFalse(os.path.exists("one_alone"), refused)
        partial = ry.merge(["half1"], "partial", partial=True)
        self.assertEqual([trial.index for trial in partial], [0, 2, 4])

    def test_traces_and_ablations_are_those_of_the_command(self):
        run("traced", 2, traces=["all"], ablate=["perfect_localization"])
        command_run("traced_theirs", "--traces", "all", "--ablate", "perfect_localization", trials=2)
        self.assert_same("traced", "traced_theirs")
        for name in ("trial-000000.npz", "trial-000001.npz"):
            with np.load(f"traced/traces/{name}") as ours, np.load(f"traced_theirs/traces/{name}") as theirs:
                self.assertEqual(ours.files, theirs.files)
                for array in set(ours.files) - {"meta"}:
                    np.testing.assert_array_equal(ours[array], theirs[array])

    def test_a_run_goes_on_until_its_interval_is_narrow(self):
        ours = run("narrow", None, until_half_width=0.3)
        command("run", NOMINAL, "--seed", SEED, "--set", "rover.fidelity=quasi_static", "--until-half-width", 0.3, "--quiet",
                "--out", "narrow_theirs")
        self.assert_same("narrow", "narrow_theirs")
        self.assertLessEqual((ours.true_success.high - ours.true_success.low) / 2, 0.3)

    def test_a_library_runs_in_workers_as_in_the_command(self):
        library = package.PLUGINS["pathfinder_twin"]
        ours = run("library", plugins=[library])
        command_run("library_theirs", "--plugin", library)
        self.assert_same("library", "library_theirs")
        self.assertEqual(ours.hash, run("built_in").hash)
        again = ours.trial(0).trace
        self.assertEqual(again.meta["outcome"], ours.trial(0).record["outcome"])


class Folders(package.PackageTest):
    def test_a_run_that_is_there_is_refused_gone_on_with_or_set_aside(self):
        first = run("there", 2)
        before = tables("there")
        self.assertIn("there", str(self.refusal(run, "there", 2)))
        self.assertEqual(tables("there"), before)
        self.assertEqual(run("there", 2, resume=True).hash, first.hash)
        other = {"terrain.rocks.k_per_m2": 0.02}
        refused = self.refusal(run, "there", 2, resume=True, set=other)
        self.assertIn("terrain.rocks.k_per_m2", [problem.path for problem in refused.problems])
        self.assertEqual(tables("there"), before)
        self.assertNotEqual(run("there", 2, resume=True, force=True, set=other).hash, first.hash)
        self.assertTrue(os.path.exists("there/results.old-1.sqlite"))
        run("there", 2, force=True)
        self.assertEqual(tables("there"), before)
        self.assertTrue(os.path.exists("there/results.old-2.sqlite"))

    def test_the_folder_of_a_run_has_a_default(self):
        made = ry.run(NOMINAL, 1, SEED, set=QUICK, progress=False)
        self.assertEqual(made.folder, Path(f"results/runs/nominal-seed{SEED}"))
        self.assertEqual(made.name, "nominal")
        self.assertEqual(made.seed, SEED)

    def test_a_folder_without_rights_is_refused(self):
        Path("file").write_text("mine")
        for folder in ("file", "file/below", "/proc/rockyard"):
            with self.subTest(folder):
                self.assertIn("folder=", str(self.refusal(run, folder)) + "folder=")
        self.assertEqual(Path("file").read_text(), "mine")

    @unittest.skipIf(os.geteuid() == 0 and not os.path.exists("/usr/bin/setpriv"), "no way to be another user")
    def test_a_folder_of_another_user_is_refused(self):
        os.mkdir("locked")
        os.chmod("locked", 0o555)
        os.chmod(self.folder, 0o755)
        told = as_nobody("""
            import sys, rockyard as ry
            try:
                ry.run(sys.argv[1], 1, folder="locked/run", progress=False)
            except (ry.InputError, ry.MachineError) as error:
                print(type(error).__name__, error)
            """, NOMINAL)
        self.assertRegex(told, "^(InputError|MachineError) locked")
        self.assertEqual(files("locked"), [])


def as_nobody(program, *words):
    """Runs a program as a user without rights and returns what it printed."""
    before = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.geteuid() == 0 else []
    return package.python(program, *words, before=before).stdout


class Refusals(package.PackageTest):
    def test_what_is_wrong_is_told_by_path_all_at_once(self):
        wrong = {"terrain.rocks.k_per_m2": -1, "rover.geometry.wheel_radius": 0.1, "referee.time_limit_s": "long"}
        refused = self.refusal(ry.run, NOMINAL, 2, set=wrong, folder="wrong", progress=False)
        paths = [problem.path for problem in refused.problems]
        for path in wrong:
            self.assertIn(path, paths)
        for problem in refused.problems:
            self.assertTrue(problem.reason)
            self.assertIn(problem.path, str(refused))
        self.assertFalse(os.path.exists("wrong"))

    def test_nothing_is_written_for_what_is_refused(self):
        missing = {"name": "missing", "scenario": str(NOMINAL), "axes": [{"path": "terrain.nothing", "values": [1, 2]}]}
        calls = [
            lambda: ry.run("no_such_scenario", folder="x"),
            lambda: ry.run(NOMINAL, 0, folder="x"),
            lambda: ry.run(NOMINAL, -3, folder="x"),
            lambda: ry.run(NOMINAL, 2, -1, folder="x"),
            lambda: ry.run(NOMINAL, 2, shard="3/2", folder="x"),
            lambda: ry.run(NOMINAL, 2, shard="half", folder="x"),
            lambda: ry.run(NOMINAL, 2, ablate=["gravity"], folder="x"),
            lambda: ry.run(NOMINAL, 2, traces=["some"], folder="x"),
            lambda: ry.run(NOMINAL, 2, until_half_width=0.1, shard="1/2", folder="x"),
            lambda: ry.run(NOMINAL, 2, plugins=["libmissing.so"], folder="x"),
            lambda: ry.run(NOMINAL, 2, plugins=[{"process": "python3 missing.py"}], folder="x"),
            lambda: ry.run(NOMINAL, 2, set={"terrain.rocks.k_per_m2": float("nan")}, folder="x"),
            lambda: ry.run(NOMINAL, 2, set={"terrain.rocks.k_per_m2": object()}, folder="x"),
            lambda: ry.run(NOMINAL, 2, deciders=[navigator()()], folder="x"),
            lambda: ry.sweep(missing, folder="x"),
            lambda: ry.sweep({"name": "no_axes"}, folder="x"),
            lambda: ry.sweep({"name": "odd", "axes": object()}, folder="x"),
            lambda: ry.sweep("no_such_sweep", folder="x"),
            lambda: ry.merge(["nowhere"], "x"),
            lambda: ry.merge([], "x"),
            lambda: ry.load("nowhere"),
            lambda: ry.Scenario("no_such_scenario"),
        ]
        os.mkdir("empty")
        os.chdir("empty")
        self.addCleanup(os.chdir, "..")
        for number, call in enumerate(calls):
            with self.subTest(number=number):
                self.refusal(call)
                self.assertEqual(files("."), [])

    def test_errors_are_values_and_can_be_sent(self):
        import pickle
        refused = self.refusal(ry.Scenario, NOMINAL, {"trials": -1})
        self.assertIsInstance(refused, ValueError)
        made = run("sent", 1)
        for error in (refused, self.refusal(lambda: made.trial(0).trace["height"]), ry.TooManyFaults(refused.problems, made)):
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((again.problems, str(again)), (error.problems, str(error)))
            self.assertIn(type(again), type(error).__mro__)

    def test_warnings_are_those_of_the_command(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run("doubtful", 1, set={"energy.battery_wh": 5})
        told = command_run("doubtful_theirs", "--set", "energy.battery_wh=5", trials=1).stderr
        for warning in caught:
            self.assertEqual(Path(warning.filename).name, "package.py")
        self.assertIn("5 Wh are little", str(caught[0].message))
        self.assertIn("5 Wh are little", told)


class Faults(package.PackageTest):
    def test_too_many_faults_open_the_run(self):
        """A mission takes a navigator that throws for a fault of the simulator."""
        lost = navigator("lost", decide=raises(ValueError("lost its way")))
        with self.assertRaises(ry.TooManyFaults) as raised:
            run("faulty", 2, PROJECT / "scenarios/mission/no_aid.json", deciders=[lost])
        error = raised.exception
        self.assertIn("2 of 2 trials ended in a simulator fault", str(error))
        self.assertEqual(error.problems[0].path, "faulty")
        self.assertEqual(error.run.outcomes, {"simulator_fault": 2})
        self.assertEqual(len(error.run.trials), 2)
        self.assertEqual(error.run.rate("goal_reached").trials, 0)
        self.assertIn("navigator_fault", error.run.trial(0).detail)
        allowed = run("allowed", 2, PROJECT / "scenarios/mission/no_aid.json", deciders=[lost], max_fault_fraction=1.0)
        self.assertEqual(allowed.hash, error.run.hash)

    def full_disk(self, size, folder):
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
        try:
            with self.assertRaises(ry.MachineError) as raised:
                run(folder, 3000)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        return raised.exception

    def test_a_full_disk_is_no_input_error(self):
        error = self.full_disk(150000, "full")
        self.assertIn("full/results.sqlite", error.problems[0].path)
        stored = len(error.run)
        again = run("full", stored + 2, resume=True)
        self.assertEqual(again.hash, run("undisturbed", stored + 2).hash)

    def test_a_disk_that_was_full_at_once_leaves_no_run(self):
        error = self.full_disk(4096, "nothing")
        self.assertIsNone(error.run)
        self.assertTrue(error.problems)


class Comparisons(package.PackageTest):
    def test_check_and_compare_are_those_of_the_command(self):
        first, second = run("first", 6), run("second", 6, set={"terrain.rocks.k_per_m2": 0.02})
        compared = ry.compare(first, "second")
        told = json.loads(command("compare", "first", "second", "--json").stdout)
        self.assertEqual(compared.json["comparison"], told["comparison"])
        self.assertEqual(compared.pairs, 6)
        self.assertEqual(len(compared.successes), 2)
        self.assertIn("true_distance_m", set(compared.differences.name))
        ry.write_baseline([first], "baseline.json", "mine", "of a test")
        self.assertTrue(ry.check(first, "baseline.json").agrees)
        self.assertIn("terrain.rocks.k_per_m2", str(self.refusal(ry.check, second, "baseline.json")))
        self.assertGreater(len(ry.check([first], "baseline.json").rows), 3)
        self.refusal(ry.write_baseline, [first], "another.json", "mine", "")
        self.refusal(ry.check, first, "missing.json")
        self.refusal(ry.compare, first, "nowhere")

    def test_pages_are_written(self):
        made = run("paged", 2)
        self.assertIn("<html", made.report(replays=0).read_text(encoding="utf-8")[:1000].lower())
        self.assertTrue(made.trial(1).replay().is_file())
        both = ry.report([made, run("paged_too", 2)], "both.html", replays=0, title="two runs")
        self.assertIn("two runs", both.read_text(encoding="utf-8"))
        self.refusal(ry.report, [made], "nowhere/below/page.html")


if __name__ == "__main__":
    package.main()
