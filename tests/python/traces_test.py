#!/usr/bin/env python3
"""Traces of trials: the arrays of the npz, what follows from them, frames of events and hazards, and trajectories as
another reader of the TUM format finds them.

Usage: traces_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import csv
import math
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, command, run

import numpy as np

GESTALT = PROJECT / "scenarios/gestalt/abundance_rocky_3_2.json"
FEW_POINTS = {"sensors.stereo.columns": 64, "sensors.stereo.rows": 48}


def tum(path):
    """Reads a trajectory as the format says it: time, x, y, z, then the quaternion x, y, z, w. Returns times, positions
    and rotation matrices by Rodrigues' formula, R = I + 2 w [v] + 2 [v]^2 (not the module's own way)."""
    times, places, turns = [], [], []
    for line in Path(path).read_text(encoding="ascii").splitlines():
        time, x, y, z, *quaternion = map(float, line.split(" "))
        assert len(quaternion) == 4, line
        v, w = np.array(quaternion[:3]), quaternion[3]
        cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        times.append(time)
        places.append((x, y, z))
        turns.append(np.eye(3) + 2 * w * cross + 2 * cross @ cross)
    return np.array(times), np.array(places), np.array(turns)


class Traces(package.PackageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = run("run", 4, traces=["share:0.5"])
        cls.stored = [int(file.stem[-6:]) for file in cls.made.stored_traces]

    def test_a_trace_is_driven_again_where_none_is_stored(self):
        self.assertTrue(0 < len(self.stored) < 4)
        for index in range(4):
            trace = self.made.trial(index).trace
            self.assertEqual(trace.meta["trial"], index)
            self.assertEqual(trace.meta["outcome"], self.made.trial(index).record["outcome"])
            record = dict(zip(trace.record_names, trace.record))
            np.testing.assert_equal(record, {name: value for name, value in self.made.trial(index).record.items()
                                             if name not in ("trial", "outcome", "detail")})
        Path("npz").mkdir()
        command("trace", "run", "--trial", self.stored[0], "--npz", "npz/one.npz")
        with np.load("npz/one.npz") as theirs:
            ours = self.made.trial(self.stored[0]).trace
            for name in set(theirs.files) - {"meta"}:
                np.testing.assert_array_equal(ours[name], theirs[name], name)

    def test_what_follows_agrees_with_the_record(self):
        for index in range(4):
            trial = self.made.trial(index)
            trace, record = trial.trace, trial.record
            self.assertAlmostEqual(trace.position_error_m[-1], record["position_error_m"], 12)
            self.assertAlmostEqual(math.degrees(abs(trace.heading_error_rad[-1])), abs(record["heading_error_deg"]), 9)
            self.assertEqual(tuple(trace.position_m[-1][:2]), (record["final_x_m"], record["final_y_m"]))
            self.assertEqual(trace.time_s[-1], record["sim_time_s"])
            way = np.linalg.norm(np.diff(trace.position_m[:, :2], axis=0), axis=1)
            # Samples also see the rover shift while it turns in place, of which one of these trials does a hundred times.
            shifts = 0.03 if record["turns_in_place"] < 50 else 0.06
            self.assertAlmostEqual(way[trace.set_back[1:] == 0].sum() / record["true_distance_m"], 1.0, delta=shifts)
            self.assertLess(np.nanmax(trace.speed_m_s), 1.0)
            self.assertEqual(len(trace.speed_m_s), len(trace.time_s))

    def test_a_rover_that_is_set_back_has_no_speed_meanwhile(self):
        for index in range(40):
            trace = self.made.trial(index).trace
            jumps = np.flatnonzero(trace.set_back)
            if len(jumps):
                break
        self.assertTrue(len(jumps))
        self.assertEqual(list(trace.speed_m_s[jumps]), [0.0] * len(jumps))
        self.assertTrue(set(trace.events.kind) & {"mirrored", "reflection", "pose_update", "reflected"}, set(trace.events.kind))

    def test_it_is_a_mapping(self):
        trace = self.made.trial(0).trace
        self.assertEqual(len(list(trace)), len(trace))
        self.assertTrue({"time_s", "position_m", "speed_m_s"} <= set(trace))
        self.assertTrue({"time_s", "speed_m_s", "events"} <= set(dir(trace)))
        self.assertIs(type(trace["time_s"]), np.ndarray)
        self.assertIn("position_m", trace)
        self.assertNotIn("height", trace)
        self.assertIsNone(trace.get("height"))
        with self.assertRaisesRegex(AttributeError, "a trace has no height: there are position_error_m"):
            trace.height
        with self.assertRaises(AttributeError):
            trace._private

    def test_events_and_hazards_are_frames(self):
        trial = self.made.trial(1)
        trace = trial.trace
        self.assertEqual(list(trace.events.columns), ["time_s", "x_m", "y_m", "heading_rad", "kind", "detail"])
        self.assertEqual(len(trial.events), len(trace["event_time_s"]))
        self.assertTrue(trace.events.time_s.is_monotonic_increasing)
        command("trace", "run", "--trial", 1, "--csv", "trial.csv")
        with open("trial.csv", encoding="utf-8", newline="") as file:
            told = [row for row in csv.DictReader(file) if row["row"] == "event"]
        self.assertEqual(list(zip(trace.events.time_s, trace.events.kind, trace.events.x_m, trace.events.detail)),
                         [(float(row["time_s"]), row["kind"], float(row["true_x_m"]), row["detail"]) for row in told])
        hazards = trace.hazards
        self.assertEqual(len(hazards), int(trace["scan_hazards"].any(axis=1).sum()))
        self.assertGreater(len(hazards), 0)
        self.assertTrue(hazards[[name for name in hazards if name.startswith("stripe_")]].any(axis=1).all())

    def test_the_pose_at_a_time_is_that_of_the_last_moment(self):
        trace = self.made.trial(0).trace
        at = len(trace.time_s) // 2
        while trace.time_s[at] == trace.time_s[at + 1]:
            at += 1
        expected = (*trace.position_m[at][:2], trace.heading_rad[at])
        for time_s in (trace.time_s[at], (trace.time_s[at] + trace.time_s[at + 1]) / 2):
            self.assertEqual(trace.pose_at(time_s), expected)
        self.assertEqual(trace.pose_at(-1.0)[:2], tuple(trace.position_m[0][:2]))
        self.assertEqual(trace.pose_at(1e9)[:2], tuple(trace.position_m[-1][:2]))

    def test_a_trajectory_is_read_by_others(self):
        for index in (0, 1):
            trial = self.made.trial(index)
            trace = trial.trace
            trial.tum(f"true{index}.tum")
            times, places, turns = tum(f"true{index}.tum")
            self.assertTrue((np.diff(times) > 0).all())
            self.assertEqual(list(times), sorted(set(trace.time_s)))
            last = np.searchsorted(trace.time_s, times, side="right") - 1  # of moments at one time
            np.testing.assert_array_equal(places, trace.position_m[last])
            np.testing.assert_allclose(turns @ turns.transpose(0, 2, 1), np.broadcast_to(np.eye(3), turns.shape), atol=1e-12)
            # R's x axis points along the heading, and its z axis is tilted by the tilt.
            headings = np.arctan2(turns[:, 1, 0], turns[:, 0, 0])
            off = np.abs(np.remainder(headings - trace.heading_rad[last] + np.pi, 2 * np.pi) - np.pi)
            self.assertLess(off.max(), 1e-9)
            np.testing.assert_allclose(np.arccos(np.clip(turns[:, 2, 2], -1, 1)), trace.tilt_rad[last], atol=1e-6)
            self.assertGreater(trace.tilt_rad.max(), 0.02)
            trial.tum(f"believed{index}.tum", believed=True)
            times, places, turns = tum(f"believed{index}.tum")
            np.testing.assert_array_equal(places[:, :2], trace.believed[last][:, :2])
            self.assertEqual(set(places[:, 2]), {0.0})
            np.testing.assert_allclose(turns[:, 0, 0], np.cos(trace.believed[last][:, 2]), atol=1e-12)
            np.testing.assert_allclose(turns[:, 1, 0], np.sin(trace.believed[last][:, 2]), atol=1e-12)
        with self.assertRaises(FileExistsError):
            self.made.trial(0).tum("true0.tum")

    def test_a_map_stands_where_the_rover_took_it(self):
        made = run("mapped", 1, GESTALT, set=FEW_POINTS)
        trace = made.trial(0).trace
        steps = len(trace.step_time_s)
        self.assertGreater(steps, 3)
        shown = trace.map_at(steps - 1)
        ny, nx = shown["elevation_m"].shape
        self.assertEqual((len(shown["x_m"]), len(shown["y_m"])), (nx, ny))
        known = shown["certainty"] >= 0
        np.testing.assert_array_equal(known, shown["goodness"] >= 0)
        self.assertTrue(0.02 < known.mean() < 0.9 and 0.02 < np.isfinite(shown["elevation_m"]).mean() < 0.9)
        self.assertLess(np.nanmax(np.abs(shown["elevation_m"])), 2.0)
        at = trace.step_believed[steps - 1]
        self.assertTrue(shown["x_m"][0] < at[0] < shown["x_m"][-1] and shown["y_m"][0] < at[1] < shown["y_m"][-1])
        self.assertEqual(len(trace.hazards), 0)

    def test_traces_of_cells_are_told_apart(self):
        design = {"name": "two", "scenario": str(NOMINAL), "set": QUICK, "seed": SEED,
                  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.006]}]}
        sweep = ry.sweep(design, 2, folder="sweep", traces=["all"])
        for cell in sweep:
            self.assertEqual(len(cell.stored_traces), 2)
            trace = cell.trial(1).trace
            self.assertEqual(trace.meta["cell"], cell.cell)
            self.assertEqual(trace.position_m[-1][0], cell.trial(1).record["final_x_m"])
        first = ry.sweep(design, 2, folder="bare")[1]
        self.assertEqual(first.trial(1).trace.position_m[-1][0], first.trial(1).record["final_x_m"])

    def test_a_record_that_does_not_repeat_is_told(self):
        import contextlib
        import sqlite3
        run("changed", 1)
        opened = ry.load("changed")
        with contextlib.closing(sqlite3.connect("changed/results.sqlite")) as store, store:
            store.execute("UPDATE trials SET true_distance_m = 1.0")
        self.assertIn("damaged", str(self.refusal(lambda: opened.trial(0).trace)))

    def test_a_trace_of_what_is_no_drive_is_refused(self):
        made = run("mission", 1, PROJECT / "scenarios/mission/no_aid.json")
        self.assertIn("is no drive", str(self.refusal(lambda: made.trial(0).trace)))


if __name__ == "__main__":
    package.main()
