"""The calibration of the rocks' profile: its parts, and that it gives what the paper says."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts/studies"))
import study  # noqa: E402, F401  (knows where calibrations are)
from calibrations import calibrate_profile  # noqa: E402

ROCKYARD = sys.argv.pop(1)
# Of both readings of the rocks' heights, by scripts/calibrations/calibrate_profile.py.
CALIBRATED = {(0.8, 1.2): 0.8675, (0.4, 0.9): 0.945}
# Sets of scenes: ten for each of 16 heights. With 250 scenes each the crossing is known to 0.4 mm, and with 75 to
# 0.8 mm, where it is 6 mm and more off.
TRIALS = 160
FEW = 48


class Crossing(unittest.TestCase):
    def test_is_where_the_line_between_two_points_passes_the_level(self):
        curve = [(0.05, 0.1), (0.06, 0.4), (0.07, 0.8), (0.08, 0.3)]
        self.assertAlmostEqual(calibrate_profile.crossing(curve), 0.0625)
        self.assertAlmostEqual(calibrate_profile.crossing(curve, 0.1), 0.05)

    def test_is_infinite_where_nothing_reaches_the_level(self):
        self.assertEqual(calibrate_profile.crossing([(0.05, 0.1), (0.2, 0.4)]), float("inf"))


class Bisection(unittest.TestCase):
    def test_finds_the_value_of_a_rising_function(self):
        found = calibrate_profile.calibrate(lambda p: 0.05 + 0.03 * p * p, 0.0725)
        self.assertAlmostEqual(found, 0.75 ** 0.5, delta=calibrate_profile.TOLERANCE)

    def test_finds_nothing_beyond_the_ends(self):
        for target in (0.049, 0.081):
            self.assertIsNone(calibrate_profile.calibrate(lambda p: 0.05 + 0.03 * p, target))


class Profile(unittest.TestCase):
    """Half of the rocks are seen from 7 to 7.5 cm of height on."""

    def seen_from(self, pointedness, heights=None, trials=TRIALS):
        settings = [f"{path}={ratio}" for path, ratio in zip(calibrate_profile.HEIGHT_RATIOS, heights or ())]
        return calibrate_profile.seen_from(ROCKYARD, pointedness, settings, trials)

    def test_calibrated_rocks_are_seen_as_late_as_the_paper_says(self):
        low, high = calibrate_profile.SEEN_FROM_M
        for heights, pointedness in CALIBRATED.items():
            height = self.seen_from(pointedness, heights)
            self.assertTrue(low < height < high, f"{heights}: {height}")

    def test_ellipsoids_are_seen_earlier_and_cones_later(self):
        low, high = calibrate_profile.SEEN_FROM_M
        self.assertLess(self.seen_from(0.0, trials=FEW), low)
        self.assertGreater(self.seen_from(calibrate_profile.MOST_POINTED, trials=FEW), high)

    def test_against_a_scenario_refuses_a_value_that_is_seen_too_early(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = Path(folder) / "scenario.json"
            scenario.write_text('{"terrain": {"rocks": {"pointedness": 0.2}}}', encoding="utf-8")
            result = subprocess.run(
                [sys.executable, ROOT / "scripts/calibrations/calibrate_profile.py", "--rockyard", ROCKYARD, "--trials",
                 str(FEW), "--against", scenario], text=True, capture_output=True, check=False)
        # The control, a value that it takes, is the test scripts.profile_of_nominal.
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("terrain.rocks.pointedness is 0.2", result.stderr)


if __name__ == "__main__":
    unittest.main()
