"""Matthies 1995, figures 7 and 8: a run among three rocks, in plan view and as its heading error."""

import copy
import math

import numpy as np
from study import rates

from . import Drawn, Figure, FigureError, style, three_rocks

MOST_RUNS = 60  # of which the band is made: each is driven again
GRID_M = 0.1
PUBLISHED_A_M, PUBLISHED_END_M = 2.6, 8.1  # section 5
ROOM_M = 0.5  # about what is drawn
AT_REST = ("", "scan", "image", "compute", "overhead")
ALARM_GAP_M = 0.3  # alarms of one avoidance are nearer together


def accepted_runs(source):
    source.require_experiment("three_rock_run", "localization/three_rock_run.json")
    rows = three_rocks.accepted(source.run)
    if rows.empty:
        raise FigureError(f"{source.path}: no run is accepted; run more of them")
    return {row["trial"]: row for row in rows.reset_index().to_dict("records")}


def rocks_of(row):
    """(name, x, y, diameter, height) of each rock."""
    return [(name.upper(), *(row[f"{name}_{key}"] for key in ("x_m", "y_m", "diameter_m", "height_m")))
            for name in "abc"]


def drive_scenario(source, row):
    """The drive of an accepted run as a scenario of its own."""
    document = copy.deepcopy(source.scenario.to_dict())
    document["experiment"] = "drive"
    document["course"]["goal_x_m"] = row["goal_m"]
    rocks = document["terrain"]["rocks"]
    rocks["kind"] = "listed"
    for at, key in enumerate(("x_m", "y_m", "diameter_m", "height_m"), start=1):
        rocks["listed"][key] = [rock[at] for rock in rocks_of(row)]
    return document


class Course:
    """What a trace says: both paths, the heading error along the way, where alarms were raised."""

    def __init__(self, trace):
        ticks = np.flatnonzero(~np.isin(trace["activity"], AT_REST))  # of control
        self.true, self.believed = (trace[name][ticks, :2] for name in ("position_m", "believed"))
        self.path = np.append(0.0, np.cumsum(np.hypot(*np.diff(self.true, axis=0).T)))
        self.error_deg = np.degrees(trace["heading_error_rad"][ticks])
        events = trace.events
        self.alarms = self._alarms(np.searchsorted(trace["time_s"][ticks], events.time_s[events.kind == "hazard"], side="right"))

    def _alarms(self, places):
        found = []
        for at in np.minimum(places, len(self.path) - 1):
            if not found or self.path[at] - found[-1][1] > ALARM_GAP_M:
                found.append([at, self.path[at]])
            else:
                found[-1][1] = self.path[at]
        return [first for first, _last in found]

    def error_at(self, path_m):
        return self.error_deg[np.searchsorted(self.path, path_m)]


def course_of(source, row):
    return Course(source.trace(row["trial"], drive_scenario(source, row)))


def side_of(course, row):
    """+1 or -1: how the error of the record is signed against the trace's."""
    return math.copysign(1.0, row["final_deg"] * course.error_deg[-1])


def chosen(runs, options):
    if options.trial not in runs:
        raise FigureError(f"--trial {options.trial}: is no accepted run; accepted are "
                          f"{', '.join(str(trial) for trial in list(runs)[:10])} ...")
    return runs[options.trial]


