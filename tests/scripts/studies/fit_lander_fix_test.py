"""The fit of the lander's law on rows whose law is known."""

import unittest

import pandas

from context import np
from calibrations import fit_lander_fix

LAW = {
    "found": {"intercept": 0.5, "width": 2.0, "no_blue": -1.0, "pink_aside": 0.6, "light": 0.8},
    "wrong": {"intercept": -2.0, "width": -1.0, "no_blue": 1.5, "pink_aside": -0.7, "light": 0.0},
    "heading": {"least_deg": 1.0, "pixels": 0.6},
    "range": {"least": 0.01, "pixels": 0.5},
    "bearing": {"least_deg": 0.0, "pixels": 0.4},
    "heading_bias_deg": 0.0,
    "range_bias": 0.02,
    "wrong_turn_deg": 120.0,
    "wrong_range": 0.3,
}


def made(number, seed, law):
    """Rows of a finder whose law is known."""
    rng = np.random.default_rng(seed)
    rows = pandas.DataFrame({"distance_m": rng.choice([2, 3, 4.5, 7, 10, 15], number),
                             "orientation_deg": rng.choice(range(-165, 180, 30), number),
                             "sun_elevation_deg": rng.choice([10, 30, 60], number), "measurements": 1})
    found = rng.random(number) < fit_lander_fix.chance(law["found"], rows)
    wrong = found & (rng.random(number) < fit_lander_fix.chance(law["wrong"], rows))
    rows = rows.assign(x_found=found * 1.0, x_wrong=wrong * 1.0, x_right=(found & ~wrong) * 1.0,
                       x_orientation_bias_deg=wrong * rng.uniform(-1, 1, number) * law["wrong_turn_deg"],
                       x_stereo_bias=np.expm1(rng.normal(0, law["wrong_range"], number)))
    for name, (column, factor) in fit_lander_fix.ERRORS.items():
        errors = fit_lander_fix.bias_of(law, name) + rng.normal(0, fit_lander_fix.deviation(law, name, rows))
        rows[f"x_right_{column.format('bias')}"] = errors / factor
    return rows


class Fits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.law = fit_lander_fix.fit(made(12000, 3, LAW), "x")

    def test_the_law_comes_back(self):
        # Bounds of about four standard errors at 12,000 rows.
        for group, deltas in (("found", (0.20, 0.20, 0.25, 0.20, 0.30)), ("wrong", (0.35, 0.30, 0.35, 0.30, 0.50))):
            for (name, value), delta in zip(LAW[group].items(), deltas):
                self.assertAlmostEqual(self.law[group][name], value, delta=delta, msg=f"{group} {name}")
        self.assertAlmostEqual(self.law["heading"]["least_deg"], 1.0, delta=0.15)
        self.assertAlmostEqual(self.law["heading"]["pixels"], 0.6, delta=0.03)
        self.assertAlmostEqual(self.law["range"]["least"], 0.01, delta=0.0015)
        self.assertAlmostEqual(self.law["range"]["pixels"], 0.5, delta=0.03)
        self.assertAlmostEqual(self.law["bearing"]["pixels"], 0.4, delta=0.015)
        self.assertAlmostEqual(self.law["range_bias"], 0.02, delta=0.001)
        self.assertAlmostEqual(self.law["wrong_turn_deg"], 120, delta=6)
        self.assertAlmostEqual(self.law["wrong_range"], 0.3, delta=0.03)

    def test_what_is_not_there_vanishes(self):
        self.assertEqual(self.law["heading_bias_deg"], 0.0)
        self.assertAlmostEqual(self.law["wrong"]["light"], 0.0, delta=0.5)

    def test_ratios_of_another_seed_are_one(self):
        other = made(12000, 4, LAW)
        for name in fit_lander_fix.ERRORS:
            values = fit_lander_fix.ratios(other, "x", self.law, name)
            self.assertAlmostEqual(values.mean(), 1.0, delta=0.09, msg=name)

    def test_control_rows_of_another_law_are_told_apart(self):
        wider = LAW | {"heading": {"least_deg": 1.2, "pixels": 0.72}}
        values = fit_lander_fix.ratios(made(12000, 4, wider), "x", self.law, "heading")
        self.assertGreater(values.mean(), 1.3)

    def test_a_pose_beside_the_cylinder_is_wrong(self):
        rows = made(100, 6, LAW)
        rows = rows[rows.x_right > 0]
        edge = 1e3 * fit_lander_fix.RADIUS_M / rows.distance_m
        for factor, wrong in ((0.99, 0), (1.01, 1), (-1.01, 1)):
            found = fit_lander_fix.judged(rows.assign(x_right_bearing_bias_mrad=factor * edge), "x")
            self.assertEqual((set(found.x_wrong), set(found.x_right)), ({wrong}, {1 - wrong}))

    def test_rows_that_cannot_be_fitted_end_it(self):
        rows = made(10, 5, LAW)
        for bad in (rows[:0], rows.drop(columns="orientation_deg"), rows.assign(measurements=2)):
            with self.assertRaises(SystemExit):
                fit_lander_fix.fit(bad, "x")

    def test_merging_keeps_what_it_does_not_name(self):
        scenario = {"name": "a", "sensors": {"aids": {"lander_fix": {"enabled": True, "law": "constant"}}}}
        fit_lander_fix.merge(scenario, fit_lander_fix.fragment(LAW))
        fix = scenario["sensors"]["aids"]["lander_fix"]
        self.assertEqual((scenario["name"], fix["enabled"], fix["law"]), ("a", True, "cylinder"))
        self.assertEqual(fix["cylinder"]["range_bias"], 0.02)
