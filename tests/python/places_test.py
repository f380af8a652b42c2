#!/usr/bin/env python3
"""Terrain and images as arrays: those that the command writes.

Usage: places_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import csv
import math
import struct
import zlib
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, command, run

import numpy as np

STEREO = PROJECT / "scenarios/gestalt/abundance_images.json"
SMALL = {"sensors.stereo.columns": 48, "sensors.stereo.rows": 40, "sensors.stereo.images.pyramid_level": 1}


def png(path):
    """Reads a grey PNG of 8 bits by its specification (ISO/IEC 15948)."""
    data = Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, bits, colour, *_ = struct.unpack(">IIBBBBB", data[at + 8:at + 8 + size])
            assert (bits, colour) == (8, 0)
        elif kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, width + 1)
    image = np.zeros((height, width), np.uint8)
    for row, (how, *line) in enumerate(lines.tolist()):
        above = image[row - 1].tolist() if row else [0] * width
        made = []
        for column, value in enumerate(line):
            left = made[-1] if column else 0
            up, corner = above[column], above[column - 1] if column else 0
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda each: abs(guess - each))
            made.append((value + (0, left, up, (left + up) // 2, paeth)[how]) & 255)
        image[row] = made
    return image


def pfm(path):
    """Reads a grey PFM: rows from the bottom, the sign of the scale says the order of bytes."""
    header, size, scale, data = Path(path).read_bytes().split(b"\n", 3)
    assert header == b"Pf"
    width, height = map(int, size.split())
    return np.frombuffer(data, "<f4" if float(scale) < 0 else ">f4").reshape(height, width)[::-1]


class Places(package.PackageTest):
    def test_rocks_are_those_that_the_command_writes(self):
        for scenario, trial, seed in ((NOMINAL, 2, SEED), (STEREO, 0, 3)):
            rocks = ry.Place(ry.Scenario(scenario), trial, seed).rocks
            command("terrain", scenario, "--trial", trial, "--seed", seed, "--out", f"{scenario.stem}.csv")
            with open(f"{scenario.stem}.csv", encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rocks), len(rows))
            self.assertGreater(len(rocks), 10)
            names = {"x_m": "center_x_m", "y_m": "center_y_m", "z_m": "center_z_m"}
            for name in rocks.dtype.names:
                if name == "yaw_rad":
                    np.testing.assert_allclose(rocks[name], [math.radians(float(row["yaw_deg"])) for row in rows], rtol=1e-14, atol=1e-14)
                else:
                    np.testing.assert_array_equal(rocks[name], [float(row[names.get(name, name)]) for row in rows], name)

    def test_heights_are_those_of_ground_and_rocks(self):
        place = ry.Place(ry.Scenario(NOMINAL), 2, SEED)
        for rock in place.rocks[:20]:
            top = place.height(rock["x_m"], rock["y_m"])
            ground = place._core.ground(rock["x_m"], rock["y_m"])
            self.assertEqual(top.shape, ())
            self.assertAlmostEqual(float(top - ground), rock["height_m"], 9)
        x_m, y_m = np.array([[0.0, 0.1], [0.2, 0.3], [0.4, 0.5]]), 0.05
        self.assertEqual(place.height(x_m, y_m).shape, (3, 2))
        self.assertEqual(place.height(x_m, y_m)[1, 1], place.height(0.3, 0.05))
        self.assertTrue((place.height(x_m, y_m) >= place._core.ground(*np.broadcast_arrays(x_m, y_m))).all())
        with self.assertRaises(ValueError):
            place.height([0, 1], [0, 1, 2])

    def test_a_slope_is_a_plane(self):
        held = ry.Scenario(NOMINAL, set={"terrain.rocks.kind": "none", "terrain.ground.slope_deg": 10})
        grid = ry.Place(held, 0).grid(0.5)
        rise = np.gradient(grid.height_m, grid.y_m, grid.x_m)
        steepest = np.hypot(*rise)
        np.testing.assert_allclose(steepest, math.tan(math.radians(10)), rtol=1e-9)
        np.testing.assert_array_equal(grid.height_m, grid.ground_m)

    def test_a_grid_covers_the_bounds(self):
        place = ry.Place(ry.Scenario(NOMINAL), 1)
        x0, x1, y0, y1 = place.bounds
        grid = place.grid(0.25)
        self.assertEqual((grid.x_m[0], grid.y_m[0]), (x0, y0))
        self.assertLessEqual(abs(grid.x_m[-1] - x1), 0.125)
        self.assertLessEqual(abs(grid.y_m[-1] - y1), 0.125)
        self.assertEqual(grid.height_m.shape, (len(grid.y_m), len(grid.x_m)))
        self.assertEqual(grid.height_m[3, 5], place.height(grid.x_m[5], grid.y_m[3]))
        self.assertTrue((grid.height_m >= grid.ground_m).all())
        self.assertTrue((grid.height_m > grid.ground_m).any())
        for step_m in (0, -1, float("nan")):
            self.refusal(place.grid, step_m)

    def test_a_trial_has_the_place_that_it_drove_in(self):
        made = run("run", 2)
        self.assertEqual(len(made.trial(1).place.rocks), int(made.trial(1).record["rocks"]))
        again = ry.Place(ry.Scenario(NOMINAL), 1, SEED)
        np.testing.assert_array_equal(made.trial(1).place.rocks, again.rocks)

    def test_wrong_numbers_are_refused(self):
        held = ry.Scenario(NOMINAL)
        for given in ((-1,), (2**32,), ("0",), (0, -1), (0, 1.5)):
            self.refusal(ry.Place, held, *given)
        self.refusal(ry.images, held, -1)
        for pose in ((1, 2), (1, 2, float("nan"))):
            self.refusal(ry.images, held, 0, pose)


class Images(package.PackageTest):
    def rendered(self, *words):
        settings = [word for name, value in SMALL.items() for word in ("--set", f"{name}={value}")]
        folder = f"render{len(package.files('.'))}"
        command("render", STEREO, *settings, "--out", folder, *words)
        return Path(folder)

    def test_images_are_those_that_the_command_renders(self):
        held = ry.Scenario(STEREO, set=SMALL)
        cases = [(0, None, False, ()), (1, (2.0, 0.3, math.radians(20)), False, ("--trial", 1, "--x", 2, "--y", 0.3, "--heading", 20)),
                 (1, None, True, ("--trial", 1, "--behind"))]
        for trial, pose, behind, words in cases:
            with self.subTest(words=words):
                folder = self.rendered(*words)
                images = ry.images(held, trial, pose, behind)
                np.testing.assert_array_equal(images.left, png(folder / "left.png"))
                np.testing.assert_array_equal(images.right, png(folder / "right.png"))
                self.assertEqual((images.left.dtype, images.left.shape), (np.uint8, (80, 96)))
                theirs = pfm(folder / "disparity.pfm")
                np.testing.assert_array_equal(np.where(np.isfinite(theirs), theirs, np.nan), images.disparity_px)
                self.assertTrue(0 < np.isnan(images.disparity_px).mean() < 0.6)
                np.testing.assert_allclose(images.X_WR[:3, :3] @ images.X_WR[:3, :3].T, np.eye(3), atol=1e-12)
                np.testing.assert_array_equal(images.X_WR[3], [0, 0, 0, 1])
                np.testing.assert_allclose(images.X_WR[:2, 3], (pose or (0.0, 0.0, 0.0))[:2], atol=1e-9)
                self.assertAlmostEqual(math.atan2(images.X_WR[1, 0], images.X_WR[0, 0]), (pose or (0, 0, 0.0))[2], delta=0.03)

    def test_the_pose_is_that_of_a_sequence(self):
        folder = self.rendered("--pairs", 1)
        pose = np.array((folder / "poses.txt").read_text().split(), float).reshape(3, 4)
        np.testing.assert_array_equal(ry.images(ry.Scenario(STEREO, set=SMALL)).X_WR[:3], pose)

    def test_a_trial_shows_what_it_saw(self):
        made = run("run", 1, STEREO, set={**SMALL, "referee.time_limit_s": 100})
        trial = made.trial(0)
        first, later = trial.images(), trial.images(trial.trace.time_s[-1])
        self.assertFalse(np.array_equal(first.left, later.left))
        self.assertAlmostEqual(later.X_WR[0, 3], trial.record["final_x_m"], delta=1e-3)
        np.testing.assert_array_equal(first.left, ry.images(made.scenario, 0).left)


if __name__ == "__main__":
    package.main()
