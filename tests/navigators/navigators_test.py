#!/usr/bin/env python3
"""The command drives with plugins and processes: the same records however an algorithm comes in, on threads, ranks,
shards and after an interruption; another plugin under the same name is refused, with both hashes.

Usage: navigators_test.py ROCKYARD PROJECT PLUGIN... [unittest's arguments]     (the plugins of CMakeLists.txt here)
"""

import contextlib
import csv
import json
import os
import shutil
import signal
import sqlite3
import subprocess
import time

import plugin_drives
from plugin_drives import NOMINAL, PLUGINS, PROJECT, QUICK, ROCKYARD, TRIALS

IMAGES = PROJECT / "scenarios/gestalt/abundance_images.json"
SMALL = ("--set", "sensors.stereo.columns=48", "--set", "sensors.stereo.rows=40",
         "--set", "sensors.stereo.images.pyramid_level=1")
EXAMPLES = PROJECT / "examples/navigators"


class Drives(plugin_drives.PluginTest):
    def twin(self):
        return ("--plugin", PLUGINS["pathfinder_twin"])

    def process(self):
        return ("--navigator-process", f"python3 {EXAMPLES / 'arc_planner.py'}")

    def times(self, name):
        with open(self.folder / name / "navigator_times.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_plugin_drives_as_the_same_sources_built_in(self):
        for threads in (1, 2):
            self.assertEqual(self.run_hash(f"twin{threads}", (*self.twin(), "--threads", threads)), self.built_in)

    def test_the_program_shows_a_plugin_nothing_of_its_own(self):
        """The wall: a library finds no function of rockyard in the program that loads it, the world's least of all."""
        def defined(file, dynamic):
            symbols = subprocess.run(["nm", "--defined-only", "-C", *dynamic, file], capture_output=True, text=True,
                                     check=True).stdout
            return [line for line in symbols.splitlines() if " rockyard::" in line]
        self.assertEqual(defined(ROCKYARD, ["-D"]), [])
        self.assertTrue(any("rockyard::terrain::" in line for line in defined(ROCKYARD, [])))

    def test_shards_of_a_plugin_make_the_whole(self):
        shards = [f"shard{i}" for i in (1, 2)]
        for i, shard in enumerate(shards, 1):
            self.command(["run", NOMINAL, "--trials", TRIALS, *QUICK, "--quiet", "--out", shard, *self.twin(),
                          "--shard", f"{i}/2"])
        self.command(["merge", *shards, "--out", "merged"])
        self.assertEqual(self.hash_of("merged"), self.built_in)

    def test_ranks_drive_with_a_plugin_and_with_a_process(self):
        mpirun = shutil.which("mpirun")
        if mpirun is None or b"libmpi" not in subprocess.run(["ldd", ROCKYARD], capture_output=True, check=True).stdout:
            self.assertIsNone(mpirun, "the program was built without MPI, which is there")
            return
        before = (mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2")
        self.assertEqual(self.run_hash("ranks", self.twin(), before), self.built_in)
        alone = self.run_hash("processes", self.process(), trials=4)
        self.assertEqual(self.run_hash("ranks_of_processes", self.process(), before, trials=4), alone)

    @staticmethod
    def stored(store):
        try:
            with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as database:
                return database.execute("SELECT count(*) FROM trials").fetchone()[0]
        except sqlite3.OperationalError:  # not there yet
            return 0

    def test_a_killed_campaign_goes_on_to_the_same(self):
        for name, trials, navigator in (("plugin", 150, self.twin()), ("process", 20, self.process())):
            words = ["run", NOMINAL, "--trials", trials, *QUICK, "--quiet", "--out", f"killed_{name}", *navigator]
            started = subprocess.Popen([ROCKYARD, *map(str, words)], cwd=self.folder, start_new_session=True)
            store = self.folder / f"killed_{name}/results.sqlite"
            while self.stored(store) == 0 and started.poll() is None:
                time.sleep(0.02)
            os.killpg(started.pid, signal.SIGKILL)
            started.wait()
            self.assertTrue(0 < self.stored(store) < trials, "it was killed while it ran")
            self.command([*words, "--resume"])
            undisturbed = self.run_hash(f"undisturbed_{name}", navigator, trials=trials)
            self.assertEqual(self.hash_of(f"killed_{name}"), undisturbed)

    def test_what_a_navigator_took_stands_beside_the_records(self):
        for name, navigator in (("timed", self.twin()), ("timed_process", self.process())):
            self.run_hash(name, navigator, trials=3)
            rows = self.times(name)
            self.assertEqual(sorted(row["trial"] for row in rows), ["0", "1", "2"])
            for row in rows:
                self.assertGreater(int(row["questions"]), 10)
                self.assertGreater(float(row["wall_s"]), 0)
                self.assertLessEqual(float(row["longest_s"]), float(row["wall_s"]))
        self.command(["run", NOMINAL, "--trials", 5, *QUICK, "--quiet", "--out", "timed", *self.twin(), "--resume"])
        self.assertEqual(len(self.times("timed")), 5)
        self.assertFalse((self.folder / "built_in/navigator_times.csv").exists())

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

    def test_a_run_that_a_plugin_does_not_decide_needs_none(self):
        """Nor does a rebuilt plugin, whose own values its records have columns for."""
        library = self.folder / "libother_arc.so"
        shutil.copy(PLUGINS["arc_planner"], library)
        self.run_hash("not_chosen", ("--plugin", library, "--set", "navigation.navigator=pathfinder"))
        library.unlink()
        self.command(["trace", "not_chosen", "--trial", 0])
        told = self.command(["report", "not_chosen", "--tracks", 3, "--data", "page.json"])
        for word in ("error", "left out", "no trial", "no replay"):
            self.assertNotIn(word, told.stderr)
        page = json.loads((self.folder / "page.json").read_text())
        self.assertGreaterEqual(page["runs"][0]["first_tracks"], 3)
        self.assertTrue(list((self.folder / "not_chosen/report_replays").glob("*.html")))

    def test_a_report_says_what_it_does_not_drive_again(self):
        sweep = {"name": "kinds", "trials": 3, "set": {"rover.fidelity": "quasi_static"}, "scenario": str(NOMINAL),
                 "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.002]},
                          {"path": "navigation.navigator", "values": ["pathfinder", "arc_planner"]}]}
        (self.folder / "kinds.json").write_text(json.dumps(sweep))
        self.command(["sweep", "kinds.json", "--plugin", PLUGINS["arc_planner"], "--quiet", "--out", "kinds"])
        self.assertEqual({row["cell"] for row in self.times("kinds")}, {"k_per_m2=0.002,navigator=arc_planner"})
        told = self.command(["report", "kinds"])
        self.assertIn("trials in which a plugin decides get no replay (--plugins lets them)", told.stderr)
        self.assertNotIn("get no replay", self.command(["report", "kinds", "--plugins", "--replays", 1]).stderr)

    def test_what_a_navigator_says_as_it_fails_is_told(self):
        shutil.copy(EXAMPLES / "rockyard_navigator.py", self.folder)
        (self.folder / "lost.py").write_text(
            "from rockyard_navigator import Navigator, drive, parameter, run\n"
            "class Lost(Navigator):\n"
            "    name = 'lost'\n"
            "    parameters = [parameter('goal_tolerance_m', 'real', 0.3, 'arrives within', min=0, max=5)]\n"
            "    def decide(self, input):\n"
            "        if input.estimate.distance_m > 1: return drive(self.p.boldness)\n"
            "        if input.estimate.distance_m < 0.5: return drive(until_distance_m=0.6)\n"
            "run(Lost)\n")
        told = self.command(["run", NOMINAL, "--trials", 3, *QUICK, "--navigator-process", "python3 lost.py",
                             "--out", "lost"]).stdout
        self.assertIn("navigator_fault", told)
        self.assertIn("trial 0: stopped because its navigator reported an error: TypeError: decide() returned None", told)
        values = "from rockyard_navigator import Parameters; Parameters(step_m=1).boldness"
        failed = subprocess.run(["python3", "-c", values], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertIn("no parameter boldness is declared: there are step_m", failed.stderr)

    def test_a_navigator_that_waits_for_nothing_fails(self):
        shutil.copy(EXAMPLES / "rockyard_navigator.py", self.folder)
        (self.folder / "waits.py").write_text(
            "from rockyard_navigator import Navigator, parameter, run\n"
            "class Waits(Navigator):\n"
            "    name = 'waits'\n"
            "    parameters = [parameter('goal_tolerance_m', 'real', 0.3, 'arrives within', min=0, max=5)]\n"
            "    def decide(self, input): return {}\n"
            "run(Waits)\n")
        self.command(["run", NOMINAL, "--trials", 1, *QUICK, "--navigator-process", "python3 waits.py", "--quiet",
                      "--out", "waits"])
        with open(self.folder / "waits/trials.csv", newline="", encoding="utf-8") as file:
            row = next(csv.DictReader(file))
        self.assertEqual((row["outcome"], row["cause"]), ("navigator_fault", "navigator_nonsense"))
        self.assertIn("more decisions than its time has", row["detail"])

    def test_examples_drive_and_count(self):
        for name in ("a_star", "arc_planner", "bug2", "potential_field"):
            self.run_hash(name, ("--plugin", PLUGINS[name]))
            with open(self.folder / name / "trials.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            own = [key for key in rows[0] if key.startswith(name + ".")]
            self.assertTrue(own)
            self.assertNotIn("navigator_fault", {row["outcome"] for row in rows})
            self.assertTrue(any(float(row[key]) > 0 for row in rows for key in own), own)
        told = ("--set", "course.site_map.kind=rocks", "--set", "course.site_map.cell_m=0.2")
        self.assertNotEqual(self.run_hash("a_star_map", ("--plugin", PLUGINS["a_star"], *told)), self.hash_of("a_star"))

    def photographed(self, name, more):
        """Returns own values and hash of drives of the navigator that tells what images it gets."""
        self.command(["run", IMAGES, "--trials", 2, *QUICK, *SMALL, "--quiet", "--out", name, *more])
        with open(self.folder / name / "trials.csv", newline="", encoding="utf-8") as file:
            rows = [{key.split(".")[1].split(" ")[0]: float(value) for key, value in row.items()
                     if key.startswith("photographer.")} for row in csv.DictReader(file)]
        return rows, self.hash_of(name)

    def test_plugin_and_process_get_the_same_images(self):
        rows, by_plugin = self.photographed("images_in_cpp", ("--plugin", PLUGINS["photographer"]))
        command = f"python3 {PROJECT / 'tests/navigators/photographer.py'}"
        in_python, by_process = self.photographed("images_in_python", ("--navigator-process", command))
        self.assertEqual(rows, in_python)
        self.assertEqual(by_plugin, by_process)
        for row in rows:
            self.assertEqual((row["images"], row["numbers"], row["behind"], row["others"]), (3, 3, 1, 0))
            self.assertNotEqual(row["left"], row["right"])
            self.assertNotEqual(row["left_camera"], row["right_camera"])
        self.assertNotEqual(rows[0]["left"], rows[1]["left"], "trials have noise of their own")

    def test_images_without_cameras_are_refused(self):
        told = self.command(["run", NOMINAL, "--plugin", PLUGINS["photographer"], "--out", "blind"], ends=2)
        self.assertIn("sensors.terrain_sensor: is light_stripe, which takes no images", told.stderr)

    def test_a_reader_of_a_plugin_reads_the_looks(self):
        """GESTALT drives by what it makes of the images, and its failure is none of the simulator."""
        def drive(name, *more):
            self.command(["run", IMAGES, "--trials", 1, *QUICK, *SMALL, "--quiet", "--out", name, *more])
            with open(self.folder / name / "trials.csv", newline="", encoding="utf-8") as file:
                return self.hash_of(name), next(csv.DictReader(file))
        faulty = ("--plugin", PLUGINS["readers"], "--set", "navigation.navigator=gestalt",
                  "--set", "perception.reader=faulty", "--set")
        own, _ = drive("own_reader")
        one_point, read = drive("one_point", *faulty, "perception.faulty.way=0")
        self.assertNotEqual(read["outcome"], "navigator_fault")
        self.assertNotEqual(one_point, own)
        _, threw = drive("reader_threw", *faulty, "perception.faulty.way=1")
        self.assertEqual(threw["outcome"], "navigator_fault")
        self.assertIn("reader faulty: it rains", threw["detail"])
        self.command(["trace", "one_point", "--trial", 0])
        sweep = {"name": "ways", "trials": 1, "scenario": str(IMAGES),
                 "set": dict(word.split("=") for word in (*QUICK, *SMALL) if "=" in word),
                 "axes": [{"path": "perception.reader", "values": ["stereo", "faulty"]},
                          {"path": "perception.faulty.way", "values": [0, 4]}]}
        sweep["set"] = {path: json.loads(value) if value.isdigit() else value for path, value in sweep["set"].items()}
        (self.folder / "ways.json").write_text(json.dumps(sweep))
        self.command(["sweep", "ways.json", "--plugin", PLUGINS["readers"], "--set", "navigation.navigator=gestalt",
                      "--quiet", "--out", "ways"])
        self.command(["report", "ways", "--replays", 0])
        self.command(["parameters", "--plugin", PLUGINS["photographer"], "--search", "photographer"])

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
    plugin_drives.main()
