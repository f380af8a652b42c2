#!/usr/bin/env python3
"""A wheel on soil in Python: Bekker's closed forms, shapes of arrays, what is refused.

Usage: wheels_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import math
import unittest

import numpy as np
import package
import rockyard as ry

SAND = {"law": "bekker", "sinkage_exponent": 1.1, "cohesive_modulus_N_per_mn1": 15.6e3,
        "frictional_modulus_N_per_mn2": 2407.4e3, "cohesion_Pa": 250.0, "friction_angle_deg": 31.9,
        "shear_modulus_m": 0.011}
RADIUS_M, WIDTH_M = 0.15735, 0.165


def bekker(load_N, slip):
    """Pull, torque and sinkage by Bekker 1969, Janosi and Hanamoto 1961."""
    n, k = SAND["sinkage_exponent"], SAND["cohesive_modulus_N_per_mn1"] + WIDTH_M * SAND["frictional_modulus_N_per_mn2"]
    depth_m = (load_N / ((3 - n) / 3 * k * math.sqrt(2 * RADIUS_M))) ** (1 / (n + 0.5))
    length_m = RADIUS_M * math.acos(1 - depth_m / RADIUS_M)
    most_N = WIDTH_M * length_m * SAND["cohesion_Pa"] + load_N * math.tan(math.radians(SAND["friction_angle_deg"]))
    u = slip * length_m / SAND["shear_modulus_m"]
    traction_N = most_N * (1 - (1 - math.exp(-u)) / u)
    return traction_N - k * depth_m ** (n + 1) / (n + 1), RADIUS_M * traction_N, depth_m


class Wheels(unittest.TestCase):
    def setUp(self):
        self.wheel = ry.Wheel(SAND, RADIUS_M, WIDTH_M)

    def assert_refused(self, name, call, *given, **more):
        with self.assertRaises(ry.InputError) as raised:
            call(*given, **more)
        self.assertIn(name, str(raised.exception))

    def test_bekkers_wheel_has_its_closed_form(self):
        for load_N, slip in ((80.0, 0.1), (80.0, 0.6), (25.0, 0.3)):
            told = self.wheel.steady(load_N, slip)
            for name, value in zip(("pull_N", "torque_Nm", "sinkage_m"), bekker(load_N, slip)):
                self.assertAlmostEqual(float(told[name]), value, 9)
            self.assertEqual(float(told["side_N"]), 0.0)

    def test_arguments_broadcast(self):
        told = self.wheel.steady([[50.0], [80.0]], np.linspace(0.0, 0.8, 5), 0.2)
        self.assertEqual(list(told), ["pull_N", "side_N", "torque_Nm", "sinkage_m", "resistance_N"])
        for values in told.values():
            self.assertEqual(values.shape, (2, 5))
        alone = self.wheel.steady(80.0, 0.4, 0.2)
        self.assertEqual(float(told["side_N"][1, 2]), float(alone["side_N"]))
        self.assertEqual(alone["pull_N"].shape, ())

    def test_laws_lugs_and_gravity_matter(self):
        def pull_N(gravity_m_s2=9.81, **more):
            wheel = ry.Wheel({"law": "intrusion", "pressure": "density"}, 0.15, 0.12, gravity_m_s2=gravity_m_s2, **more)
            return float(wheel.steady(60.0, 0.3)["pull_N"])

        smooth = pull_N()
        self.assertGreater(pull_N(lug_height_m=0.01, lug_count=20), smooth + 5.0)
        self.assertLess(pull_N(1.62), smooth)  # it sinks deeper under the same load

    def test_what_is_wrong_is_named(self):
        self.assert_refused("frictional_angle_deg", ry.Wheel, {"frictional_angle_deg": 30.0}, 0.1, 0.1)
        self.assert_refused("friction_angle_deg", ry.Wheel, {"friction_angle_deg": 80.0}, 0.1, 0.1)
        self.assert_refused("law", ry.Wheel, {"law": "coulomb"}, 0.1, 0.1)
        self.assert_refused("soil", ry.Wheel, {"law": object()}, 0.1, 0.1)
        self.assert_refused("radius_m", ry.Wheel, {}, 0.0, 0.1)
        self.assert_refused("width_m", ry.Wheel, {}, 0.1, math.nan)
        self.assert_refused("lug_height_m", ry.Wheel, {}, 0.1, 0.1, 0.2)
        self.assert_refused("lug_count", ry.Wheel, {}, 0.1, 0.1, 0.01, -1)
        self.assert_refused("gravity_m_s2", ry.Wheel, {}, 0.1, 0.1, gravity_m_s2=-1.0)
        self.assert_refused("largest_load_N", ry.Wheel, {}, 0.1, 0.1, largest_load_N=0.0)
        self.assert_refused("load_N", self.wheel.steady, 0.0, 0.1)
        self.assert_refused("load_N", self.wheel.steady, [10.0, 1001.0], 0.1)
        self.assert_refused("slip", self.wheel.steady, 10.0, [0.1, 1.0])
        self.assert_refused("slip", self.wheel.steady, 10.0, -1.0)
        self.assert_refused("slip_angle_rad", self.wheel.steady, 10.0, 0.1, 2.0)


if __name__ == "__main__":
    package.main()
