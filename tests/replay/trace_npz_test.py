#!/usr/bin/env python3
"""Reads traces with NumPy and holds them against the CSV of the same drive.

Usage: trace_npz_test.py ROCKYARD SCENARIOS     ROCKYARD: the command; SCENARIOS: the project's folder
Exit code 0: the arrays are as src/report/README.md says; 1: they are not, or NumPy is missing.
"""

import base64
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy
except ImportError:
    sys.exit("NumPy is missing: scripts/install_dependencies.sh test")

ROCKYARD, SCENARIOS = Path(sys.argv[1]), Path(sys.argv[2])


def trace(folder, scenario, *more):
    """Arrays and CSV rows of trial 2 of a scenario."""
    files = [folder / "trace.npz", folder / "trace.csv"]
    subprocess.run([ROCKYARD, "trace", SCENARIOS / scenario, "--trial", "2", "--npz", files[0],
                    "--csv", files[1], *more], check=True, stdout=subprocess.DEVNULL)
    with files[1].open(encoding="utf-8") as text:
        rows = list(csv.DictReader(text))
    with numpy.load(files[0], allow_pickle=False) as arrays:
        return {name: arrays[name] for name in arrays.files}, rows


class StripeTrace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.arrays, cls.rows = trace(Path(folder), "pathfinder/nominal.json")
        cls.meta = json.loads(str(cls.arrays["meta"]))
        cls.record = dict(zip(cls.arrays["record_names"].tolist(), cls.arrays["record"].tolist()))

    def test_meta(self):
        self.assertEqual((self.meta["format"], self.meta["version"]), ("rockyard trace", 1))
        self.assertEqual((self.meta["trial"], self.meta["seed"]), (2, "1"))
        self.assertEqual(len(self.meta["record_hash"]), 16)
        self.assertEqual(self.meta["outcome"], "goal_reached")

    def test_last_moment_is_that_of_the_record(self):
        self.assertEqual(self.arrays["time_s"][-1], self.record["sim_time_s"])
        self.assertEqual(self.arrays["position_m"][-1, 0], self.record["final_x_m"])
        self.assertEqual(self.arrays["position_m"][-1, 1], self.record["final_y_m"])
        self.assertEqual(self.arrays["heading_rad"][-1], self.record["final_heading_rad"])
        self.assertEqual(self.arrays["believed"][-1, 0], self.record["believed_x_m"])

    def test_every_sample_of_the_csv_is_there(self):
        samples = [row for row in self.rows if row["row"] == "sample"]
        driving = numpy.isin(self.arrays["activity"], ["drive", "turn", "steer"])
        self.assertEqual(int(driving.sum()), len(samples))
        x = numpy.array([float(row["true_x_m"]) for row in samples])
        numpy.testing.assert_array_equal(self.arrays["position_m"][driving, 0], x)
        tilt = numpy.array([float(row["tilt_rad"]) for row in samples])
        numpy.testing.assert_array_equal(self.arrays["tilt_rad"][driving], tilt)

    def test_every_event_of_the_csv_is_there(self):
        events = [row for row in self.rows if row["row"] == "event"]
        self.assertEqual(self.arrays["event_kind"].tolist(), [row["kind"] for row in events])
        self.assertEqual(self.arrays["event_detail"].tolist(), [row["detail"] for row in events])

    def test_times_ascend_and_attitudes_are_rotations(self):
        self.assertTrue((numpy.diff(self.arrays["time_s"]) >= 0).all())
        norms = numpy.linalg.norm(self.arrays["attitude_wxyz"], axis=1)
        numpy.testing.assert_allclose(norms, 1.0, atol=1e-12)
        self.assertEqual(int(self.arrays["set_back"].sum()), int(self.record["reflections"]))

    def test_scans(self):
        scans = int(self.record["scans"])
        self.assertEqual(self.arrays["scan_hazards"].shape, (scans, 5))
        self.assertEqual(self.arrays["scan_hazards"].dtype, numpy.bool_)
        points = self.arrays["scan_points"]
        self.assertTrue((points[:, 0] < scans).all() and (points[:, 4] < 5).all())
        self.assertEqual(self.arrays["map_goodness"].shape, (0, 0, 0))

    def test_its_navigator_shows_nothing(self):
        shapes = {name: array.shape for name, array in self.arrays.items() if name.startswith("overlay_")}
        self.assertEqual(shapes, {"overlay_time_s": (0,), "overlay_pose": (0, 3), "overlay_believed": (0, 3),
                                  "overlay_line": (0,), "overlay_line_name": (0,), "overlay_points": (0, 3),
                                  "overlay_grid": (0, 6), "overlay_grid_name": (0,), "overlay_values": (0,)})


