#!/usr/bin/env python3
"""Mobility in Python: what the command writes, as columns.

Usage: mobility_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import json
import unittest

import package
import rockyard as ry
from package import NOMINAL, command

import numpy as np

FEW = {"slopes": (0, 10, 20), "draws": 2, "steps": False, "soils": "mars_drift"}


class Mobility(unittest.TestCase):
    def test_columns_are_those_of_the_command(self):
        found = ry.mobility(NOMINAL, **FEW)
        said = json.loads(command("mobility", str(NOMINAL), "--slopes", "0,10,20", "--draws", "2", "--no-steps", "--soil",
                                  "mars_drift", "--json").stdout)
        self.assertEqual(list(found), ["slopes", "wheel", "limits"])
        for table, columns in found.items():
            self.assertEqual(list(columns), list(said[table]))
            for name, values in columns.items():
                expected = [np.nan if cell is None else cell for cell in said[table][name]]
                np.testing.assert_array_equal(values, np.array(expected), err_msg=name)
        self.assertIn("<svg", found.svg)
        self.assertTrue(np.all(found["slopes"]["slip_low"] <= found["slopes"]["slip_high"]))

    def test_a_scenario_of_python(self):
        scenario = ry.Scenario(NOMINAL)
        scenario["rover.mass.total_kg"] = 30.0
        found = ry.mobility(scenario, **{**FEW, "draws": 0})
        self.assertEqual(found["limits"]["mass_kg"].tolist(), [30.0])
        self.assertNotIn("slip_low", found["slopes"])

    def test_errors(self):
        for wrong in ({"soils": "mud"}, {"slopes": ()}, {"fidelity": "fine"}, {"loads": ()}, {"slip_limit": 0.0}):
            with self.assertRaises(ry.InputError, msg=wrong):
                ry.mobility(NOMINAL, **{**FEW, **wrong})


if __name__ == "__main__":
    package.main()
