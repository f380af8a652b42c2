#!/usr/bin/env python3
"""Estimators in Python: dead reckoning and wheel odometry give the records of the same in C++, bit for bit, with aids
and without; whatever is wrong with one ends its drive as a fault that names it, or is refused.

Usage: estimators_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import math
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PLUGINS, QUICK, SEED, navigator, raises, rows, run
from rockyard import elementary
from rockyard.environment import forward
from rockyard.navigator import parameter

import numpy as np

BEACON = {"sensors.aids.beacon.enabled": True}


def wrapped(angle_rad):
    return angle_rad if abs(angle_rad) <= math.pi else math.remainder(angle_rad, 2.0 * math.pi)


class DeadReckoning(ry.Estimator):
    """src/localization/dead_reckoning.cc in Python, with the same operations in the same order."""

    name, doc = "reckoning", "wheels, gyro and accelerometers"

    def start(self, setup):
        self.setup, self.force, self.odometer_m = setup, None, 0.0
        self.roll_rad = self.pitch_rad = self.z_m = 0.0
        self.put(*setup.start)
        self.felt = self.pose

    @property
    def pose(self):
        return self.x_m, self.y_m, self.heading_rad

    def put(self, x_m, y_m, heading_rad):
        self.x_m, self.y_m, self.heading_rad = x_m, y_m, wrapped(heading_rad)

    def rolled_rad(self, wheel_turn_rad, steer_rad):
        way, total, count = self.setup.odometry_wheels, 0.0, 0
        every = way != "unsteered" or all(self.setup.steered)
        for turned, ratio, steered, steer in zip(wheel_turn_rad, self.setup.radius_ratio, self.setup.steered, steer_rad):
            if not every and steered:
                continue
            total += turned * ratio * (elementary.cos(steer) if way == "forward" else 1.0)
            count += 1
        return total / count

    def propagate(self, duration_s, wheel_turn_rad, steer_rad, turn_rad):
        way_m = self.rolled_rad(wheel_turn_rad, steer_rad) * self.setup.wheel_radius_m * self.setup.distance_scale
        along_rad = self.heading_rad + (0.5 * turn_rad if self.setup.step_heading == "midpoint" else 0.0)
        self.x_m += way_m * elementary.cos(along_rad)
        self.y_m += way_m * elementary.sin(along_rad)
        self.heading_rad = wrapped(self.heading_rad + turn_rad)
        self.odometer_m += abs(way_m)

    def feel(self, felt, duration_s):
        turned_rad = wrapped(self.heading_rad - self.felt[2])
        along_rad = self.felt[2] + 0.5 * turned_rad
        forward_m = ((self.x_m - self.felt[0]) * elementary.cos(along_rad)
                     + (self.y_m - self.felt[1]) * elementary.sin(along_rad))
        force = felt["specific_force_R"]
        if self.setup.attitude_source == "accelerometers" and force is not None:
            if self.force is None or self.setup.attitude_filter_s <= 0.0:
                self.force = list(force)
            else:
                share = -elementary.expm1(-duration_s / self.setup.attitude_filter_s)
                self.force = [old + share * (new - old) for old, new in zip(self.force, force)]
            x, y, z = self.force
            self.pitch_rad = elementary.atan2(-x, elementary.hypot(y, z))
            self.roll_rad = elementary.atan2(y, z)
        if self.setup.height == "integrated":
            self.z_m -= forward_m * elementary.sin(self.pitch_rad)
        self.felt = self.pose

    def place(self, x_m, y_m, heading_rad, mirrored):
        self.put(x_m, y_m, heading_rad)
        self.force, self.felt = None, self.pose

    def estimate(self):
        return ry.estimate(*self.pose, self.odometer_m, roll_rad=self.roll_rad, pitch_rad=self.pitch_rad, z_m=self.z_m)


class WheelOdometry(ry.Estimator):
    """examples/estimators/wheel_odometry.cc in Python."""

    name, doc, takes_fixes = "wheel_odometry", "wheels and gyro, corrected by measured places", True
    parameters = [parameter("way_scale", "real", 1.0, "way of the rover over what its wheels roll", min=0.1, max=2.0),
                  parameter("variance_m2_per_m", "real", 0.02, "variance of x and y that a metre adds", min=0.0, max=1.0)]
    own_values = [("fixes", "1", "Places measured by aids that it used.")]

    def start(self, setup):
        self.radius_m, self.distance_m = setup.wheel_radius_m, 0.0
        self.place(*setup.start, False)

    def propagate(self, duration_s, wheel_turn_rad, steer_rad, turn_rad):
        rolled_rad = 0.0
        for turned in wheel_turn_rad:
            rolled_rad += turned
        way_m = self.p.way_scale * self.radius_m * rolled_rad / 6
        self.distance_m += abs(way_m)
        for pose in (self.pose, self.odometry):
            along_rad = pose[2] + 0.5 * turn_rad
            pose[0] += way_m * elementary.cos(along_rad)
            pose[1] += way_m * elementary.sin(along_rad)
            pose[2] = wrapped(pose[2] + turn_rad)
        for row in (0, 1):
            self.covariance[row, row] += self.p.variance_m2_per_m * abs(way_m)

    def place(self, x_m, y_m, heading_rad, mirrored):
        self.pose = [x_m, y_m, wrapped(heading_rad)]
        self.odometry = list(self.pose)
        if not mirrored:
            self.covariance = np.zeros((6, 6))

    def fix(self, capture, measured, pose, covariance, in_lander_frame):
        if not (measured[0] and measured[1]) or in_lander_frame:
            return "no_interest"
        for row in (0, 1):
            variance = self.covariance[row, row]
            if variance > 0.0:
                weight = variance / (variance + covariance[row, row])
                self.pose[row] += weight * (pose[row] - self.pose[row])
                self.covariance[row, row] *= 1.0 - weight
        self.own["fixes"] += 1
        return "used"

    def estimate(self):
        return ry.estimate(*self.pose, self.distance_m, odometry=(*self.odometry, self.distance_m), covariance=self.covariance)


class Same(package.PackageTest):
    def test_dead_reckoning_is_that_built_in(self):
        for number, more in enumerate([{}, {"perception.dead_reckoning.wheels": "unsteered"},
                                       {"perception.dead_reckoning.wheels": "forward", "perception.dead_reckoning.step_heading": "start",
                                        "perception.attitude.filter_s": 0.0}]):
            with self.subTest(more):
                built_in = run(f"built_in{number}", 1, set=more)
                ours = run(f"ours{number}", 1, set=more, deciders=[DeadReckoning])
                self.assertEqual(ours.scenario["localization.estimator"], "reckoning")
                self.assertEqual(ours.hash, built_in.hash)
        self.assertEqual(run("twin", 1, plugins=[PLUGINS["estimators_dead_reckoning_twin"]]).hash, ry.load("built_in0").hash)
        self.assertEqual(run("threads", 3, deciders=[DeadReckoning], threads=2).hash, run("built_in", 3).hash)

    def test_dead_reckoning_feels_accelerometers(self):
        more = {"sensors.vehicle.accelerometers.enabled": True}
        built_in = run("felt", 1, set=more)
        self.assertEqual(run("felt_ours", 1, set=more, deciders=[DeadReckoning]).hash, built_in.hash)
        seen = []
        for kinds in ((), (DeadReckoning,)):
            env = ry.Environment(ry.Scenario(NOMINAL, set={**QUICK, **more}, deciders=kinds))
            env.reset(index=1)
            seen.append([env.step(forward(until_distance_m=0.3))[0]["attitude"] for _ in range(8)])
        np.testing.assert_array_equal(*seen)
        self.assertGreater(np.abs(seen[0]).min(), 0)

    def test_wheel_odometry_is_that_of_the_library(self):
        for number, more in enumerate([{}, BEACON, {**BEACON, "localization.wheel_odometry.way_scale": 0.9}]):
            with self.subTest(more):
                library = run(f"library{number}", 1, set=more, plugins=[PLUGINS["wheel_odometry"]])
                ours = run(f"python{number}", 1, set=more, deciders=[WheelOdometry])
                self.assertEqual(ours.hash, library.hash)
                self.assertEqual(ours.units, library.units)
                self.assertEqual(bool(ours.records["wheel_odometry.fixes"].all()), bool(more))

    def test_it_drives_with_a_navigator_in_python_and_with_a_library(self):
        both = run("both", 1, deciders=[navigator(), WheelOdometry])
        self.assertEqual((both.scenario["navigation.navigator"], both.scenario["localization.estimator"]), ("mine", "wheel_odometry"))
        self.assertNotIn("navigator_fault", both.outcomes)
        with_library = run("with_library", 2, deciders=[DeadReckoning], plugins=[PLUGINS["pathfinder_twin"]], threads=2)
        self.assertEqual(with_library.hash, run("plain", 2).hash)
        again = with_library.trial(1).trace
        self.assertEqual(again.position_m[-1][0], with_library.trial(1).record["final_x_m"])

    def test_a_worker_gets_python_though_another_thread_computes(self):
        """A worker is a fork: it lacks the thread that has the interpreter's lock."""
        import threading
        over = threading.Event()

        def compute():
            while not over.is_set():
                pass
        thread = threading.Thread(target=compute)
        thread.start()
        try:
            made = run("busy", 1, deciders=[DeadReckoning], plugins=[PLUGINS["pathfinder_twin"]])
        finally:
            over.set()
            thread.join()
        self.assertEqual(made.hash, run("idle", 1).hash)


