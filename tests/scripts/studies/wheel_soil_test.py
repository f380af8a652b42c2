"""The judge of wheel laws, on wheels and rovers made by hand."""

import json
import math
import unittest
from dataclasses import replace

from context import StudyTest, np
from wheel_soil import data, laws, rover, scores, tables, wheel_soil

SAND = {"id": "toy", "density_kg_m3": 1600, "phi_deg": 30, "c_kPa": 0.5, "n": 1.0, "kc_kN_m_n1": 10, "kphi_kN_m_n2": 2000,
        "K_shear_mm": [8, 12]}
SHAPE = {"radius_mm": 150, "width_mm": 120, "lug_height_mm": 10, "lug_count": 12}


def toy(**changed):
    return {"wheel_id": "toy", "label": "Toy", "wheel": SHAPE, "load_N": 80, "soil": SAND,
            "uncertainty": {"torque_Nm": 0.12, "sinkage_mm": 2, "pull_N": 0.8}} | changed


class Fixed:
    """A wheel that pulls a share of its load, less with each newton of it."""

    def __init__(self, share, per_N=0.0):
        self.share, self.per_N = share, per_N

    def steady(self, loads_N, _slip):
        loads_N = np.asarray(loads_N)
        return {"pull_N": loads_N * (self.share - self.per_N * loads_N)}


class WheelTest(StudyTest):
    def read(self, *wheels, **more):
        path = self.root / "wheels.json"
        path.write_text(json.dumps({"wheels": wheels}), encoding="utf-8")
        return data.read_wheels(path, **more)


class Reading(WheelTest):
    def test_rows_of_either_kind_are_the_same(self):
        listed, named, apart = self.read(
            toy(columns=["slip", "pull_N", "slip_angle_deg"], rows=[[0.1, 8, 0], [-1, -20, 0], [0.5, 4, 30]]),
            toy(rows=[{"slip": 0.1, "pull_N": 8}, {"slip": -1, "pull_N": -20}, {"slip": 0.5, "pull_N": 4, "slip_angle_deg": 30}]),
            toy(rows=[{"slip": 0.1, "pull_N": 8}, {"slip": -1, "pull_N": -20}],
                rows_with_slip_angle=[{"slip": 0.5, "pull_N": 4, "slip_angle_deg": 30, "load_N": None}]))
        for wheel in (listed, named):
            np.testing.assert_array_equal(wheel.measured["pull"], [0.1, -0.25, 0.05])
            np.testing.assert_array_equal(wheel.rows["slip"], [0.1, -data.LOCKED, 0.5])
            self.assertEqual({name: list(mask) for name, mask in wheel.groups().items()},
                             {"driven": [True, False, False], "skidding": [False, True, False], "slip angle 15..30": [False, False, True]})
            self.assertTrue(np.isnan(wheel.measured["torque"]).all())
        self.assertTrue(np.isnan(apart.measured["pull"][2]))  # a load that nobody told is not the wheel's

    def test_constants_and_scatter(self):
        wheel, = self.read(toy(columns=["slip"], rows=[[0.1]]))
        self.assertEqual(wheel.soil, data.Soil(30.0, 1600.0, 500.0, 1.0, 10e3, 2000e3, 0.010))
        self.assertEqual(wheel.radius_m, 0.15)
        self.assertEqual(wheel.scatter["pull"], data.PULL_SCATTER)
        self.assertAlmostEqual(wheel.scatter["torque"], 0.12 / (0.15 * 80))
        self.assertAlmostEqual(wheel.scatter["side"], 0.01)
        self.assertEqual(wheel.scatter["sinkage"], 2.0)
        tips, = self.read(toy(columns=["slip"], rows=[[0.1]]), lugs_added=("toy",))
        self.assertAlmostEqual(tips.radius_m, 0.16)

    def test_declared_constants_go_before_those_of_a_file(self):
        wheel, states, bare = self.read(
            toy(soil={"id": "CMU_testbed_sand", "phi_deg": 60}, rows=[]),
            toy(soil={"candidates_density_phi": [[1500, 30], [1600, 34], [1700, 42]]}, rows=[]), toy(soil={}, rows=[]))
        self.assertEqual((wheel.soil.phi_deg, wheel.soil.kphi, wheel.soil.K_m), (29.0, 9354e3, 0.010))
        self.assertEqual((states.soil.density_kg_m3, states.soil.phi_deg), (1600.0, 34.0))
        self.assertEqual(states.soil.at_pair(0.75).phi_deg, 38.0)
        self.assertIsNone(laws.settings("bekker", states.soil, 0.1))
        self.assertIsNotNone(laws.settings("intrusion", states.soil, 0.1))
        self.assertFalse(any(laws.settings(law, bare.soil, 0.1) for law in laws.LAWS))

    def test_a_negative_cohesive_modulus_counts_with_the_width(self):
        soil = data.Soil(30.0, 1600.0, 0.0, 1.0, -40e3, 3000e3)
        made = laws.settings("bekker", soil, 0.08)
        self.assertEqual((made["cohesive_modulus_N_per_mn1"], made["frictional_modulus_N_per_mn2"]), (0.0, 2500e3))

    def test_cohesion_of_a_catalogue_goes_with_its_plates(self):
        soil = data.Soil(30.0, 1600.0, 0.0, 1.0, 0.0, 3000e3, plates_c_Pa=250.0)
        self.assertEqual([laws.settings(law, soil, 0.1)["cohesion_Pa"] for law in ("bekker", "intrusion", "intrusion, plate")],
                         [250.0, 0.0, 250.0])

    def test_the_files_of_the_project_are_read_whole(self):
        wheels = data.read_wheels(wheel_soil.MEASURED / "wheel_soil.json")
        self.assertEqual(sum(len(wheel.rows["slip"]) for wheel in wheels), 49 + 54)
        self.assertEqual([wheel.soil.phi_deg for wheel in wheels], [31.9, 40.6, 40.6, 29.0, 42.0, None])
        _, campaigns = data.read_slopes(wheel_soil.MEASURED / "slopes.json")
        self.assertEqual({year: len(slips) for year, (_, slips) in campaigns.items()}, {2021: 6, 2022: 7})


