"""Counts and choices of the study of generations, on numbers made by hand."""

import unittest
from unittest import mock

from context import frame, np
from generations import brains, generations, tuning

ROWS = [{"path": "navigation.n.length_m", "kind": "real", "study_low": "1", "study_high": "3", "choices": ""},
        {"path": "navigation.n.count", "kind": "integer", "study_low": "0", "study_high": "12", "choices": ""},
        {"path": "navigation.n.rule", "kind": "choice", "study_low": "", "study_high": "", "choices": "a|b|c"},
        {"path": "navigation.n.flag", "kind": "boolean", "study_low": "", "study_high": "", "choices": ""}]


def trials(*arrivals, **columns):
    """Two cells of as many layouts as there are arrivals: the second cell has none."""
    rows = [{"ground": "level", "k_per_m2": k, "trial": number, "outcome": "goal_reached" if arrived and not k else "jammed"}
            | {name: values[number] for name, values in columns.items()}
            for k in (0.0, 1.0) for number, arrived in enumerate(arrivals)]
    return frame(rows)


class Tuning(unittest.TestCase):
    def test_draws_fill_every_range_evenly(self):
        first, *drawn = tuning.configurations(ROWS, 12, 7)
        self.assertEqual(first, {})
        lengths = sorted(values["navigation.n.length_m"] for values in drawn)
        for stratum, value in enumerate(lengths):
            self.assertGreaterEqual(value, 1 + stratum / 6 - 0.005)  # three digits
            self.assertLessEqual(value, 1 + (stratum + 1) / 6 + 0.005)
        self.assertEqual(sorted(values["navigation.n.rule"] for values in drawn), [*"aaaabbbbcccc"])
        self.assertEqual(sum(values["navigation.n.flag"] for values in drawn), 6)
        self.assertTrue(all(isinstance(values["navigation.n.count"], int) for values in drawn))
        self.assertEqual(tuning.configurations(ROWS, 12, 7)[1:], drawn)
        self.assertNotEqual(tuning.configurations(ROWS, 12, 8)[1:], drawn)

    def test_the_best_of_the_second_drives_is_taken(self):
        asked = []

        def tried(_, name, stage, configs, seed, layouts):
            asked.append((stage, sorted(configs), seed, layouts))
            scores = {number: number / 100 for number in configs} if stage == "first" else {number: 0.5 for number in configs} | {10: 0.7}
            return scores, "0.1.0 abc"
        for expected, second in ((10, None), (0, {})):
            with mock.patch.object(tuning, "ranges", lambda *_: ROWS), mock.patch.object(tuning, "tried", tried if second is None else (
                    lambda *words: ({number: 0.5 for number in words[3]}, ""))):
                rows, values = tuning.tune(None, "gestalt")
            # Where nothing is better, what is assumed stays.
            self.assertEqual([row["configuration"] for row in rows if row["taken"]], [expected])
            self.assertEqual(values == {}, expected == 0)
        self.assertEqual([each[1] for each in asked], [list(range(13)), [0, 9, 10, 11, 12]])
        self.assertNotEqual(asked[0][2], asked[1][2])  # other layouts decide than those that chose

    def test_levers_are_the_navigator_s_own(self):
        for name, brain in brains.BRAINS.items():
            own = brain.plugin or brain.values.get("navigation.navigator", "gestalt")
            self.assertTrue(all(lever.startswith(f"navigation.{own}.") for lever in brain.levers), name)
            self.assertFalse(set(brain.levers) & set(brain.values), name)

    def test_a_sensor_leaves_the_others_as_they_are(self):
        self.assertEqual(brains.paths({"a": 1, "b": {"c": 2, "d": {"e": [3]}}}, "x"), {"x.a": 1, "x.b.c": 2, "x.b.d.e": [3]})
        self.assertFalse({"sensors", "perception", "navigation"} & {path for brain in brains.BRAINS.values() for path in brain.values})


class Counts(unittest.TestCase):
    def test_layouts_are_the_units(self):
        self.assertEqual(brains.by_layout(trials(1, 0, 1, 1)).tolist(), [0.5, 0.0, 0.5, 0.5])
        # The mean of four layouts, with Student's interval of them and not of eight drives.
        half = 3.182446 * np.std([50, 0, 50, 50], ddof=1) / 2
        self.assertEqual(brains.estimate(brains.by_layout(trials(1, 0, 1, 1))), f"37.5 ({37.5 - half:.1f}..{37.5 + half:.1f})")

    def test_differences_are_in_pairs(self):
        self.assertEqual(generations.points(trials(1, 0, 1, 0), trials(1, 1, 1, 1)).split()[0], "25.0")
        self.assertEqual(generations.points(trials(1, 1, 0), trials(1, 1, 0)), "0.0 (0.0..0.0)")

    def test_ratios_are_of_drives_in_which_both_arrive(self):
        base, other = trials(1, 1, 0, sim_time_s=[10, 20, 999]), trials(1, 0, 1, sim_time_s=[15, 999, 999])
        self.assertEqual(generations.ratio(base, other, "sim_time_s"), "1.50")
        self.assertEqual(generations.ratio(base, trials(0, 0, 1, sim_time_s=[1, 1, 1]), "sim_time_s"), "-")


if __name__ == "__main__":
    unittest.main()