class Ticking(DeadReckoning):
    """Counts, and fails as it is told to, at tick 100."""

    name, own_values = "mine", [("ticks", "1", "Ticks of wheels and gyro.")]

    def propagate(self, *motion):
        super().propagate(*motion)
        self.own["ticks"] += 1
        if self.own["ticks"] == 100:
            self.fail()

    def fail(self):
        pass


def told(*given, **more):
    """Returns estimate() that tells this from tick 100 on."""
    def estimate(self):
        return ry.estimate(*given, **more) if self.own["ticks"] >= 100 else DeadReckoning.estimate(self)
    return estimate


def returns(value):
    def estimate(self):
        return value if self.own["ticks"] >= 100 else DeadReckoning.estimate(self)
    return estimate


NAN, ONE = float("nan"), np.eye(6)


class Failures(package.PackageTest):
    IN_A_DRIVE = {
        "propagate raises": ({"fail": raises(ValueError("lost"))}, "threw", r"estimator mine: ValueError: lost \(.*package.py:\d+\)"),
        "it leaves": ({"fail": raises(SystemExit(2))}, "threw", "estimator mine: SystemExit: 2"),
        "it interrupts": ({"fail": raises(KeyboardInterrupt())}, "threw", "estimator mine: KeyboardInterrupt"),
        "start raises": ({"start": raises(KeyError("goal"))}, "threw", "KeyError: 'goal'"),
        "it cannot be made": ({"__init__": raises(ValueError("no"))}, "threw", "ValueError: no"),
        "feel raises": ({"feel": raises(ValueError("felt"))}, "threw", "ValueError: felt"),
        "estimate recurs": ({"estimate": lambda self: self.estimate()}, "threw", "RecursionError"),
        "no place()": ({"propagate": ry.Estimator.propagate}, "threw", r"NotImplementedError: propagate\(\)"),
        "None": ({"estimate": returns(None)}, "message", "no tuple of four"),
        "a list": ({"estimate": returns([1, 2, 3, 4])}, "message", "no tuple of four"),
        "a short pose": ({"estimate": returns(((0, 0, 0), None, (0, 0, 0), None))}, "message", "no pose of 4 numbers"),
        "a text": ({"estimate": told("a", 0, 0, 0)}, "message", "no pose of 4 numbers"),
        "a short odometry": ({"estimate": told(0, 0, 0, 0, odometry=(1, 2))}, "message", "no odometry of 4 numbers"),
        "a small covariance": ({"estimate": told(0, 0, 0, 0, covariance=np.eye(3))}, "message", "no covariance of 6 x 6"),
        "no number": ({"estimate": told(0, NAN, 0, 0)}, "nonsense", r"estimator mine: pose\.y_m is nan"),
        "endless": ({"estimate": told(0, 0, float("inf"), 0)}, "nonsense", r"pose\.heading_rad is inf"),
        "no number for the odometry": ({"estimate": told(0, 0, 0, 0, odometry=(0, 0, 0, NAN))}, "nonsense", r"odometry\.distance_m is nan"),
        "no number for the attitude": ({"estimate": told(0, 0, 0, 0, pitch_rad=NAN)}, "nonsense", r"attitude\.pitch_rad is nan"),
        "no numbers in the covariance": ({"estimate": told(0, 0, 0, 0, covariance=NAN * ONE)}, "nonsense", "covariance is not finite"),
        "own values that are none": ({"fail": lambda self: self.own.update(ticks="many")}, "threw", "estimator mine: .*"),
    }

    def test_what_fails_in_a_drive_is_its_fault(self):
        for name, (members, cause, text) in self.IN_A_DRIVE.items():
            with self.subTest(name):
                told = package.fault(type("Mine", (Ticking,), members))
                self.assertRegex(told, package.CAUSES[cause] + ".*" + text)
                self.assertNotIn("\n", told)

    def test_what_fails_in_a_run_stands_in_its_files(self):
        made = run("run", 2, deciders=[type("Mine", (Ticking,), {"fail": raises(ValueError("lost"))})], threads=2)
        self.assertEqual(made.outcomes, {"navigator_fault": 2})
        for row in rows("run"):
            self.assertEqual((row["cause"], row["mine.ticks"]), ("navigator_threw", ""))
            self.assertIn("estimator mine: ValueError: lost", row["detail"])

    def test_covariances_of_several_kinds_are_taken(self):
        records = [ry.Scenario(NOMINAL, set=QUICK, deciders=[type("Mine", (Ticking,), {"estimate": self.with_covariance(made)})])
                   .run_trial(0, SEED) for made in (0.1 * ONE, (0.1 * ONE).tolist(), np.asfortranarray(0.1 * ONE))]
        for record in records:
            np.testing.assert_equal(record, records[0])
        self.assertNotEqual(records[0]["outcome"], "navigator_fault")

    @staticmethod
    def with_covariance(covariance):
        def estimate(self):
            return (*DeadReckoning.estimate(self)[:3], covariance)
        return estimate

    def test_an_own_value_that_is_not_declared_is_a_fault(self):
        told = package.fault(type("Mine", (Ticking,), {"fail": lambda self: self.own.update(more=1)}))
        self.assertIn("own value more is not declared", told)

    def test_a_wrong_use_of_an_aid_is_a_fault(self):
        for use in ("perhaps", None, 3):
            wrong = type("Mine", (WheelOdometry,), {"fix": lambda self, *fix, use=use: use})
            self.assertIn(f"fix() returns {use}", package.fault(wrong, **BEACON))

    def test_aids_need_who_takes_them(self):
        refused = self.refusal(run, "aided", 1, deciders=[Ticking], set=BEACON)
        self.assertIn("takes no fixes", str(refused))
        self.assertFalse(Path("aided").exists())

    def test_what_fails_before_is_refused(self):
        wrong = {
            r"Mine\.doc": {"doc": None}, r"Mine\.name": {"name": 3}, r"Mine\.own_values": {"own_values": 5},
            r"three texts": {"own_values": [("a",)]}, r"Mine\.parameters": {"parameters": [{"name": object()}]},
            r"parameters\[0\]": {"parameters": [{"name": "x"}]}, "is taken": {"name": "dead_reckoning"}, "cannot be the name": {"name": "A B"},
        }
        for text, members in wrong.items():
            with self.subTest(text):
                self.assertRegex(str(self.refusal(run, "wrong", 1, deciders=[type("Mine", (Ticking,), members)])), text)
        self.assertFalse(Path("wrong").exists())


if __name__ == "__main__":
    package.main()