class JudgedTest(WheelTest):
    def setUp(self):
        super().setUp()
        self.wheel, = self.read(toy(columns=["slip", "pull_N", "sinkage_mm"], rows=[[0.1, 8, 10], [0.2, 16, None]]))

    def judged(self, pull, low=-1.0, high=1.0):
        ends = (np.full(2, low), np.full(2, high), np.full(2, low - 0.1), np.full(2, high + 0.1))
        return scores.Judged(self.wheel, "law", self.wheel.soil, {"pull": np.array(pull), "sinkage": np.array([13.0, 0.0])},
                             {"pull": np.array([pull, [2 * each for each in pull]])}, {"pull": ends, "sinkage": ends})


class Scores(JudgedTest):
    def test_errors_skill_and_coverage(self):
        control = self.judged([0.3, 0.4])
        found = self.judged([0.2, 0.2], 0.15, 0.3).score("pull", "driven", control)
        self.assertEqual(found["rows"], 2)
        self.assertAlmostEqual(found["rmse"], math.sqrt(0.005))
        self.assertAlmostEqual(found["bias"], 0.05)
        self.assertAlmostEqual(found["over_scatter"], math.sqrt(0.005) / data.PULL_SCATTER)
        self.assertAlmostEqual(found["skill"], 1.0 - 0.01 / 0.08)
        self.assertEqual((found["inside"], found["inside_noisy"]), (1, 2))
        self.assertEqual(control.score("pull", "driven", control)["skill"], 0.0)

    def test_skill_in_each_soil(self):
        """Off by 0.1 and 0 in the first soil, by 0.3 and 0.2 in the second; the control by 0.2 and 0.2, 0.5 and 0.6."""
        skill = self.judged([0.2, 0.2]).drawn_skill("pull", "driven", self.judged([0.3, 0.4]))
        np.testing.assert_allclose(skill, [1 - 0.01 / 0.08, 1 - 0.13 / 0.61])

    def test_rows_without_a_measurement_do_not_count(self):
        self.assertEqual(self.judged([0, 0]).score("sinkage", "driven", self.judged([0, 0]))["rmse"], 3.0)

    def test_a_law_that_made_the_rows_is_found_out(self):
        """Rows made by a law with 36 deg: calibration finds it, the law then errs by nothing, the control does."""
        soil = replace(self.wheel.soil, phi_deg=36.0)
        slips = np.linspace(0.05, 0.6, 6)
        made = laws.shares(laws.wheel_of(self.wheel, "intrusion", soil), self.wheel.radius_m, 80.0, slips)
        rows = [[slip, 80 * pull, 12 * torque, depth] for slip, pull, torque, depth in
                zip(slips, made["pull"], made["torque"], made["sinkage"])]
        wheel, = self.read(toy(columns=["slip", "pull_N", "torque_Nm", "sinkage_mm"], rows=rows))
        fitted = scores.calibrated(wheel, "intrusion")
        self.assertAlmostEqual(fitted.phi_deg, 36.0, delta=0.2)
        self.assertAlmostEqual(fitted.density_kg_m3 / 1600.0, 1.0, delta=0.03)
        control = scores.judge(wheel, "bekker")
        found = scores.judge(wheel, "intrusion", fitted).score("pull", "driven", control)
        self.assertLess(found["rmse"], 0.003)
        self.assertEqual(found["inside"], 6)
        self.assertGreater(found["skill"], 0.99)

    def test_rows_without_a_load_are_not_predicted(self):
        some, none = self.read(toy(columns=["slip", "pull_N", "load_N"], rows=[[0.1, 8, 80], [0.2, 9, None]]),
                               toy(columns=["slip", "pull_over_load"], rows=[[0.1, 0.1]], load_N=None))
        made = scores.judge(some, "intrusion")
        self.assertEqual(list(np.isnan(made.predicted["pull"])), [False, True])
        self.assertEqual(made.score("pull", "driven", made)["rows"], 1)
        self.assertIsNone(scores.judge(none, "intrusion"))

    def test_most_resistance(self):
        wheel, = self.read(toy(columns=["slip", "pull_N", "torque_Nm", "sinkage_mm"], rows=[[0.1, 8, 2.4, 15], [0.2, 8, None, 15]]))
        (slip, depth, resists, most), = scores.most_resistance(wheel)
        self.assertEqual((slip, depth), (0.1, 15.0))
        self.assertAlmostEqual(resists, 0.2 - 0.1)
        self.assertAlmostEqual(most, math.tan(math.acos(0.9)))