class MapTrace(unittest.TestCase):
    def test_maps_and_votes(self):
        with tempfile.TemporaryDirectory() as folder:
            arrays, _ = trace(Path(folder), "gestalt/narrow_course.json", "--set", "referee.time_limit_s=600")
        steps = len(arrays["step_time_s"])
        self.assertGreater(steps, 3)
        self.assertEqual(arrays["map_elevation_m"].shape, arrays["map_goodness"].shape)
        self.assertEqual(arrays["map_goodness"].shape[0], steps)
        known = arrays["map_goodness"] >= 0
        self.assertTrue(known.any() and (arrays["map_goodness"][known] <= 255).all())
        chosen = arrays["vote_step"][arrays["vote_chosen"]]
        numpy.testing.assert_array_equal(chosen, numpy.arange(steps))
        self.assertEqual(set(arrays["vote_kind"].tolist()), {"forward", "backward", "turn"})
        self.assertEqual(arrays["scan_points"].shape, (0, 6))
        self.assertEqual(arrays["spline"].shape, (0, 4))

    def test_splines(self):
        with tempfile.TemporaryDirectory() as folder:
            arrays, _ = trace(Path(folder), "continuous/csad.json", "--set", "referee.time_limit_s=120")
        steps = len(arrays["step_time_s"])
        numpy.testing.assert_array_equal(numpy.bincount(arrays["spline_step"], minlength=steps),
                                         numpy.full(steps, 225))
        self.assertEqual(arrays["spline_start"].shape, (steps, 3))
        # All splines of a step begin at one curvature; knots lie within 1 rad/m (Howard 2012).
        splines = arrays["spline"].reshape(steps, 225, 4)
        self.assertTrue((numpy.ptp(splines[:, :, 0], axis=1) == 0).all())
        self.assertEqual(numpy.abs(splines[:, :, 1:3]).max(), 1.0)
        self.assertTrue((splines[:, :, 3] == 3.0).all())
        votes = arrays["spline_vote"]
        self.assertEqual(votes.shape, (steps * 225, 4))
        self.assertTrue((votes >= 0).all() and (votes <= 255).all())
        chosen = arrays["spline_chosen"]
        self.assertGreater(int(chosen.sum()), steps // 2)
        self.assertEqual(numpy.bincount(arrays["spline_step"][chosen]).max(), 1)
        self.assertTrue(arrays["spline_feasible"][chosen].all())


# Drives straight on and shows, with each decision, a way to where it stands and what it knows.
SHOWING = """
import json, os, struct

def read(size):
    data = b""
    while len(data) < size:
        piece = os.read(3, size - len(data))
        if not piece:
            raise SystemExit
        data += piece
    return data

decisions = 0
while True:
    request = json.loads(read(struct.unpack("<I", read(4))[0]))
    answer = {}
    if request["type"] == "describe":
        answer = {"protocol": 1, "name": "showing", "doc": "shows", "version": "1", "parameters": [], "own_values": []}
    if request["type"] == "traits":
        answer = {"reads": "nothing", "goal_tolerance": {"parameter": "goal_tolerance_m", "value_m": 0.1}}
    if request["type"] == "decide":
        x = request["estimate"]["x_m"]
        decisions += 1
        answer = {"status": "gave_up" if decisions > 3 else "driving", "motion": {"kind": "arc"}, "until": {"period_s": 2}}
    if request["type"] == "overlay":
        answer = {"lines": [{"name": "way", "points": [[0, 0.25], [x, 0.5]]}, {"name": "end", "points": []}],
                  "grids": [{"name": "known", "x0_m": x, "y0_m": -1, "step_m": 0.5, "nx": 2, "ny": 1, "values": [0.125, None]}]}
        if decisions == 3:
            answer = {"lines": [], "grids": []}
    text = json.dumps(answer).encode()
    os.write(4, struct.pack("<I", len(text)) + text)
"""


class OverlayTrace(unittest.TestCase):
    def test_lines_and_grids(self):
        script = base64.b64encode(SHOWING.encode()).decode()
        command = f"{sys.executable} -c \"import base64;exec(base64.b64decode('{script}'))\""
        plugins = json.dumps([{"process": command}])
        with tempfile.TemporaryDirectory() as folder:
            arrays, _ = trace(Path(folder), "pathfinder/nominal.json", "--set", f"plugins={plugins}",
                              "--set", "navigation.navigator=showing")
        # Shown at three of four decisions; at the third nothing any more, and at the last again.
        self.assertEqual(json.loads(str(arrays["meta"]))["overlay_every"], 1)
        self.assertEqual(len(arrays["overlay_time_s"]), 4)
        self.assertTrue((numpy.diff(arrays["overlay_time_s"]) > 0.0).all())
        numpy.testing.assert_array_equal(arrays["overlay_line"], [0, 0, 1, 1, 3, 3])
        self.assertEqual(arrays["overlay_line_name"].tolist(), ["way", "end"] * 3)
        x = arrays["overlay_believed"][[0, 1, 3], 0]
        self.assertTrue((numpy.diff(x) > 0).all())
        # Each at the end of the moment before its decision, with every digit.
        moments = numpy.searchsorted(arrays["time_s"], arrays["overlay_time_s"], side="right") - 1
        numpy.testing.assert_array_equal(arrays["overlay_time_s"], arrays["time_s"][moments])
        numpy.testing.assert_array_equal(arrays["overlay_pose"][:, :2], arrays["position_m"][moments, :2])
        numpy.testing.assert_array_equal(arrays["overlay_believed"], arrays["believed"][moments, :3])
        numpy.testing.assert_array_equal(arrays["overlay_points"], [[0, 0, 0.25], [0, x[0], 0.5], [2, 0, 0.25],
                                                                    [2, x[1], 0.5], [4, 0, 0.25], [4, x[2], 0.5]])
        numpy.testing.assert_array_equal(arrays["overlay_grid"], [[i, x_m, -1, 0.5, 2, 1] for i, x_m in zip((0, 1, 3), x)])
        self.assertEqual(arrays["overlay_grid_name"].tolist(), ["known"] * 3)
        numpy.testing.assert_array_equal(arrays["overlay_values"], [0.125, numpy.nan] * 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
