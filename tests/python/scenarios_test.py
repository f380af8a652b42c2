#!/usr/bin/env python3
"""Scenarios as mappings: values in and out, all or none of them, texts that read back, names.

Usage: scenarios_test.py ROCKYARD PLUGINS [unittest's arguments]
"""

import copy
import json
import pickle
from pathlib import Path

import package
import rockyard as ry
from package import NOMINAL, PROJECT, QUICK, SEED, command, navigator

import numpy as np


class Scenarios(package.PackageTest):
    def setUp(self):
        self.held = ry.Scenario(NOMINAL)

    def test_values_are_read_by_path_and_by_attribute(self):
        held = self.held
        self.assertEqual(held["rover.fidelity"], "multibody")
        self.assertEqual(held.rover.fidelity, "multibody")
        self.assertEqual(held["rover"]["geometry.length_m"], held.rover.geometry.length_m)
        self.assertIn("geometry", held.rover)
        self.assertIn("geometry.length_m", held.rover)
        self.assertNotIn("wings", held.rover)
        self.assertIsNone(held.get("rover.wings"))
        self.assertEqual(len(held.course), len(list(held.course)))
        self.assertEqual(held.to_dict()["rover"]["geometry"]["length_m"], held.rover.geometry.length_m)
        self.assertIn("fidelity", dir(held.rover))
        with self.assertRaises(KeyError):
            held["rover.wings"]
        with self.assertRaisesRegex(AttributeError, "rover has no wings: there are"):
            held.rover.wings

    def test_values_are_set_and_checked(self):
        held = self.held
        held["course.goal_x_m"] = 5
        held.terrain.rocks["k_per_m2"] = np.float32(0.0078125)
        held.rover.fidelity = "quasi_static"
        held.set({"trials": np.int64(3), "course.goal_x_m": 6.5})
        told = json.loads(held.resolved())
        self.assertEqual((told["course"]["goal_x_m"], told["terrain"]["rocks"]["k_per_m2"], told["trials"]), (6.5, 0.0078125, 3))
        self.assertEqual(held.rover.fidelity, "quasi_static")
        for path, value in (("course.goal_x_m", 1e9), ("course.goal_x_m", "far"), ("rover.wings", 2),
                            ("rover.fidelity", "none"), ("trials", 1.5), ("trials", None), ("trials", {1, 2})):
            before = held.resolved()
            refused = self.refusal(held.set, {"seed": 99, path: value})
            self.assertIn(path, [problem.path for problem in refused.problems])
            self.assertEqual(held.resolved(), before, "nothing changed")
            with self.assertRaises(ry.InputError):
                held[path] = value
        with self.assertRaises(ry.InputError):
            del held["seed"]

    def test_values_that_go_together_alone_are_set_together(self):
        low, high = self.held["terrain.rocks.min_diameter_m"], self.held["terrain.rocks.max_diameter_m"]
        both = {"terrain.rocks.min_diameter_m": high + 0.1, "terrain.rocks.max_diameter_m": high + 0.5}
        self.refusal(self.held.copy().set, dict(list(both.items())[:1]))
        self.held.set(both)
        self.held.set({"terrain.rocks.min_diameter_m": low, "terrain.rocks.max_diameter_m": low + 0.01})
        ry.Scenario(None, set=both)
        ry.Scenario(self.held, set=both)

    def test_what_is_handed_out_changes_nothing(self):
        whole = self.held.to_dict()
        whole["rover"]["geometry"]["length_m"] = 9
        self.assertNotEqual(self.held.rover.geometry.length_m, 9)
        lists = [(group, name) for group in ("sensors.light_stripe", "course", "navigation.gestalt") for name, value in self.held[group].items()
                 if isinstance(value, list)]
        for group, name in lists:
            before = copy.deepcopy(self.held[group][name])
            self.held[group][name].append(1)
            self.assertEqual(self.held[group][name], before)
        self.assertTrue(lists)

    def test_copies_are_independent(self):
        other = self.held.copy()
        other["seed"] = 12
        self.assertNotEqual(self.held["seed"], 12)
        self.assertEqual(ry.Scenario(other).resolved(), other.resolved())
        self.assertNotEqual(ry.Scenario(other, set={"seed": 13})["seed"], other["seed"])

    def test_a_text_reads_back_bit_for_bit(self):
        self.held["terrain.rocks.k_per_m2"] = 0.01 / 3
        self.held.save("saved.json")
        again = ry.Scenario("saved.json")
        self.assertEqual(again.resolved(), self.held.resolved())
        self.assertEqual(again["terrain.rocks.k_per_m2"], 0.01 / 3)
        with self.assertRaises(FileExistsError):
            self.held.save("saved.json")
        command("validate", "saved.json")

    def test_every_shipped_scenario_reads_back(self):
        names = ry.scenarios()
        self.assertGreater(len(names), 50)
        for name in names[::6]:
            held = ry.Scenario(name)
            self.assertEqual(ry.Scenario(held).resolved(), held.resolved(), name)
            held.save(f"{name.replace('/', '_')}.json")
            self.assertEqual(ry.Scenario(f"{name.replace('/', '_')}.json").resolved(), held.resolved(), name)
        self.assertIn("regression", ry.sweeps())

    def test_defaults_and_representations(self):
        self.assertEqual(json.loads(ry.Scenario().resolved())["trials"], ry.Scenario()["trials"])
        self.assertEqual(repr(self.held), f"<Scenario nominal: {self.held['trials']} trials, seed {self.held['seed']}>")
        self.assertTrue(repr(self.held.rover).startswith("<rover: "))
        self.assertEqual(ry.Scenario("nominal").resolved(), self.held.resolved())
        self.assertEqual(ry.Scenario("nominal", set={"name": "mine"})["name"], "mine")
        self.assertTrue(ry.__version__)

    def test_deciders_stay_with_a_scenario(self):
        held = ry.Scenario(NOMINAL, deciders=(each for each in [navigator("mine"), navigator("other")]))
        self.assertEqual(held["navigation.navigator"], "other")
        self.assertEqual(held["navigation.mine.goal_tolerance_m"], 0.3)
        held["navigation.navigator"] = "mine"
        self.assertEqual(held.copy()["navigation.navigator"], "mine")
        more = ry.Scenario(held, deciders=[navigator("third")])
        self.assertEqual(more["navigation.navigator"], "third")
        more["navigation.navigator"] = "other"
        self.assertIn("other", str(self.refusal(held.set, {"navigation.navigator": "third"})))

    def test_a_trial_is_the_same_whenever_it_is_run(self):
        held = ry.Scenario(NOMINAL, set=QUICK)
        first = held.run_trial(3, SEED)
        np.testing.assert_equal(held.run_trial(3, SEED), first)
        np.testing.assert_equal(held.run_trial(np.int64(3), np.int64(SEED)), first)
        self.assertNotEqual(held.run_trial(4, SEED)["true_distance_m"], first["true_distance_m"])
        for given in ((-1,), (2**32,), (0, -1), (0, 2**70), ("0",)):
            self.refusal(held.run_trial, *given)


if __name__ == "__main__":
    package.main()
