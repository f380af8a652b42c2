"""Counting of the studies of visual odometry's places and of its speed, on numbers made by hand."""

import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import odometry_places_study as places  # noqa: E402  (the path comes first)
import odometry_speed_study as speed  # noqa: E402


def point(x, y, error):
    return {"true_x_m": str(x), "true_y_m": str(y), "true_z_m": "5", "error_m": str(error)}


class Places(unittest.TestCase):
    def test_errors_belong_to_the_true_way(self):
        self.assertEqual(places.along([point(1, 1, 0.0), point(4, 5, 0.1), point(4, 6, 0.3)]),
                         [(0.0, 0.0), (5.0, 0.1), (6.0, 0.3)])

    def test_a_curve_has_the_median_and_the_extremes_of_sequences(self):
        # The longest way is 8 m: bins of 1 m, the last one with its end.
        sequences = [[(0.5, 1.0), (0.7, 3.0), (8.0, 9.0)], [(0.2, 5.0)], [(0.9, 4.0), (1.0, 7.0)]]
        self.assertEqual(places.curve(sequences), [(0.5, 4.0, 2.0, 5.0), (1.5, 7.0, 7.0, 7.0), (7.5, 9.0, 9.0, 9.0)])

    def test_a_line_counts_its_case_and_source(self):
        def row(trial, end, gaps, **other):
            return {"case": "a", "source": "right_eye", "trial": trial, "pairs": 11, "gaps": gaps, "end_percent": end,
                    "step_rms_mm": 2.0 * trial, "step_rms_deg": 0.5, "normalized_mean": 6.0, "place_ms": 4.0 - trial} | other
        rows = [row(1, 0.3, 0), row(2, 0.1, 2), row(3, 0.2, 1), row(4, 9.0, 9, case="b"),
                row(5, 9.0, 9, source="disparity_map")]
        self.assertEqual(places.line_of(rows, "a", "right_eye"),
                         ["a", "right eye", "3", "3 of 30", "4.00", "0.5000", "0.20 (0.10, 0.30)", "6.0", "1.0"])


class Speed(unittest.TestCase):
    def test_the_round_with_the_least_median_counts_as_a_whole(self):
        def one(every, match):
            return {"all_median_ms": every, "match_median_ms": match, "detect_median_ms": 0.5, "features": 400.0,
                    "matches": 300.0, "label": "AVX3"}
        found = speed.hundred_pairs([one(2.0, 0.1), one(1.0, 0.4), one(1.5, 0.2)])
        self.assertEqual((found["all_ms"], found["match_ms"], found["pairs"]), (1.0, 0.4, 100))

    def test_times_are_the_least_and_of_one_motion(self):
        def one(time):
            return {"Features/50": {"features": 48.0, "found": 1.0, "mm": 0.5, "deg": 0.01, "cpu_time": time}}
        self.assertEqual(speed.by_features([one(60.0), one(36.0), one(48.0)]),
                         [{"asked": 50, "features": 48.0, "found": 1.0, "mm": 0.5, "deg": 0.01, "ms": 3.0}])

    def test_measured_rows_get_their_inputs_and_others_keep_theirs(self):
        document = {"hundred_pairs": {"all_ms": 1.23456, "match_ms": 0.4, "features": 400.0}, "step_ms": 2.5,
                    "by_features": [{"asked": 50, "mm": 4.0, "deg": 0.1, "ms": 1.0},
                                    {"asked": 100, "mm": 2.0, "deg": 0.3, "ms": 7.0}]}
        text = ('{"id": "time.front", "inputs": [9, 1], "unit": "ms"},\n{"id": "vo.regions", "inputs": [4, 4]},\n'
                '{"id": "quality.deg_100", "inputs": [8, 8]}\n{"id": "cost.ms_100", "inputs": [8, 8]}\n')
        self.assertEqual(
            speed.with_inputs(text, document),
            '{"id": "time.front", "inputs": [1.235, 1], "unit": "ms"},\n{"id": "vo.regions", "inputs": [4, 4]},\n'
            '{"id": "quality.deg_100", "inputs": [0.3, 0.1]}\n{"id": "cost.ms_100", "inputs": [7, 1]}\n')


if __name__ == "__main__":
    unittest.main()
