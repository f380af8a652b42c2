"""Counts of the study of continuous driving, on numbers made by hand."""

import unittest

from context import frame, np
from continuous import continuous as study


def drive(outcome=study.ARRIVED, time_s=300.0, **values):
    return (dict.fromkeys((*study.SHOWN, *study.PLANS), 1.0) | {"sim_time_s": time_s, "visual_distance_m": 15.0} | values
            | {"outcome": outcome})


def trials_of(fields, names=("k_per_m2", "trial")):
    """A frame of trials; fields are drives by cycle, by their key."""
    return frame(dict(zip(names, key if isinstance(key, tuple) else (key,))) | {"cycle": cycle} | row
                 for key, cycles in fields.items() for cycle, row in cycles.items())


def wide(fields, names=("k_per_m2", "trial")):
    return study.fields_of(trials_of(fields, names), *names)


def field(stop=600.0, csod=300.0, csad=240.0, lost=None, steering=0.5):
    rows = {"stop_and_look": drive(time_s=stop), "csod": drive(time_s=csod),
            "csad": drive(time_s=csad, steer_turned_rad=steering)}
    if lost:
        rows[lost]["outcome"] = "jammed"
    return rows


class Counts(unittest.TestCase):
    def test_the_printed_gain_and_ratio(self):
        self.assertAlmostEqual(study.GAIN, 0.193, places=3)
        self.assertAlmostEqual(study.STEERING_RATIO, 0.93 / 2.03)
        for cycle in study.CYCLES[1:]:
            values = study.PUBLISHED[cycle]
            self.assertAlmostEqual(100 * values["visual_distance_m"] / values["sim_time_s"], values["speed_cm_s"], places=2)

    def test_places(self):
        self.assertEqual(study.place(np.array([1.0, 2.0, 3.0, 4.0]), 2.5), (0.5, 1.0))
        share, chance = study.place(np.ones(99), 0.5)
        self.assertEqual(share, 0.0)
        self.assertAlmostEqual(chance, 0.02)
        # The other side counts alike.
        self.assertEqual(study.place(np.ones(99), 1.5)[1], chance)

    def test_only_fields_in_which_all_arrive_are_compared(self):
        fields = wide({(0.01, 0): field(), (0.01, 1): field(lost="csod"), (0.01, 2): field(lost="stop_and_look")})
        self.assertEqual(list(study.shared_arrivals(fields).index), [(0.01, 0)])
        self.assertEqual(list(study.shared_arrivals(fields, study.MOVING).index), [(0.01, 0), (0.01, 2)])

    def test_gains_are_shares_of_the_first_time(self):
        fields = wide({(0.01, 0): field(), (0.01, 1): field(csod=400.0, csad=300.0)})
        for found, wanted in zip(study.gains(fields, *study.MOVING), (0.2, 0.25), strict=True):
            self.assertAlmostEqual(found, wanted)
        self.assertEqual(list(study.ratios(fields, "steer_turned_rad", *study.MOVING)), [0.5, 0.5])
        fields["steer_turned_rad", "csod"] = [0.0, 2.0]
        self.assertEqual(list(study.ratios(fields, "steer_turned_rad", *study.MOVING)), [0.25])
        self.assertAlmostEqual(fields.speed_cm_s.csod[0.01, 0], 5.0)

    def test_the_paired_table_counts_who_arrives_alone(self):
        fields = {(0.01, i): field(csad=240.0 + i) for i in range(4)}
        fields |= {(0.01, 4): field(lost="csod"), (0.01, 5): field(lost="csod"), (0.01, 6): field(lost="csad")}
        text = study.paired_table(wide(fields))
        self.assertIn("over the 4 fields", text)
        self.assertIn("csad alone arrives in 2 fields, csod alone in 1", text)

    def test_fields_with_ways_like_the_published_ones(self):
        near = {cycle: drive(visual_distance_m=14.9, time_s=time_s)
                for cycle, time_s in zip(study.CYCLES, (400.0, 300.0, 240.0))}
        far = {cycle: row | {"visual_distance_m": 15.2} for cycle, row in near.items()}
        half = near | {"csad": far["csad"]}
        self.assertEqual(list(study.alike(wide({0: near, 1: far, 2: half}, ["trial"])).index), [0])
        both = wide({0: near, 3: near}, ["trial"])
        self.assertIn("In the 2 fields", study.alike_text(both))
        self.assertIn("csad gains 20.0 (20.0..20.0) %; medians csod 300 s", study.alike_text(both))
        self.assertIn("No field", study.alike_text(wide({1: far}, ["trial"])))

    def test_tables_have_a_line_for_each_cycle_and_abundance(self):
        fields = wide({(k, i): field(csod=300.0 + i) for k in (0.004, 0.01) for i in range(3)})
        self.assertEqual(len(study.drives_table(fields).split("\n\n")[0].splitlines()), 2 + 3)
        self.assertEqual(len(study.strata_table(fields).splitlines()), 2 + 2)
        plans = study.plans_table(fields).splitlines()
        self.assertEqual(len(plans), 2 + 2)
        self.assertIn("| csad | 1.0 | 1.00 | 1.00 | 1.00 | 1.0 | 1000.0 (1000.0) |", plans[3])

    def test_maps_mark_what_holds_the_published_ratio(self):
        cells = {("20", 0.5): {i: field(csad=300 * (1 - study.GAIN) + i - 1, steering=0.9 + 0.01 * i) for i in range(3)},
                 ("90", 0.5): {i: field(csad=280.0 + i) for i in range(3)}}
        cells = {levels: trials_of(fields, ["trial"]) for levels, fields in cells.items()}
        rows = study.map_rows(cells)
        self.assertEqual([row["arrivals"] for row in rows], [3, 3])
        lines = study.map_table(rows).splitlines()
        self.assertIn("| 20 | 0.81*, 0.91 |", lines[2])
        self.assertIn("| 90 | 0.94, 0.50 |", lines[3])
        self.assertEqual([name for name, _ in study.map_panels(rows)[0][1]], ["20 deg/s", "90 deg/s", "published"])

    def test_choices_are_held_against_what_is_assumed(self):
        base = frame([drive(), drive("jammed"), drive(), drive()])
        other = frame([drive(time_s=330.0), drive(), drive("no_path"), drive(time_s=330.0)])
        cells = {(cycle, name): trials for cycle in study.CYCLES[1:]
                 for name, trials in ((study.AS_ASSUMED, base), ("slower", other))}
        rows = study.choice_rows(cells)
        slower = next(row for row in rows if row["choice"] == "slower")
        self.assertEqual((slower["arrived"], slower["won"], slower["lost"]), (3, 1, 1))
        self.assertAlmostEqual(slower["time"], 1.1)
        self.assertIn("| slower | 3 of 4 (+1, -1) | 1.10 (1.10..1.10) |", study.choices_table(rows))
