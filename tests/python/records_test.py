#!/usr/bin/env python3
"""Records as arrays and frames: those of the store, whatever happens to the cache beside it.

Usage: records_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import csv
import json
import os
import shutil
import unittest
from pathlib import Path
from unittest import mock

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, files, navigator, raises, run, tables
from rockyard import _core

import numpy as np
import pandas

CACHE = ("records.json", "records.npy")


def stored(folder):
    """Returns the records of a store as SQLite has them: trial, outcome, detail, values."""
    return [(row[1], row[2], row[3], [np.nan if value is None else value for value in row[4:-2]]) for row in tables(folder)["trials"]]


def bits(records):
    """Returns what records are, NaN included."""
    return records.dtype.descr, records.tobytes()


class Arrays(package.PackageTest):
    def assert_are_stored(self, made, folder):
        rows = stored(folder)
        names = made.records.dtype.names
        self.assertEqual(names[:2], ("trial", "outcome"))
        self.assertEqual(len(made), len(rows))
        for record, (trial, outcome, detail, values) in zip(made.records, rows):
            self.assertEqual(record["trial"], trial)
            self.assertEqual(ry.OUTCOMES[record["outcome"]], outcome)
            np.testing.assert_array_equal([record[name] for name in names[2:]], values)
            self.assertEqual(made.trial(trial).detail, detail)
            self.assertEqual(made.trial(trial).record["outcome"], outcome)

    def test_records_are_those_of_the_store(self):
        made = run("plain", 6)
        self.assert_are_stored(made, "plain")
        self.assert_are_stored(ry.load("plain"), "plain")
        self.assertFalse(made.records.flags.writeable)
        self.assertFalse(ry.load("plain").records.flags.writeable)

    def test_records_of_faults_have_no_values(self):
        lost = navigator("lost", decide=raises(ValueError("lost")), own_values=[("n", "1", "A number.")])
        mission = PROJECT / "scenarios/mission/no_aid.json"
        made = run("faulty", 2, mission, deciders=[lost], max_fault_fraction=1)
        self.assert_are_stored(made, "faulty")
        self.assertTrue(np.isnan(made.records["cell"]).all())
        self.refusal(made.rate, "simulator_fault")
        self.assertEqual(made.rate("measured").trials, 0)
        crashed = run("crashed", 2, deciders=[lost])
        self.assert_are_stored(crashed, "crashed")
        self.assertEqual(crashed.outcomes, {"navigator_fault": 2})
        self.assertTrue(np.isnan(crashed.records["lost.n"]).all())
        self.assertEqual(crashed.rate("navigator_fault").count, 2)
        self.assertEqual((crashed.true_success.count, crashed.true_success.trials), (0, 2))

    def test_frames_say_what_their_columns_are(self):
        made = run("framed", 5)
        frame = made.trials
        with open("framed/trials.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        for name in made.units:
            unit = made.units[name]
            place = next(at for at, title in enumerate(rows[0]) if title in (name, f"{name} [{unit}]", f"{name} ({unit})"))
            told = [float(row[place]) if row[place] else np.nan for row in rows[1:]]
            np.testing.assert_array_equal(frame[name], told, name)
        self.assertEqual(list(frame.outcome), [row[rows[0].index("outcome")] for row in rows[1:]])
        self.assertEqual(list(frame.outcome.cat.categories), list(ry.OUTCOMES))
        self.assertEqual(frame.index.name, "trial")
        self.assertEqual(frame.attrs["units"]["sim_time_s"], "s")
        self.assertEqual(frame.attrs["meanings"]["true_distance_m"], "true path length")
        self.assertEqual(set(frame.attrs["units"]), set(frame.columns) - {"outcome"})
        frame.loc[0, "sim_time_s"] = -1.0  # a frame is the user's
        self.assertGreater(ry.load("framed").records["sim_time_s"][0], 0)

    def test_rates_are_those_of_the_summary(self):
        made = run("rated", 8)
        told = json.loads(Path("rated/summary.json").read_text())
        for kind in ("true_success", "declared_success"):
            rate = getattr(made, kind)
            self.assertEqual([rate.count, rate.trials, [rate.low, rate.high]], [told[kind][key] for key in ("count", "trials", "ci95")])
        self.assertEqual(made.rate("goal_reached"), made.true_success)
        self.assertEqual(made.rate("goal_reached", "false_goal"), made.declared_success)
        self.assertEqual(sum(made.outcomes.values()), 8)
        self.assertEqual({name: count for name, count in told["outcomes"].items() if count}, made.outcomes)
        self.assertIn("no outcome", str(self.refusal(made.rate, "arrived")))
        self.assertIn("Rate(", repr(made))

    def test_trials_that_are_not_stored_are_refused(self):
        made = run("few", 4, shard="2/2")
        self.assertEqual([trial.index for trial in made], [1, 3])
        for index in (0, 2, 4, 2**32 - 1):
            self.refusal(lambda: made.trial(index).record)
            self.refusal(lambda: made.trial(index).detail)
        for index in (-1, 2**32, 1.5, "0", None):
            self.refusal(made.trial, index)
        self.assertEqual(made.trial(np.int64(3)).record["trial"], 3)


class Cache(package.PackageTest):
    def setUp(self):
        shutil.rmtree("cached", ignore_errors=True)
        self.made = run("cached", 3)
        self.records = np.array(self.made.records)

    def reads(self, folder="cached"):
        """Opens the run anew, holds its records against those of the store, and returns whether it read the store."""
        with mock.patch.object(_core, "read_records", wraps=_core.read_records) as read:
            opened = ry.load(folder)
            self.assertEqual(bits(opened.records), bits(self.records))
            self.assertEqual(opened.hash, self.made.hash)
        return read.called

    def test_it_is_made_once_and_used(self):
        self.assertTrue(set(CACHE) <= set(files("cached")))
        self.assertFalse(self.reads())
        self.assertIsInstance(ry.load("cached").records, np.memmap)

    def test_it_is_made_anew_after_more_trials(self):
        self.made = run("cached", 5, resume=True)
        self.records = np.array(self.made.records)
        self.assertEqual(len(self.records), 5)
        self.assertFalse(self.reads())
        package.command_run("cached", "--resume", trials=6)
        self.assertEqual(len(ry.load("cached")), 6)
        self.assertEqual(len(self.made), 5, "what was opened stays as it was")

    def test_it_is_made_anew_for_another_run_in_the_folder(self):
        self.made = run("cached", 3, force=True, set={"terrain.rocks.k_per_m2": 0.02})
        self.assertNotEqual(bits(self.records), bits(self.made.records))
        self.records = np.array(self.made.records)
        self.assertFalse(self.reads())

    def test_it_survives_deletion(self):
        for name in (*CACHE, "both"):
            for each in CACHE if name == "both" else (name,):
                os.unlink(f"cached/{each}")
            self.assertTrue(self.reads())
            self.assertFalse(self.reads())

    def test_what_is_half_written_or_something_else_is_ignored(self):
        whole = {name: Path("cached", name).read_bytes() for name in CACHE}
        side = json.loads(whole["records.json"])
        other = np.zeros(3, self.records.dtype)
        np.save("other.npy", other)
        wrong = [("records.npy", whole["records.npy"][:-8]), ("records.npy", b""), ("records.npy", b"\x93NUMPY"),
                 ("records.npy", Path("other.npy").read_bytes()), ("records.json", whole["records.json"][:-20]), ("records.json", b""),
                 ("records.json", b"[1, 2]"), ("records.json", b"3"), ("records.json", b"null"), ("records.json", b'{"key": 3}'),
                 ("records.json", json.dumps({**side, "key": "x"}).encode()), ("records.json", b"\xff\xfe"),
                 ("records.json", json.dumps({key: side[key] for key in ("key", "hash", "sentences", "sentence")}).encode())]
        for name, content in wrong:
            with self.subTest(name=name, content=content[:40]):
                Path("cached", name).write_bytes(content)
                self.assertTrue(self.reads())
                self.assertFalse(self.reads())
        for name in CACHE:
            os.unlink(f"cached/{name}")
            os.mkdir(f"cached/{name}")
            self.assertTrue(self.reads())
            os.rmdir(f"cached/{name}")
        self.assertEqual([name for name in files("cached") if name.startswith(".")], [])

    def test_a_copy_of_the_folder_opens(self):
        shutil.copytree("cached", "copied")
        self.assertTrue(self.reads("copied"))
        self.assertFalse(self.reads("copied"))

    def test_a_damaged_store_is_refused(self):
        for name in CACHE:
            os.unlink(f"cached/{name}")
        store = Path("cached/results.sqlite")
        store.write_bytes(store.read_bytes()[:20000])
        self.refusal(lambda: ry.load("cached").records)
        self.assertFalse(set(CACHE) & set(files("cached")))

    def test_cells_have_caches_of_their_own(self):
        design = {"name": "two", "scenario": str(NOMINAL), "set": QUICK, "seed": SEED,
                  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.006]}]}
        sweep = ry.sweep(design, 2, folder="sweep")
        first = [np.array(cell.records) for cell in sweep]
        self.assertEqual(len([name for name in files("sweep") if name.startswith("records-")]), 4)
        with mock.patch.object(_core, "read_records") as read:
            for cell, records in zip(ry.load("sweep"), first):
                self.assertEqual(bits(cell.records), bits(records))
        self.assertFalse(read.called)
        self.assertEqual(ry.load("sweep").trials.shape[0], 4)
        self.refusal(ry.Run, "sweep", "no such cell")

    def test_it_can_be_read_by_whom_the_store_can(self):
        os.chmod("cached/results.sqlite", 0o644)
        os.unlink("cached/records.npy")
        self.reads()
        for name in CACHE:
            self.assertEqual(os.stat(f"cached/{name}").st_mode & 0o777, 0o644)

    @unittest.skipIf(os.geteuid() == 0 and not shutil.which("setpriv"), "no way to be another user")
    def test_a_folder_without_rights_gets_none(self):
        for name in CACHE:
            os.unlink(f"cached/{name}")
        os.chmod("cached", 0o555)
        self.addCleanup(os.chmod, "cached", 0o755)
        os.chmod(self.folder, 0o755)
        before = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if os.geteuid() == 0 else []
        told = package.python("""
            import rockyard as ry
            opened = ry.load("cached")
            print(opened.hash, len(opened.trials), opened.trial(1).trace.meta["trial"])
            """, before=before).stdout.split()
        self.assertEqual(told, [self.made.hash, "3", "1"])
        self.assertFalse(set(CACHE) & set(files("cached")))


class Frames(package.PackageTest):
    def test_traces_of_many_trials_are_one_frame(self):
        made = run("traced", 3, traces=["all"])
        frame = made.traces("position_error_m")
        self.assertEqual(list(frame.columns), ["trial", "time_s", "position_error_m"])
        for index in range(3):
            trace = made.trial(index).trace
            part = frame[frame.trial == index]
            np.testing.assert_array_equal(part.time_s, trace.time_s)
            np.testing.assert_array_equal(part.position_error_m, trace.position_error_m)
        again = run("untraced", 3)
        pandas.testing.assert_frame_equal(again.traces("position_error_m", [0, 1, 2]), frame)
        self.assertEqual(set(again.traces("speed_m_s", [1]).trial), {1})
        self.assertIn("has no traces", str(self.refusal(again.traces, "speed_m_s")))
        self.assertIn("a trace has no height", str(self.refusal(made.traces, "height")))
        self.assertEqual(len(made.traces("speed_m_s", [])), 0)

    def test_a_figure_of_each_kind_is_drawn(self):
        import matplotlib
        matplotlib.use("Agg")
        made = run("drawn", 3)
        sweep = ry.sweep({"name": "two", "scenario": str(NOMINAL), "set": QUICK, "axes": [
            {"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.006]},
            {"name": "goal", "path": "course.goal_x_m", "values": [4.0, 6.0]}]}, 2, folder="drawn_sweep")
        for number, (draw, given) in enumerate([
                (ry.plot.map, (made.trial(1),)), (ry.plot.cdf, (made,)), (ry.plot.cdf, ([made, sweep[0]], "sim_time_s")),
                (ry.plot.success, (sweep,)), (ry.plot.success, (sweep, "goal", "declared_success")), (ry.plot.outcomes, (made,)),
                (ry.plot.over_time, (made, "position_error_m", [0, 2]))]):
            axes = draw(*given)
            axes.figure.savefig(f"figure{number}.png", dpi=40)
            self.assertGreater(os.path.getsize(f"figure{number}.png"), 1000)
            self.assertTrue(axes.get_xlabel() and axes.get_ylabel())
            matplotlib.pyplot.close(axes.figure)
        self.refusal(ry.plot.cdf, made, "no_such_column")


if __name__ == "__main__":
    package.main()