class Climbing(unittest.TestCase):
    def test_a_constant_share_is_the_tangent_of_the_slope(self):
        for levers in (True, False):
            self.assertAlmostEqual(rover.slope_deg(Fixed(math.tan(math.radians(12.0))), 700.0, 0.2, levers), 12.0, 6)
        self.assertTrue(math.isnan(rover.slope_deg(Fixed(-0.1), 700.0, 0.2)))

    def test_levers_matter_where_pull_is_no_share(self):
        """Loads W/4 (cos a +- 2 h / L sin a): their squares add up to more than those of equal ones."""
        weight_N, share, per_N = 700.0, 0.4, 5e-4
        angle = math.radians(rover.slope_deg(Fixed(share, per_N), weight_N, 0.2))
        front, behind = (weight_N / 4 * (math.cos(angle) - sign * 2 * rover.CENTRE_M / rover.WHEELBASE_M * math.sin(angle))
                         for sign in (1, -1))
        self.assertAlmostEqual(2 * sum(load * (share - per_N * load) for load in (front, behind)), weight_N * math.sin(angle), 6)
        self.assertGreater(rover.slope_deg(Fixed(share, per_N), weight_N, 0.2, levers=False), math.degrees(angle) + 0.1)

    def test_crossings(self):
        self.assertAlmostEqual(rover.crossing_deg([0.0, 10.0, 20.0], [0.0, 0.1, 0.5], 0.3), 15.0)


class Verdict(JudgedTest):
    def rule(self, pulls, slopes):
        """The default and who may be it: laws that are off by these shares on every wheel, and by these degrees."""
        ends = (np.zeros(2),) * 4
        judged = {}
        for law, off in pulls.items():
            error = {"pull": self.wheel.measured["pull"] + off, "sinkage": self.wheel.measured["sinkage"] + off}
            for name in (*tables.BY_SKILL, tables.NOT_WORSE_ON):
                judged[name, law] = scores.Judged(self.wheel, law, None, error, {}, {"pull": ends, "sinkage": ends})
        climbs = {"measured": {1: [10.0] * 4, 2: [12.0] * 4},
                  "laws": {law: {"loosest": [12.0 + off] * 4} for law, off in slopes.items()}}
        return tables.default_law(judged, climbs)

    def test_the_best_that_is_not_worse_on_the_rover(self):
        pulls = dict(zip(laws.LAWS, (0.4, 0.3, 0.2, 0.1, 0.25)))
        best, allowed = self.rule(pulls, dict(zip(laws.LAWS, (3.0, 1.0, 3.0, 4.0, 9.0))))
        self.assertEqual(best, "resistive_force")
        self.assertEqual([law for law in laws.LAWS if allowed[law]], ["bekker", "wong_reece", "resistive_force"])

    def test_the_control_stays_where_all_others_are_worse(self):
        self.assertEqual(self.rule(dict(zip(laws.LAWS, (0.1, 0.2, 0.2, 0.2, 0.2))), dict.fromkeys(laws.LAWS, 0.0))[0], "bekker")

    def test_the_nearest_campaign_counts(self):
        climbs = {"measured": {1: [10.0], 2: [12.0]}, "laws": {"bekker": {"loosest": [11.5]}, "wong_reece": {"loosest": [math.nan]}}}
        self.assertEqual(tables.rover_errors(climbs, "bekker"), [0.5])
        self.assertEqual(tables.rover_errors(climbs, "wong_reece"), [10.0])


class Script(WheelTest):
    def test_other_wheels_are_scored_and_nothing_is_written(self):
        path = self.root / "wheels.json"
        path.write_text(json.dumps({"wheels": [toy(columns=["slip", "pull_N"], rows=[[0.1, 8], [0.3, 20]]),
                                               toy(wheel_id="bare", label="Bare", soil={}, columns=["slip"], rows=[[0.1]])]}),
                        encoding="utf-8")
        told = self.script(wheel_soil, "--wheels", path, "--out", self.root / "out")
        self.assertIn("| Toy | driven (2) | pull / load |", told.out)
        self.assertIn("| Bare | all | not judged", told.out)
        self.assertFalse((self.root / "out").exists())


if __name__ == "__main__":
    unittest.main()
