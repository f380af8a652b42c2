"""The figures of rockyard.plot: the colours of the pages, names with units, no key that hides what is drawn.

Usage: figures_test.py FOLDER_OF_PACKAGE [unittest options]
"""

import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WEB = ROOT / "src/web"
QUASI = {"rover.fidelity": "quasi_static"}


def light_colours(file):
    """The variables of a style sheet, as they are in light looks."""
    return dict(re.findall(r"--([\w-]+): light-dark\((#\w+)", (WEB / file).read_text(encoding="utf-8")))


def faults_of(axes):
    """What is wrong with a figure that is drawn."""
    figure = axes.figure
    figure.canvas.draw()
    if not axes.get_title(loc="left"):
        yield "no title"
    for axis in (axes.xaxis, axes.yaxis):
        if not axis.get_label_text():
            yield "an axis without a name"
        elif re.search(r"_(m|s|rad|deg|wh|percent)\b", axis.get_label_text()):
            yield f"{axis.get_label_text()} is no name with a unit"
    legend = axes.get_legend()
    if legend is not None:
        box = legend.get_window_extent()
        if box.overlaps(axes.get_window_extent()):
            yield "the key hides what is drawn"
        if box.x1 > figure.bbox.x1 or box.y0 < figure.bbox.y0:
            yield "the key goes beyond the figure"


class FiguresTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        runs = Path(cls.folder.name)
        cls.drives = ry.run("nominal", 12, set=QUASI, folder=runs / "a")
        cls.other = ry.run("nominal", 6, 2, set=QUASI, folder=runs / "b")
        axis = {"path": "terrain.rocks.k_per_m2", "values": [0.002, 0.004]}
        cls.sweep = ry.sweep({"name": "k", "scenario": "nominal", "set": QUASI, "axes": [
            axis, {"path": "perception.hazard.enabled", "values": [True, False]}]}, 4, folder=runs / "c")

    def tearDown(self):
        pyplot.close("all")

    def figures(self):
        plot = ry.plot
        return {"map": plot.map(self.drives.trial(3)), "cdf": plot.cdf([self.drives, self.other], "energy_wh"),
                "outcomes": plot.outcomes(self.drives), "over time": plot.over_time(self.drives, "heading_error_rad", range(4)),
                "success": plot.success(self.sweep), "success of choices": plot.success(self.sweep, "enabled")}

    def test_each_can_be_read(self):
        for name, axes in self.figures().items():
            with self.subTest(name):
                self.assertEqual(list(faults_of(axes)), [])

    def test_faults_are_found(self):
        axes = ry.plot.cdf(self.drives)
        axes.legend(loc="center")
        axes.set_title("", loc="left")
        axes.set(xlabel="energy_wh", ylabel="")
        self.assertEqual(list(faults_of(axes)), ["no title", "energy_wh is no name with a unit", "an axis without a name",
                                                 "the key hides what is drawn"])

    def test_colours_are_those_of_the_pages(self):
        plot, page = ry.plot, light_colours("shared/theme.css")
        self.assertEqual(plot.SERIES, tuple(page[f"series-{slot}"] for slot in range(1, 7)))
        self.assertEqual([plot.TEXT, plot.MUTED, plot.LINE, plot.BAD], [page[name] for name in ("text", "muted", "line", "bad")])
        replay = light_colours("replay/styles/colours.css")
        self.assertEqual([plot.TRUE, plot.BELIEVED, plot.GOAL], [replay[f"scene-{name}"] for name in ("true-path", "believed-path", "goal")])
        looks = re.findall(r"^  (\w+): \{ colour: \"var\(--([\w-]+)\)\"", (WEB / "report/series.ts").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertGreater(len(looks), 8)
        for outcome, colour in looks:
            self.assertEqual(plot.OUTCOME_LOOKS[outcome][0], page[colour], outcome)

    def test_no_two_look_alike(self):
        self.assertEqual(sorted(ry.plot.OUTCOME_LOOKS), sorted(ry.OUTCOMES))
        looks = list(ry.plot.OUTCOME_LOOKS.values())
        self.assertEqual(len(set(looks)), len(looks))

    def test_names(self):
        for column, unit, wanted in (("true_distance_m", None, "true distance [m]"), ("energy_wh", "Wh", "energy [Wh]"),
                                     ("net_rate_m_s", None, "net rate [m/s]"), ("k_per_m2", None, "k [1/m²]"), ("scans", "1", "scans"),
                                     ("heading_error_deg", "deg", "heading error [°]"), ("slope_deg", "", "slope")):
            self.assertEqual(ry.plot.label(column, unit), wanted)

    def test_distribution_is_the_empirical_one(self):
        axes = ry.plot.cdf(self.drives, "energy_wh")
        x, y = axes.get_lines()[0].get_data()
        values = sorted(self.drives.records["energy_wh"])
        for value in values[:-1]:
            self.assertEqual(y[x <= value][-1], sum(other <= value for other in values) / len(values))

    def test_stacks_hold_each_trial_once(self):
        axes = ry.plot.outcomes(self.drives, "energy_wh", bins=5)
        self.assertEqual(sum(bar.get_height() for bar in axes.patches), len(self.drives))
        for x in {bar.get_x() for bar in axes.patches}:
            bars = [bar for bar in axes.patches if bar.get_x() == x]
            self.assertEqual(sum(bar.get_height() for bar in bars), max(bar.get_y() + bar.get_height() for bar in bars))

    def test_success_is_that_of_the_cells(self):
        axes = ry.plot.success(self.sweep)
        drawn = {(line.get_label(), x): y for line in axes.get_lines() for x, y in zip(*line.get_data())}
        told = {(f"enabled {row.enabled}", row.k_per_m2): row.true_success for row in self.sweep.cells.itertuples()}
        self.assertEqual(drawn, told)
        bands = [band.get_paths()[0].get_extents() for band in axes.collections]
        self.assertEqual(sorted((band.y0, band.y1) for band in bands),
                         sorted((part.true_success_low.min(), part.true_success_high.max())
                                for _, part in self.sweep.cells.groupby("enabled")))

    def test_median_is_that_of_the_drives_under_way(self):
        axes = ry.plot.over_time(self.drives, "position_error_m", range(5))
        lines = {line.get_label(): line.get_data() for line in axes.get_lines()}
        times, median = lines["median"]
        traces = [self.drives.trial(trial).trace for trial in range(5)]
        ends = sorted(trace.time_s[-1] for trace in traces)
        self.assertLessEqual(times[-1], ends[2])  # three drive until then
        self.assertGreater(times[-1], ends[2] - ends[-1] / 400)
        at = 250
        values = sorted(float(np.interp(times[at], trace.time_s, trace.position_error_m)) for trace in traces
                        if trace.time_s[-1] >= times[at])
        self.assertAlmostEqual(median[at], float(np.median(values)), 12)
        self.assertEqual(len([line for line in axes.get_lines() if line.get_label() != "median"]), 5)

    def test_map_shows_both_paths(self):
        trial = self.drives.trial(3)
        lines = {line.get_label(): line.get_xydata() for line in ry.plot.map(trial).get_lines()}
        np.testing.assert_array_equal(lines["true path"], trial.trace.position_m[:, :2])
        np.testing.assert_array_equal(lines["believed path"], trial.trace.believed[:, :2])
        self.assertEqual(lines["goal"].tolist(), [[7.6, 0.0]])

    def test_axes_of_the_caller_are_used(self):
        mine = pyplot.subplots()[1]
        for draw in (lambda: ry.plot.map(self.drives.trial(3), ax=mine), lambda: ry.plot.outcomes(self.drives, ax=mine)):
            self.assertIs(draw(), mine)

    def test_what_is_not_there_is_named(self):
        for draw in (lambda: ry.plot.cdf(self.drives, "energy"), lambda: ry.plot.outcomes(self.drives, "energy"),
                     lambda: ry.plot.success(self.sweep, "k")):
            with self.assertRaises(ry.UnknownName) as raised:
                draw()
            self.assertRegex(str(raised.exception), "did you mean|there are")


if __name__ == "__main__":
    sys.path.insert(0, str(Path(sys.argv.pop(1)).resolve()))
    os.environ.update(MPLBACKEND="Agg")
    import numpy as np
    import rockyard as ry
    from matplotlib import pyplot
    unittest.main()
