"""What figures 6 to 8 of Howard 2012 share: one drive of several navigators on the same rocks."""

import math

import numpy as np

from . import FigureError, style

# Drawn where no RUN is named: stop-and-look GESTALT, continuous steering or driving, continuous
# steering and driving.
DEFAULTS = ("scenarios/continuous/stop_and_look.json", "scenarios/continuous/csod.json",
            "scenarios/continuous/csad.json")
RUNS = ("runs, or scenarios, of drives on the same rocks, one a navigator (default: "
        + ", ".join(DEFAULTS) + "); --trial says which trial of each")
ACCEPTS = (0, 6)  # none: the defaults
WITHIN_M = 0.5    # "to reach within 0.5 meters of the goal" (section 3)
RECORD_S = 0.2    # between drawn moments: "at approximately 5 Hz"

# One colour and one dash a navigator.
LOOKS = ((style.BLUE, "-"), (style.VERMILION, (0, (5, 1.5))), (style.GREEN, (0, (1, 1))),
         (style.PURPLE, (0, (5, 1.5, 1, 1.5))), (style.ORANGE, (0, (3, 1, 1, 1, 1, 1))),
         (style.SKY, (0, (8, 2))))


class NavigatorDrive:
    """One trial, moment by moment, of a trace (rockyard.Trace) among the rocks of `terrain`."""

    def __init__(self, trace, terrain):
        self.trace, self.terrain = trace, terrain
        self.name, self.outcome = trace.meta["scenario"], trace.meta["outcome"]
        self.time_s = trace["time_s"]
        self.true_m, self.believed_m = trace["position_m"][:, :2], trace["believed"][:, :2]
        self.record = dict(zip(trace["record_names"].tolist(), trace["record"].tolist()))

    def believed_distances(self):
        """From the believed position to the goal as told, m: what the rover itself recorded."""
        return distances(self.believed_m, (self.record["told_goal_x_m"], self.record["told_goal_y_m"]))

    def true_distances(self):
        return distances(self.true_m, self.terrain["goal_m"])

    def time_within_s(self, distances_m, reach_m=WITHIN_M):
        """When distances first fell to `reach_m`; None where they never did."""
        return next(iter(self.time_s[distances_m <= reach_m]), None)

    def way_as_seen(self):
        """What the rover takes its way to be, in words: by visual odometry, as in the paper, else by its wheels."""
        seen = self.record["visual_distance_m"]
        if math.isnan(seen):
            return f"{self.record['dead_reckoned_distance_m']:.2f} m by its wheels"
        return f"{seen:.2f} m by visual odometry"

    def turned_rad(self):
        """Total turning of each of the six motors, to and fro alike, but for what operators turned."""
        return abs(np.diff(self.trace["steer_rad"], axis=0))[~self.trace["set_back"][1:]].sum(axis=0)


def distances(places, goal):
    return np.hypot(*(places - np.array(goal)).T)


def load_all(sources, trial):
    """Drives on the same rocks, from the same start to the same goal."""
    drives = [NavigatorDrive(source.trace(trial), source.terrain(trial)) for source in sources]
    names = [drive.name for drive in drives]
    for source, drive in zip(sources, drives):
        if names.count(drive.name) > 1:
            drive.name = f"{drive.name} ({source.path.name})"
    for source, drive in zip(sources[1:], drives[1:]):
        for key in ("rocks", "start_m", "goal_m"):
            if drive.terrain[key] != drives[0].terrain[key]:
                raise FigureError(f"{source.path}: differs from {sources[0].path} in {key}; navigators are "
                                  "compared on the same rocks: use runs of one seed and one terrain")
    return drives


def curve(time_s, values):
    """(times, values) to draw: as often as was recorded, both ends, and of what stays equal the ends."""
    kept = [0]
    for i in range(1, len(time_s)):
        if time_s[i] - time_s[kept[-1]] >= RECORD_S or i == len(time_s) - 1:
            # What stood still until a moment ago stood still until then.
            if kept[-1] != i - 1 and values[i - 1] == values[kept[-1]] != values[i]:
                kept.append(i - 1)
            kept.append(i)
    ends = [i for before, i, after in zip(kept, kept[1:], kept[2:])
            if not values[before] == values[i] == values[after]]
    kept = [kept[0], *ends, kept[-1]]
    return [time_s[i] for i in kept], [values[i] for i in kept]


def seconds(value):
    return "never" if value is None else f"{value:.1f} s"