def draw_plan(sources, options):
    row = chosen(accepted_runs(sources[0]), options)
    course = course_of(sources[0], row)
    figure, axes = style.new_figure(7.5, 2.4)
    style.octagons(axes, [rock[1:4] for rock in rocks_of(row)], facecolor=style.PALE,
                   edgecolor=style.INK, linewidth=0.8)
    for name, x, y, diameter, _height in rocks_of(row):
        axes.annotate(name, (x, y + 0.5 * diameter), xytext=(0, 3), textcoords="offset points",
                      ha="center", fontsize=9)
    axes.plot(*course.true.T, color=style.BLUE, label="true")
    axes.plot(*course.believed.T, color=style.VERMILION, linestyle="--", label="dead reckoned")
    across = [*course.true[:, 1], *course.believed[:, 1], *(rock[2] for rock in rocks_of(row))]
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal", ylim=(min(across) - ROOM_M, max(across) + ROOM_M))
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, fontsize=8)
    caption = (f"A run with three rocks, in the manner of Matthies 1995, figure 7: {sources[0].name}, seed "
               f"{sources[0].seed}, accepted run {row['trial']}; {row['length_m']:.2f} m long, final errors {row['position_error_m']:.2f} m and "
               f"{row['heading_error_deg']:.1f} deg (published: 8.1 m, 1.0 m and 15.3 deg). The paper's own path "
               "is not available, so none is drawn.")
    return Drawn(figure, caption, {"true": course.true, "believed": course.believed})


def band(courses):
    """[path, lowest 2.5 %, median, highest 2.5 %] over the runs that are as long."""
    rows = []
    shortest = min(course.path[-1] for course, _side in courses)
    for i in range(int(shortest / GRID_M) + 1):
        errors = [side * course.error_at(i * GRID_M) for course, side in courses]
        rows.append([i * GRID_M, *(rates.quantile(errors, share) for share in (0.025, 0.5, 0.975))])
    return rows


def draw_heading(sources, options):
    runs = accepted_runs(sources[0])
    row = chosen(runs, options)
    listed = list(runs.values())[:MOST_RUNS]
    courses = [course_of(sources[0], each) for each in listed]
    shown = course_of(sources[0], row)
    rows = band([(course, side_of(course, each)) for course, each in zip(courses, listed)])
    side = side_of(shown, row)
    figure, axes = style.new_figure(7.0, 4.2)
    path, low, median, high = zip(*rows)
    axes.fill_between(path, low, high, color=style.SKY, alpha=0.3, linewidth=0,
                      label=f"95 % of {len(listed)} accepted runs")
    axes.plot(path, median, color=style.SKY, linestyle=":", label="their median")
    axes.plot(shown.path, side * shown.error_deg, color=style.BLUE, label=f"run {row['trial']}")
    for at in shown.alarms:
        axes.annotate("", (shown.path[at], side * shown.error_deg[at]), xytext=(0, 26),
                      textcoords="offset points", arrowprops={"arrowstyle": "->", "color": style.INK})
    axes.plot([PUBLISHED_A_M, PUBLISHED_A_M, PUBLISHED_END_M], [0.0, -5.0, 15.3], "D",
              color=style.VERMILION, markersize=5, label="published, with its place")
    for level in (10.0, 15.0):
        axes.axhline(level, color=style.VERMILION, linewidth=0.8, linestyle=(0, (6, 3)))
    axes.set(xlabel="distance travelled (m)", ylabel="heading error (deg)")
    axes.legend(loc="upper left", fontsize=8)
    caption = ("Heading error, believed less true, against the distance travelled, in the manner of Matthies 1995, "
               f"figure 8: {sources[0].name}, seed {sources[0].seed}, run {row['trial']}, and 95 % of "
               f"{len(listed)} accepted runs at each distance, signed so that the side of the turn at rock A is "
               "positive. Arrows: where that run believed to see a hazard. Diamonds: what the text gives with its "
               "distance (near 0 and -5 deg at 2.6 m, 15.3 deg at 8.1 m); dashed: +10 from rock B to C and +15 "
               "after the scrape of C, whose distances it does not give.")
    return Drawn(figure, caption, {"band": rows, "alarms": [shown.path[at] for at in shown.alarms]})


FIGURES = tuple(Figure(name=name, title=title, runs="a run of localization/three_rock_run.json; --trial names an accepted one",
                       accepts=(1, 1), draw=draw) for name, title, draw in (
    ("matthies1995-7", "a run among three rocks in plan view", draw_plan),
    ("matthies1995-8", "heading error along a run among three rocks", draw_heading)))
