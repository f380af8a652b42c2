#!/usr/bin/env python3
"""The command drives with estimators of plugins: dead reckoning gives the same records built in and as a plugin; own
values are columns; one that fails ends its drive as a fault that names it.

Usage: estimators_test.py ROCKYARD PROJECT PLUGIN... [unittest's arguments]     (the plugins of CMakeLists.txt here)
"""

import csv
import json
import shutil

import plugin_drives
from plugin_drives import NOMINAL, PLUGINS, QUICK

TWIN, COUNTING, BOTH = (PLUGINS[f"estimators_{name}"] for name in ("dead_reckoning_twin", "counting", "both"))


def fails(how, tick=100):
    return ("--set", "localization.estimator=counting", "--set", f"localization.counting.fault={how}", "--set", f"localization.counting.at_tick={tick}")


class Drives(plugin_drives.PluginTest):
    def rows(self, name):
        with open(self.folder / name / "trials.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_dead_reckoning_as_a_plugin_is_that_built_in(self):
        for threads in (1, 2):
            twin = self.run_hash(f"twin{threads}", ("--plugin", TWIN, "--threads", threads))
            self.assertEqual(twin, self.built_in)
            scenario = json.loads((self.folder / f"twin{threads}/scenario.resolved.json").read_text())["scenario"]
            self.assertEqual(scenario["localization"]["estimator"], "dead_reckoning_twin")

    def test_none_of_several_is_chosen(self):
        self.run_hash("unchosen", ("--plugin", BOTH))
        scenario = json.loads((self.folder / "unchosen/scenario.resolved.json").read_text())["scenario"]
        self.assertEqual(scenario["localization"]["estimator"], "dead_reckoning")
        self.assertIn("counting.ticks", self.rows("unchosen")[0])

    def test_one_that_is_all_that_a_plugin_holds_is_chosen_and_counts(self):
        self.run_hash("counting", ("--plugin", COUNTING))
        scenario = json.loads((self.folder / "counting/scenario.resolved.json").read_text())["scenario"]
        self.assertEqual(scenario["localization"]["estimator"], "counting")
        self.assertEqual(scenario["navigation"]["navigator"], "pathfinder")
        for counted, own in zip(self.rows("counting"), self.rows("built_in"), strict=True):
            self.assertGreater(float(counted.pop("counting.ticks")), 100)
            self.assertEqual(counted, own)
        means = json.loads((self.folder / "counting/summary.json").read_text())["metrics"]
        self.assertGreater(means["counting.ticks"]["mean"], 100)

    def test_a_navigator_and_an_estimator_of_two_plugins_drive_together(self):
        self.run_hash("both", ("--plugin", PLUGINS["pathfinder_twin"], "--plugin", COUNTING))
        for counted, own in zip(self.rows("both"), self.rows("built_in"), strict=True):
            self.assertGreater(float(counted.pop("counting.ticks")), 100)
            self.assertEqual(counted, own)

    def test_a_sweep_varies_its_parameter(self):
        sweep = {"name": "scales", "trials": 2, "set": {"rover.fidelity": "quasi_static"}, "scenario": str(NOMINAL),
                 "axes": [{"path": "localization.counting.scale", "values": [0.9, 1.1]}]}
        (self.folder / "sweep.json").write_text(json.dumps(sweep))
        self.command(["sweep", "sweep.json", "--plugin", COUNTING, "--quiet", "--out", "swept"])
        self.command(["report", "swept", "--replays", 0])

    def test_its_parameters_are_listed_and_checked(self):
        listed = self.command(["parameters", "--plugin", COUNTING, "--search", "localization.counting"])
        self.assertIn("localization.counting.scale", listed.stdout)
        schema = json.loads(self.command(["schema", "--plugin", COUNTING]).stdout)
        group = schema["properties"]["localization"]["properties"]
        self.assertIn("counting", group["estimator"]["enum"])
        self.assertEqual(group["counting"]["properties"]["scale"]["maximum"], 2)
        told = self.command(["run", NOMINAL, "--plugin", COUNTING, "--set", "localization.counting.scale=3",
                             "--out", "refused"], ends=2)
        self.assertIn("localization.counting.scale", told.stderr)
        aided = self.command(["run", NOMINAL, "--plugin", COUNTING, "--set", "sensors.aids.sun.enabled=true",
                              "--out", "refused"], ends=2)
        self.assertIn("takes no fixes", aided.stderr)
        self.assertFalse((self.folder / "refused").exists())

    def test_another_plugin_is_refused_with_both_hashes(self):
        library = self.folder / "libmine.so"
        run = ["run", NOMINAL, *QUICK, "--quiet", "--plugin", library, "--out", "mine"]
        shutil.copy(COUNTING, library)
        self.command([*run, "--trials", 2])
        former = self.plugin_hash("mine")
        library.unlink()
        library.write_bytes(COUNTING.read_bytes() + b"\0")
        told = self.command([*run, "--trials", 4, "--resume"], ends=2)
        self.assertIn(former, told.stderr)

    def test_reading_results_runs_no_plugin(self):
        library = self.folder / "libgone.so"
        shutil.copy(COUNTING, library)
        self.run_hash("gone", ("--plugin", library))
        library.unlink()
        self.assertIn("counting.ticks", self.command(["compare", "built_in", "gone"]).stdout)
        self.command(["report", "gone"])
        told = self.command(["replay", "gone", "--trial", 0, "--out", "page.html"], ends=2)
        self.assertIn("libgone.so", told.stderr)

    def test_a_replay_and_a_trace_drive_it_again(self):
        self.run_hash("again", ("--plugin", COUNTING), trials=1)
        self.command(["replay", "again", "--trial", 0, "--out", "again.html"])
        self.assertTrue((self.folder / "again.html").exists())
        self.assertIn("bit for bit", self.command(["trace", "again", "--trial", 0]).stdout)

    def test_a_failing_one_ends_its_drives_and_is_named(self):
        ways = {"throws": ("navigator_threw", "estimator counting: lost its way"),
                "no_number": ("navigator_nonsense", "estimator counting: pose.heading_rad is nan")}
        for how, (cause, words) in ways.items():
            with self.subTest(how):
                self.run_hash(how, ("--plugin", BOTH, *fails(how)), trials=2)
                for row in self.rows(how):
                    self.assertEqual((row["outcome"], row["cause"]), ("navigator_fault", cause))
                    self.assertIn(words, row["detail"])
                    self.assertEqual(row["counting.ticks"], "", "own values of a failed drive are none")
                    self.assertGreater(float(row["sim_time_s"]), 0.0)

    def test_one_that_crashes_or_hangs_costs_its_trials_alone(self):
        for how, more, cause in (("crashes", (), "navigator_crashed"),
                                 ("hangs", ("--trial-cpu-limit", 2), "navigator_cpu_time")):
            with self.subTest(how):
                self.run_hash(how, ("--plugin", BOTH, *fails(how), *more), trials=1)
                self.assertEqual([row["cause"] for row in self.rows(how)], [cause])

    def test_one_that_fails_late_fails_where_it_does(self):
        self.run_hash("late", ("--plugin", BOTH, *fails("throws", 500)), trials=2)
        times = [float(row["sim_time_s"]) for row in self.rows("late")]
        self.run_hash("early", ("--plugin", BOTH, *fails("throws", 50)), trials=2)
        for late, early in zip(times, self.rows("early"), strict=True):
            self.assertGreater(late, float(early["sim_time_s"]))


if __name__ == "__main__":
    plugin_drives.main()
